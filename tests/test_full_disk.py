"""A disk that is full, and folders that may not be written: found at the end or on entry, nothing stays."""

from pathlib import Path

import pytest
from rig import everything_in, run_process

# A file larger than this cannot be written, as on a disk that is full.
FULL = """
import resource, signal
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, ({0}, {0}))
"""

# Root may read and write everywhere: without these capabilities it is bound by the permissions as we are.
MODEST = """
import ctypes, os, sys
if os.geteuid() == 0 and "MODEST" not in os.environ:
    CAP_DAC_OVERRIDE, CAP_DAC_READ_SEARCH, PR_CAPBSET_DROP = 1, 2, 24
    for capability in (CAP_DAC_OVERRIDE, CAP_DAC_READ_SEARCH):
        if ctypes.CDLL(None).prctl(PR_CAPBSET_DROP, capability, 0, 0, 0):
            sys.exit("cannot drop the capability")
    os.environ["MODEST"] = "1"
    os.execv(sys.executable, sys.orig_argv)
"""

IDENTIFY = ["--model", "sinh", "--optimizer", "pso", "--iterations", "2", "--seed", "1"]


@pytest.mark.parametrize("existing", [False, True])
@pytest.mark.parametrize("limit", [100, 12_000], ids=["first file", "figure"])
def test_full_disk(tmp_path: Path, sinh_csv: Path, limit: int, existing: bool) -> None:
    out = tmp_path / "result"
    if existing:
        out.mkdir()
        (out / "model.json").write_text("old")
    before = everything_in(tmp_path)
    run = run_process("identify", sinh_csv, *IDENTIFY, "--out", out, before=FULL.format(limit))
    assert (run.returncode, run.stdout) == (2, "")
    assert run.stderr == f"mre-core: {out}: cannot be written: File too large, wanted a folder to write to\n"
    assert everything_in(tmp_path) == before
    assert not existing or (out / "model.json").read_text() == "old"


def test_full_disk_for_a_prediction(tmp_path: Path, sinh_csv: Path) -> None:
    model = tmp_path / "result" / "model.json"
    assert run_process("identify", sinh_csv, *IDENTIFY, "--out", model.parent, "--no-figures").returncode == 0
    (tmp_path / "p.csv").write_text("old")
    before = everything_in(tmp_path)
    limited = FULL.format(1000)
    run = run_process("simulate", model, sinh_csv, "--out", tmp_path / "p.csv", before=limited)
    assert (run.returncode, run.stdout, run.stderr.count("\n")) == (2, "", 1)
    assert "cannot be written: File too large" in run.stderr
    assert everything_in(tmp_path) == before
    assert (tmp_path / "p.csv").read_text() == "old"


@pytest.mark.parametrize("below", ["", "deep"])
def test_read_only_folder(tmp_path: Path, sinh_csv: Path, below: str) -> None:
    locked = tmp_path / "locked"
    locked.mkdir()
    locked.chmod(0o555)
    before = everything_in(tmp_path)
    run = run_process("identify", sinh_csv, *IDENTIFY, "--out", locked / below, before=MODEST)
    assert (run.returncode, run.stdout, run.stderr.count("\n")) == (2, "", 1)
    assert f"{locked / below}: cannot be written: Permission denied" in run.stderr
    assert everything_in(tmp_path) == before


def test_recording_that_may_not_be_read(tmp_path: Path, sinh_csv: Path) -> None:
    sinh_csv.chmod(0o000)
    run = run_process("identify", sinh_csv, *IDENTIFY, "--out", tmp_path / "out", before=MODEST)
    assert (run.returncode, run.stdout) == (2, "")
    assert run.stderr == f"mre-core: {sinh_csv}: cannot be read: Permission denied, wanted a readable file\n"
    assert not (tmp_path / "out").exists()
