"""Fixtures."""

import os
import signal
from pathlib import Path

import pytest
from mre_core import Recording
from rig import SINH, Cli, made_of, motion, record, write_csv

if "PYTEST_XDIST_WORKER" in os.environ:
    # The workers have the cores among them.
    os.environ.setdefault("RAYON_NUM_THREADS", "1")
if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:
    # So a shell starts what runs in the background, and it is inherited.
    signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture(scope="session")
def sinh_4mm() -> Recording:
    """The simulated 1 A, 4 mm test: 256 Hz, three cycles, noise 0.5 N."""
    return record(made_of("sinh", SINH), motion(), noise=0.5, seed=1)


@pytest.fixture
def sinh_csv(tmp_path: Path, sinh_4mm: Recording) -> Path:
    """The same as a file."""
    return write_csv(tmp_path / "test.csv", sinh_4mm)


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
