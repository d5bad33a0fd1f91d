"""The scripts of benches/ keep up with the package: each starts and tells its options."""

import subprocess
import sys
from pathlib import Path

import pytest

BENCHES = Path(__file__).resolve().parents[1] / "benches"


@pytest.mark.parametrize("script", ["real_proof", "rivals", "discovery", "rates"])
def test_script_starts(script: str) -> None:
    done = subprocess.run(
        [sys.executable, BENCHES / script, "--help"], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    assert "usage" in done.stdout
