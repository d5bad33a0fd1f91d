"""Fixtures."""

import os
from collections.abc import Callable
from pathlib import Path

import mre_core
import pytest
from mre_core import Recording
from rig import SINH, made_of, motion, record, write_csv


@pytest.fixture(scope="session")
def sinh_4mm() -> Recording:
    """The simulated 1 A, 4 mm test: 256 Hz, three cycles, noise 0.5 N."""
    return record(made_of("sinh", SINH), motion(), noise=0.5, seed=1)


@pytest.fixture
def sinh_csv(tmp_path: Path, sinh_4mm: Recording) -> Path:
    """The same as a file."""
    return write_csv(tmp_path / "test.csv", sinh_4mm)


class Cli:
    """The command line in this process, which is faster than a new one."""

    def __init__(self, capsys: pytest.CaptureFixture[str]) -> None:
        self._capsys = capsys

    def __call__(self, *arguments: str | Path) -> tuple[int, str, str]:
        """Exit status, standard output, standard error."""
        from mre_core.cli import main

        self._capsys.readouterr()
        status = main([str(argument) for argument in arguments])
        out, err = self._capsys.readouterr()
        return status, out, err


@pytest.fixture
def cli(capsys: pytest.CaptureFixture[str]) -> Cli:
    return Cli(capsys)


@pytest.fixture(scope="session")
def real_data() -> Path:
    """Folder of the measured recordings, which are read where they lie and are no part of the repository."""
    default = Path(__file__).parents[2] / "shared" / "data"
    folder = Path(os.environ.get("MRE_DATA", default))
    if not folder.is_dir():
        reason = f"no measured recordings in {folder}: set MRE_DATA to their folder"
        if os.environ.get("CI"):
            pytest.fail(reason)
        pytest.skip(reason)
    return folder


@pytest.fixture(scope="session")
def damper(real_data: Path) -> list[Recording]:
    """All tests of the damper, without their transients."""
    return _damper(real_data, lambda r: r.exclude("start_transient", "stop_transient"))


def _damper(real_data: Path, prepare: Callable[[Recording], Recording]) -> list[Recording]:
    files = sorted((real_data / "mr-damper-usm").glob("*.csv"))
    return [prepare(mre_core.load(f, name_pattern="{amplitude}mm{frequency}Hz{current}A")) for f in files]
