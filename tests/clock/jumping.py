"""Make the clock of processes jump."""

import os
import shutil
import subprocess
import sys
from itertools import pairwise
from pathlib import Path

import pytest

_SOURCE = Path(__file__).with_name("jumping.c")
_READ = "import time; print(*(time.time() - time.monotonic() for _ in range(9)))"


def jumping(folder: Path) -> dict[str, str]:
    """The environment of a process whose clock jumps; skips the test where the system knows no such way."""
    compiler = shutil.which("cc")
    if compiler is None or not sys.platform.startswith("linux"):
        pytest.skip("no C compiler, or no Linux")
    library = folder / "jumping.so"
    subprocess.run([compiler, "-shared", "-fPIC", "-O1", "-o", library, _SOURCE], check=True)
    environment = os.environ | {"LD_PRELOAD": str(library)}
    run = subprocess.run(
        [sys.executable, "-c", _READ], env=environment, capture_output=True, text=True, check=True
    )
    told = [float(value) for value in run.stdout.split()]
    assert max(told) - min(told) > 3600
    assert any(after < before for before, after in pairwise(told))
    return environment
