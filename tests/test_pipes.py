"""Recordings through pipes that are open already, as a shell makes them."""

import os
import subprocess
from pathlib import Path

import mre_core
import pytest
from mre_core import InputError
from mre_core.files import limits
from rig import command, force_of


def piped(data: bytes) -> int:
    """Number of a pipe that holds some text, and whose writer is gone."""
    reading, writing = os.pipe()
    os.write(writing, data)
    os.close(writing)
    return reading


def test_standard_input(sinh_csv: Path) -> None:
    found = subprocess.run(
        command("inspect", "/dev/stdin"), input=sinh_csv.read_bytes(), capture_output=True, check=False
    )
    assert (found.returncode, found.stderr) == (0, b"")
    assert b"force" in found.stdout


@pytest.mark.parametrize("folder", ["/dev/fd", "/proc/self/fd"])
def test_a_pipe_by_its_number(sinh_csv: Path, folder: str) -> None:
    short = b"\n".join(sinh_csv.read_bytes().splitlines()[:200])
    sinh_csv.write_bytes(short)
    number = piped(short)
    try:
        # Twice: it gives its text only once, and laws read recordings again.
        for _ in range(2):
            found = mre_core.load(f"{folder}/{number}")
            assert (force_of(found) == force_of(mre_core.load(sinh_csv))).all()
    finally:
        os.close(number)


def test_more_than_a_file_may_have(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(limits, "MOST_BYTES", 1000)
    number = piped(b"1,2\n" * 1000)
    try:
        with pytest.raises(InputError, match=r"has 0\.0 GiB, wanted at most 0 GiB"):
            mre_core.load(f"/dev/fd/{number}")
    finally:
        os.close(number)
