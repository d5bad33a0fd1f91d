"""The command of the study: its own recordings, what it refuses, and Ctrl-C."""

import json
import signal
import subprocess
import time
from pathlib import Path
from typing import Any

import pytest
from mre_core import InputError
from mre_core.cli.arguments import spread
from rig import BOUC_WEN, SINH, Cli, command, everything_in, made_of, motion, record, write_csv

LISTEN = "import signal; signal.signal(signal.SIGINT, signal.default_int_handler)"


def files(folder: Path) -> list[Path]:
    model = made_of("sinh", SINH)
    return [
        write_csv(folder / f"{a}mm1A.csv", record(model, motion(a, rate=64), noise=0.3)) for a in (2.0, 4.0)
    ]


def test_recordings_take_several_files() -> None:
    given = ["study", "--recordings", "a.csv", "b.csv", "--seed", "2", "--map", "force=F", "time=t"]
    assert spread(given) == [
        *("study", "--recordings", "a.csv", "--recordings", "b.csv", "--seed", "2"),
        *("--map", "force=F", "--map", "time=t"),
    ]


def test_bounds_and_laws_take_several_parameters() -> None:
    given = ["laws", "--bounds", "beta=0.1:1", "kw=0:2", "a=b.csv", "--law", "c0=linear", "c=d.csv"]
    assert spread(given) == [
        *("laws", "--bounds", "beta=0.1:1", "--bounds", "kw=0:2", "a=b.csv"),
        *("--law", "c0=linear", "c=d.csv"),
    ]


def test_an_empty_value_is_told_from_one_that_ends_in_an_equals_sign() -> None:
    assert spread(["inspect", "a.csv", "--read=separator=="]) == ["inspect", "a.csv", "--read=separator=="]
    assert spread(["inspect", "--name-pattern={current}="]) == ["inspect", "--name-pattern={current}="]
    with pytest.raises(InputError, match="--out is empty"):
        spread(["inspect", "--out="])


def test_a_campaign_of_ones_own(cli: Cli, tmp_path: Path) -> None:
    made = files(tmp_path)
    out = tmp_path / "out"
    pattern = ["--name-pattern", "{amplitude}mm{current}A"]
    status, shown, err = cli("study", "--quick", "--recordings", *made, *pattern, "--seed", "3", "--out", out)
    assert status == 0, err
    assert shown.startswith("These are the recordings that were given")
    content = json.loads((out / "study.json").read_text(encoding="utf-8"))
    assert content["tests"] == ["2.0mm1A", "4.0mm1A"]
    assert content["seed"] == 3
    assert content["sections"]["table2"]["loop"]["current_A"] == 1.0


WRONG: dict[str, tuple[list[str], list[str]]] = {
    "no out": ([], ["--out"]),
    "out is a file": (["--out", "a.csv"], ["a.csv: ", "cannot be written"]),
    "no such file": (["--recordings", "b.csv", "--out", "new"], ["b.csv: "]),
    "seed": (["--seed", "-1", "--out", "new"], ["seed is -1", "whole number"]),
    "seed is text": (["--seed", "x", "--out", "new"], ["--seed", "'x'"]),
    "threads": (["--threads", "0", "--out", "new"], ["threads is 0", "from 1"]),
    "parts without recordings": (
        ["--exclude", "start_transient", "--out", "new"],
        ["--exclude is given without recordings", "--recordings"],
    ),
    "columns without recordings": (
        ["--map", "force=F", "--out", "new"],
        ["--map is given without recordings"],
    ),
    "unknown parts": (["--recordings", "a.csv", "--exclude", "middle", "--out", "new"], ["'middle'"]),
    "a file without --recordings": (["a.csv", "--out", "new"], ["a.csv"]),
}


@pytest.mark.parametrize("name", WRONG)
def test_one_line_exit_2_and_nothing_written(
    cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    arguments, pieces = WRONG[name]
    write_csv(tmp_path / "a.csv", record(made_of("sinh", SINH), motion(rate=64)))
    monkeypatch.chdir(tmp_path)
    status, out, err = cli("study", "--quick", *arguments)
    assert (status, out) == (2, "")
    assert err.startswith("mre-core: ")
    assert err.count("\n") == 1
    for piece in pieces:
        assert piece in err
    assert everything_in(tmp_path) == {"a.csv"}


def test_interrupt(tmp_path: Path) -> None:
    moved = motion(cycles=60, rate=512)
    file = write_csv(tmp_path / "1A.csv", record(made_of("bouc_wen", BOUC_WEN), moved, noise=0.1))
    out = tmp_path / "out"
    arguments = command("study", "--recordings", file, "--out", out, before=LISTEN)
    job = subprocess.Popen(arguments, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        assert job.stderr is not None
        lines: list[Any] = []
        while not lines or "Figure 11" not in lines[-1]:  # its swarms would run for hours
            lines.append(job.stderr.readline())
            assert lines[-1], lines
        time.sleep(0.7)
        job.send_signal(signal.SIGINT)
        shown, error = job.communicate(timeout=60)
    finally:
        job.kill()
    assert (job.returncode, shown) == (130, "")
    assert error.endswith("mre-core: interrupted\n")
    assert everything_in(tmp_path) == {"1A.csv"}
