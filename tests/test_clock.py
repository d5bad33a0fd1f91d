"""A clock that jumps by hours, back and forth, breaks, hangs and loses nothing."""

import json
import re
import subprocess
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

import mre_core
import pytest
from clock.jumping import jumping
from mre_core.batches.columns import to_table
from pandas.testing import assert_frame_equal
from rig import SINH, command, made_of, motion, record, write_csv

ROOT = Path(__file__).parents[1]
# The time of day, by any name; files carry it, too.
_TIME_OF_DAY = re.compile(
    r"\btime\.(time|time_ns|localtime|gmtime|ctime|strftime)\(|\.(now|today|utcnow)\(|SystemTime|st_[mac]time"
)
LONG = str(10**6)


@pytest.fixture(scope="module")
def clock(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    return jumping(tmp_path_factory.mktemp("clock"))


def test_the_time_of_day_is_only_noted() -> None:
    sources = [*(ROOT / "python").rglob("*.py"), *(ROOT / "rust").rglob("*.rs")]
    assert len(sources) > 100
    uses = {
        path.name: found
        for path in sources
        if (found := [m[0] for m in _TIME_OF_DAY.finditer(path.read_text(encoding="utf-8"))])
    }
    assert uses == {"ledger.py": ["time.time("], "items.py": ["st_mtime"]}


def test_a_time_that_has_no_date_is_missing() -> None:
    rows = [{"item": "a", "finished_time": 1e18}, {"item": "b", "finished_time": 0.5, "modified_time": -1e18}]
    table = to_table(rows)
    assert table["finished_time"].isna().tolist() == [True, False]
    assert table["modified_time"].isna().all()


def one(folder: Path) -> Path:
    return write_csv(folder / "0.csv", record(made_of("sinh", SINH), motion(rate=100), noise=0.1))


def several(folder: Path, count: int = 6) -> list[str | Path]:
    """A batch of them."""
    folder.mkdir()
    for i in range(count):
        write_csv(folder / f"{i}.csv", record(made_of("sinh", SINH), motion(rate=100), noise=0.1, seed=i))
    return ["batch", folder, "--model", "sinh", "--seed", "1", "--quiet", "--no-figures", "--workers", "2"]


def done(run: "subprocess.CompletedProcess[str]") -> None:
    assert (run.returncode, run.stderr) == (0, "")


def run(arguments: Sequence[str | Path], clock: dict[str, str] | None) -> "subprocess.CompletedProcess[str]":
    return subprocess.run(
        command(*arguments), env=clock, capture_output=True, text=True, timeout=300, check=False
    )


def test_an_identification_and_its_budget(clock: dict[str, str], tmp_path: Path) -> None:
    limited = ["--optimizer", "pso", "--iterations", LONG, "--time-limit", "0.5", "--quiet"]
    arguments: list[str | Path] = ["identify", one(tmp_path), "--model", "sinh", "--seed", "1"]
    done(run([*arguments, *limited, "--out", tmp_path / "out"], clock))
    content = json.loads((tmp_path / "out" / "identification.json").read_text(encoding="utf-8"))
    assert content["runs"][0]["reason"] == "time_limit"
    # One that a jump must not end.
    few = ["--optimizer", "pso", "--iterations", "3", "--time-limit", "3600", "--quiet", "--no-figures"]
    for name, environment in (("jumping", clock), ("steady", None)):
        done(run([*arguments, *few, "--out", tmp_path / name], environment))
    jumped, steady = ((tmp_path / name / "model.json").read_bytes() for name in ("jumping", "steady"))
    assert jumped == steady


def test_a_batch_with_a_budget_that_is_stopped_and_goes_on(clock: dict[str, str], tmp_path: Path) -> None:
    batch = [*several(tmp_path / "in"), "--budget", "600"]
    out = tmp_path / "out"
    job = subprocess.Popen(command(*batch, "--out", out), env=clock)
    try:
        while job.poll() is None and not (out / "batch.sqlite3").exists():
            pass
    finally:
        job.kill()  # the worst of all ends
        job.wait()
    done(run([*batch, "--out", out], clock))
    done(run([*batch, "--out", tmp_path / "steady"], None))
    found, steady = (mre_core.read_results(folder) for folder in (out, tmp_path / "steady"))
    assert (found["status"] == "done").all()
    same = [name for name in found if not str(name).endswith("time")]
    assert_frame_equal(found[same], steady[same])


def test_a_budget_that_is_too_small(clock: dict[str, str], tmp_path: Path) -> None:
    batch = [*several(tmp_path / "in", 2), "--budget", "0.2", "--optimizer", "pso", "--iterations", LONG]
    found = run([*batch, "--out", tmp_path / "out"], clock)
    assert (found.returncode, found.stderr) == (1, "")
    results = mre_core.read_results(tmp_path / "out")
    assert results["error"].tolist() == ["not done within 0.2 s"] * 2


@contextmanager
def at_work(batch: list[str | Path], out: Path, clock: dict[str, str]) -> Iterator[None]:
    """A batch that has the folder to itself, and does not end."""
    job = subprocess.Popen(
        command(*batch, "--optimizer", "pso", "--iterations", LONG, "--out", out), env=clock
    )
    try:
        while not (out / "batch.sqlite3").exists():
            assert job.poll() is None
        yield
    finally:
        job.kill()
        job.wait()


def test_a_folder_in_use_is_one_until_its_batch_ends(clock: dict[str, str], tmp_path: Path) -> None:
    batch, out = several(tmp_path / "in", 2), tmp_path / "out"
    quick = [*batch, "--optimizer", "exact", "--out", out]
    with at_work(batch, out, clock):
        second = run(quick, clock)
        assert (second.returncode, second.stdout) == (2, "")
        assert (
            second.stderr
            == f"mre-core: {out}: another process is at work there, wanted its end, or another folder\n"
        )
    other = run(quick, clock)  # the lock is gone with its process, however old it looks
    assert (other.returncode, other.stdout) == (2, "")
    assert "a batch with other settings is there" in other.stderr


def test_progress_under_a_clock_that_jumps(clock: dict[str, str], tmp_path: Path) -> None:
    before = "import mre_core.cli.progress as progress; progress.EVERY = 0.01"
    limited = ["--optimizer", "pso", "--iterations", "20000", "--time-limit", "1", "--seed", "1"]
    arguments = command("identify", one(tmp_path), "--model", "sinh", *limited, before=before)
    found = subprocess.run(arguments, env=clock, capture_output=True, text=True, timeout=300, check=False)
    assert found.returncode == 0
    lines = found.stderr.splitlines()
    assert lines
    for line in lines:
        told = re.fullmatch(
            r"mre-core: identifying.* (\d+) evaluations, ([\d.e+]+) a second, .* (\d+) s left", line
        )
        assert told, line
        assert float(told[2]) > 0


def test_a_trial(clock: dict[str, str], tmp_path: Path) -> None:
    trial = tmp_path / "trial"
    make: list[str | Path] = ["trial", "make", trial, "--cases", "2", "--seed", "1"]
    assert run(make, clock).returncode == 0
    assert run(["trial", "run", trial, "--workers", "2"], clock).returncode == 0
    assert run(["trial", "open", trial], clock).returncode == 0
