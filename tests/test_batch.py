"""Batches on this machine: the table, failures, kills, and what is refused."""

import os
import re
import shutil
import signal
import sqlite3
import sys
import time
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from dataclasses import replace
from multiprocessing import get_context
from pathlib import Path
from threading import Timer
from typing import Any

import mre_core
import numpy as np
import pandas as pd
import pytest
from mre_core import InputError, Level, Model
from mre_core.batches.child import Child
from mre_core.batches.drive import chunk_size, drive
from mre_core.batches.engine import Engine
from mre_core.batches.items import find_items
from mre_core.batches.jobs import identified
from mre_core.batches.settings import Reading, Settings
from mre_core.batches.work import Outcome, Task
from pandas.testing import assert_frame_equal
from rig import SINH, Cli, everything_in, made_of, motion, record, run_process, write_csv
from test_full_disk import FULL

Arguments = list[str | Path]
FAST: dict[str, Any] = {"model": "sinh", "optimizer": "exact", "seed": 1}


def recordings(folder: Path, count: int, rate: float = 64.0) -> Path:
    """Files of alike devices under alike motions."""
    folder.mkdir(parents=True, exist_ok=True)
    for i in range(count):
        moved = motion(3 + 0.1 * i, rate=rate)
        write_csv(folder / f"r{i:03}.csv", record(made_of("sinh", SINH), moved, noise=0.5, seed=i))
    return folder


def cell(table: pd.DataFrame, item: str, column: str) -> Any:
    return table.loc[item, column]


def lasting(table: pd.DataFrame) -> pd.DataFrame:
    """Without the columns that vary from run to run."""
    return table[[name for name in table if not str(name).endswith("_time")]]


def task_of(folder: Path, **given: object) -> Task:
    """The first item of a folder."""
    settings = Settings.of("sinh", None, Reading(), {"optimizer": "exact"} | given, None)
    item = find_items(folder)[0]
    return Task(item.name, tuple(map(str, item.files)), item.digest, 1, settings, identified)


@pytest.fixture(scope="module")
def five(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return recordings(tmp_path_factory.mktemp("five") / "in", 5)


def test_rows_are_what_identify_finds(five: Path, tmp_path: Path) -> None:
    table = mre_core.batch(five, tmp_path / "out", model="sinh", seeds=[3, 4], bootstrap=20)
    assert list(table["item"]) == [f"r{i:03}.csv" for i in range(5) for _ in range(2)]
    assert list(table["seed"]) == [3, 4] * 5
    assert set(table["status"]) == {"done"}
    for _, row in table.iterrows():
        recording = mre_core.load(five / row["item"])
        found = mre_core.identify(recording, "sinh", seed=row["seed"])
        for name, value in found.result.values.items():
            assert row[name] == value
            ends = found.model.levels[0].intervals.get(name, (np.nan, np.nan))
            np.testing.assert_array_equal([row[f"{name}_low"], row[f"{name}_high"]], ends)
        low, high = found.bootstrap(20)[0].intervals["c0"]
        assert (row["c0_bootstrap_low"], row["c0_bootstrap_high"]) == (low, high)
        assert row["rms_N"] == pytest.approx(found.result.rms, rel=1e-12)
        assert row["amplitude"] == np.abs(recording.displacement).max()
        model = Model.load(tmp_path / "out" / "models" / f"{row['item']}.seed{row['seed']}.json")
        assert model.levels[0].parameters == found.model.levels[0].parameters
    assert_frame_equal(mre_core.read_results(tmp_path / "out"), table)
    assert_frame_equal(mre_core.read_results(tmp_path / "out" / "results.parquet"), table)
    if sys.platform == "linux":  # where a name need not be text
        (tmp_path / "out").rename(renamed := tmp_path / os.fsdecode(b"\xff"))
        assert_frame_equal(mre_core.read_results(renamed), table)


def test_campaigns_and_their_currents(tmp_path: Path) -> None:
    device = Model("kelvin_voigt", tuple(Level(i, {"c0": 1 + i, "k0": 5 + i, "F0": 0.0}) for i in (0.0, 0.5)))
    for campaign, currents in (("a", (0.0, 0.5)), ("b", (0.5,))):
        for i, current in enumerate(currents):
            (tmp_path / "in" / campaign).mkdir(parents=True, exist_ok=True)
            made = record(device, motion(2.0 + i, current=current), noise=0.1, seed=i, name=campaign)
            write_csv(tmp_path / "in" / campaign / f"{2 + i}mm{current}A.csv", made)
    table = mre_core.batch(
        tmp_path / "in", tmp_path / "out", model="kelvin_voigt", name_pattern="{x}mm{current}A"
    ).set_index("item")
    assert list(table["recordings"]) == [2, 1]
    assert cell(table, "a", "c0(0 A)") == pytest.approx(1.0, abs=0.01)
    assert cell(table, "a", "c0(0.5 A)") == pytest.approx(1.5, abs=0.01)
    assert cell(table, "a", "k0_low(0.5 A)") < 5.5 < cell(table, "a", "k0_high(0.5 A)")
    assert cell(table, "b", "c0") == pytest.approx(1.5, abs=0.01)
    assert list(table["current"].isna()) == [True, False]
    shown = mre_core.plot_parameters(table.reset_index())
    assert [axis.get_title() for axis in shown.axes] == ["c0", "k0", "F0"]
    assert [axis.get_ylabel() for axis in shown.axes] == ["N s/mm", "N/mm", "N"]
    points = np.asarray(shown.axes[0].lines[0].get_xydata())
    np.testing.assert_allclose(points, [[0.0, 1.0], [0.5, 1.5], [0.5, 1.5]], atol=0.01)
    with pytest.raises(InputError, match="'c9' is no parameter of the results, wanted c0, k0, F0"):
        mre_core.plot_parameters(table.reset_index(), "time", ["c9"])
    with pytest.raises(InputError, match="against is 'noise', wanted one of current, amplitude, time"):
        mre_core.plot_parameters(table.reset_index(), "noise")


def test_diagnoses(tmp_path: Path) -> None:
    (tmp_path / "in").mkdir()
    moved = motion(rate=128, cycles=8)
    device = made_of("kelvin_voigt", {"c0": 0.3, "k0": 5.0, "F0": 0.5})
    for i in (1, 2):
        write_csv(tmp_path / "in" / f"{i}.csv", record(device, moved, noise=0.2, seed=i))
    table = mre_core.batch(tmp_path / "in", tmp_path / "out", base="kelvin_voigt", seed=1)
    for _, row in table.iterrows():
        found = mre_core.diagnose(mre_core.load(tmp_path / "in" / row["item"]), "kelvin_voigt", seed=1)
        assert row["verdict"] == found.verdict == "adequate"
        assert row["held_out_rms_after_N"] == found.fit.held_out_rms_after
        assert row["c0"] == found.model.levels[0].parameters["c0"]


def test_failures_stop_nothing(cli: Cli, tmp_path: Path) -> None:
    folder = recordings(tmp_path / "in", 3)
    (folder / "broken.csv").write_text("time_s,displacement_mm,force_N\n0,1,2\n1,x,2\n")
    shutil.copy(folder / "r001.csv", folder / "s.csv")
    (folder / "twice").mkdir()
    shutil.copy(folder / "r001.csv", folder / "twice" / "a.csv")
    shutil.copy(folder / "r001.csv", folder / "twice" / "b.csv")
    (folder / "empty").mkdir()
    os.mkfifo(folder / "pipe.csv")  # to open it would take for ever
    out = folder / "out"  # inside: no campaign
    arguments: Arguments = [
        "batch",
        folder,
        "--model",
        "sinh",
        "--seed",
        "1",
        "--out",
        out,
        "--no-figures",
    ]
    status, shown, err = cli(*arguments)
    assert (status, err) == (0, "")
    assert "3 done, 5 failed" in shown
    table = mre_core.read_results(out).set_index("item")
    assert list(table.index[table["status"] == "done"]) == ["r000.csv", "r001.csv", "r002.csv"]
    errors = table["error"]
    assert re.search(r"broken\.csv: line 3, column 'displacement_mm': .*'x'", errors["broken.csv"])
    assert errors["s.csv"] == "the same content as r001.csv"
    assert errors["twice"] == "b.csv: the same recording as a.csv"
    assert errors["empty"] == "no recording in the folder"
    assert errors["pipe.csv"] == "pipe.csv: no regular file"
    assert all("\n" not in error for error in errors)
    assert all(name in shown for name in ("broken.csv", "s.csv", "twice", "empty", "pipe.csv"))
    # Nothing is done again, and where nothing at all can be done the status says so.
    before = table["finished_time"]
    assert cli(*arguments)[0] == 0
    assert mre_core.read_results(out).set_index("item")["finished_time"].equals(before)
    for name in ("r000.csv", "r001.csv", "r002.csv", "s.csv"):
        (folder / name).unlink()
    shutil.rmtree(folder / "twice")
    assert cli(*arguments)[0] == 1
    assert set(mre_core.read_results(out)["status"]) == {"failed"}


# The process strikes itself at a moment of the batch: before or after it keeps what is done, or when it
# writes the results.
STRIKE = """
import os, signal
from mre_core.batches import ledger
from mre_core.batches.journal import Journal
signal.signal(signal.SIGINT, signal.default_int_handler)
write, table, kept = Journal.write, ledger.to_table, []
def strike(moment):
    if moment == {moment!r}:
        os.kill(os.getpid(), signal.{signal})
def struck_write(self, entries):
    kept.extend(entries)
    if len(kept) >= 3:
        strike("before")
    write(self, entries)
    if len(kept) >= 3:
        strike("after")
def struck_table(rows):
    strike("table")
    return table(rows)
Journal.write, ledger.to_table = struck_write, struck_table
"""


def done_in(out: Path) -> int:
    db = sqlite3.connect(out / "batch.sqlite3")
    (count,) = db.execute("select count(*) from done").fetchone()
    db.close()
    return int(count)


@pytest.mark.parametrize("moment", ["before", "after", "table"])
def test_killed_batch_goes_on(tmp_path: Path, moment: str) -> None:
    folder = recordings(tmp_path / "in", 12)
    whole = mre_core.batch(folder, tmp_path / "whole", model="sinh", optimizer="mafsa", seed=7, n_fish=10)
    out = tmp_path / "killed"
    arguments: Arguments = ["batch", folder, "--model", "sinh", "--optimizer", "mafsa", "--fish", "10"]
    arguments += ["--out", out, "--no-figures"]
    killed = run_process(*arguments, "--seed", "7", before=STRIKE.format(moment=moment, signal="SIGKILL"))
    assert killed.returncode == -signal.SIGKILL
    assert done_in(out) in {"before": (0, 1, 2), "after": range(3, 12), "table": (12,)}[moment]
    assert not (out / "results.parquet").exists()
    # The seed need not be said again.
    assert run_process(*arguments).returncode == 0
    again = mre_core.read_results(out)
    assert_frame_equal(lasting(again), lasting(whole), check_exact=True)
    assert {file.name for file in (out / "models").iterdir()} == {f"{name}.json" for name in whole["item"]}
    for file in (out / "models").iterdir():
        assert file.read_bytes() == (tmp_path / "whole" / "models" / file.name).read_bytes()


def test_interrupted_batch_is_whole(tmp_path: Path) -> None:
    folder = recordings(tmp_path / "in", 12)
    out = tmp_path / "out"
    arguments: Arguments = ["batch", folder, "--model", "sinh", "--out", out, "--no-figures"]
    run = run_process(*arguments, before=STRIKE.format(moment="after", signal="SIGINT"))
    said = "mre-core: interrupted: the same command goes on where it was"
    assert (run.returncode, run.stderr.strip()) == (130, said)
    table = mre_core.read_results(out)
    assert 3 <= len(table) < 12
    assert set(table["status"]) == {"done"}


def test_changed_and_new_recordings_are_done_again(tmp_path: Path) -> None:
    folder = recordings(tmp_path / "in", 3)
    first = mre_core.batch(folder, tmp_path / "out", **FAST).set_index("item")
    recordings(folder, 4)
    changed = record(made_of("sinh", SINH), motion(9.0), noise=0.5, seed=99)
    write_csv(folder / "r001.csv", changed)
    (folder / "r000.csv").unlink()
    second = mre_core.batch(folder, tmp_path / "out", **FAST).set_index("item")
    assert list(second.index) == ["r001.csv", "r002.csv", "r003.csv"]
    assert cell(second, "r002.csv", "finished_time") == cell(first, "r002.csv", "finished_time")
    assert cell(second, "r001.csv", "amplitude") == 9.0


def test_out_of_time(tmp_path: Path) -> None:
    folder = recordings(tmp_path / "in", 2)
    given: dict[str, Any] = {
        "model": "sinh",
        "optimizer": "mafsa",
        "seed": 1,
        "max_iterations": 10**6,
        "n_fish": 1000,
    }
    out = tmp_path / "out"
    table = mre_core.batch(folder, out, budget=0.4, **given)
    assert set(table["error"]) == {"not done within 0.4 s"}
    assert (table["fit_time"] >= 0.39).all()
    given = FAST
    other = tmp_path / "other"
    assert set(mre_core.batch(folder, other, budget=1e-6, **given)["status"]) == {"failed"}
    # Another attempt may be given more.
    assert set(mre_core.batch(folder, other, budget=60, **given)["status"]) == {"done"}


def test_chunks_are_long_beside_what_a_scheduler_takes() -> None:
    assert chunk_size(0.0, 1000, 10**6) == 1  # nothing is known yet
    assert chunk_size(0.1, 2, 10**6) == 10
    assert chunk_size(100.0, 2, 10**6) == 1
    # A thousand workers at 5 ms a message would ask for 5 s of work in each, at least.
    assert chunk_size(0.1, 1000, 10**6) * 0.1 >= 5
    # At the end no worker has more than its share.
    assert chunk_size(0.1, 4, 24) == 3
    assert chunk_size(0.1, 4, 1) == 1


def test_a_process_that_is_killed_is_started_again(five: Path) -> None:
    with Child() as child:
        whole = child.run(task_of(five), None)
        process = child._process
        assert process is not None
        os.kill(process.pid, signal.SIGKILL)
        again = child.run(task_of(five), None)
        assert child._process is not process
        assert again.row == whole.row
        assert again.error == ""
    long = task_of(five, optimizer="mafsa", max_iterations=10**6, n_fish=1000)
    with Child() as child:

        def strike() -> None:
            process = child._process
            if process is not None:
                process.kill()

        child.run(task_of(five), None)
        timers = [Timer(0.5 * i, strike) for i in range(1, 40)]
        for timer in timers:
            timer.start()
        outcome = child.run(long, None)
        for timer in timers:
            timer.cancel()
    assert outcome.error == "its process died 3 times (status -9): out of memory?"
    assert not outcome.lasting


@pytest.mark.skipif(os.name != "posix", reason="needs a shell")
def test_a_process_that_is_only_starting_holds_nobody_up(
    five: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    begun, never = tmp_path / "begun", tmp_path / "never-ready"
    never.write_text(f"#!/bin/sh\necho $$ > {begun}\nexec sleep 1000\n")
    never.chmod(0o755)
    monkeypatch.setattr(sys, "executable", str(never))
    child = Child()
    with ThreadPoolExecutor(1) as pool:
        item = pool.submit(child.run, task_of(five), None)
        while not begun.exists() or not begun.read_text().strip():
            time.sleep(0.01)
        child.close()
        with pytest.raises(RuntimeError, match="the batch has ended"):
            item.result(timeout=60)


def test_a_batch_that_ends_between_the_start_of_a_process_and_its_item(
    five: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    child = Child()
    start = child._started

    def started_and_closed() -> Any:
        process = start()
        child.close()
        return process

    monkeypatch.setattr(child, "_started", started_and_closed)
    with pytest.raises(RuntimeError, match="the batch has ended"):
        child.run(task_of(five), None)


def test_a_file_that_changes_while_it_is_read(tmp_path: Path) -> None:
    folder = recordings(tmp_path / "in", 1)
    task = task_of(folder)
    recordings(folder, 1, rate=65)
    with Child() as child:
        outcome = child.run(task, None)
        gone = child.run(replace(task, contents=(b"",)), None)  # what is sent where it cannot be read
    said = "r000.csv: changed since the batch began, wanted files that stay as they are"
    assert (outcome.error, gone.error) == (said, said)
    assert not (outcome.lasting or gone.lasting)


def test_what_another_attempt_may_mend(five: Path) -> None:
    task = task_of(five)
    with Child() as child:
        other = child.run(replace(task, version="0.0.1"), None)
        gone = child.run(replace(task, files=(str(five / "gone.csv"),)), None)
    assert other.error == f"its worker has version {mre_core.__version__}, wanted 0.0.1"
    assert gone.error.endswith("gone.csv: there is no such file")
    assert not other.lasting
    assert not gone.lasting


def test_contents_travel_to_workers_that_see_no_files(five: Path, tmp_path: Path) -> None:
    found: list[Outcome] = []
    task = task_of(five)
    with ThreadPoolExecutor(1) as pool:
        drive([task], Engine(pool, 1), None, found.extend)
        drive([task], Engine(pool, 1, sees_files=False), None, found.extend)
    assert found[0].row == found[1].row
    assert found[0].error == found[1].error == ""
    # Neither folder shows in what is said.
    unit = tmp_path / "assumed" / "r.csv"
    unit.parent.mkdir()
    unit.write_text((five / "r000.csv").read_text().replace("force_N", "force"))
    found.clear()
    with ThreadPoolExecutor(1) as pool:
        for sees_files in (True, False):
            drive([task_of(unit.parent)], Engine(pool, 1, sees_files=sees_files), None, found.extend)
    assert found[0].row["warnings"].startswith("r.csv: ")
    assert found[0].row == found[1].row
    broken = tmp_path / "in" / "campaign" / "broken.csv"
    broken.parent.mkdir(parents=True)
    broken.write_text("time_s,displacement_mm\n")
    found.clear()
    with ThreadPoolExecutor(1) as pool:
        for sees_files in (True, False):
            drive([task_of(tmp_path / "in")], Engine(pool, 1, sees_files=sees_files), None, found.extend)
    assert found[0].error == found[1].error
    assert found[0].error.startswith("campaign/broken.csv: ")


@pytest.mark.parametrize("kind", ["threads", "processes"])
def test_any_executor(five: Path, tmp_path: Path, kind: str) -> None:
    here = mre_core.batch(five, tmp_path / "here", **FAST)
    pool = (
        ThreadPoolExecutor(2)
        if kind == "threads"
        else ProcessPoolExecutor(2, mp_context=get_context("spawn"))
    )
    with pool:
        there = mre_core.batch(five, tmp_path / "there", executor=pool, **FAST)
    assert_frame_equal(lasting(there), lasting(here), check_exact=True)


def test_an_executor_whose_workers_die(five: Path, tmp_path: Path) -> None:
    def kill(done: int, failed: int, count: int) -> None:
        for process in list(pool._processes.values()):
            process.kill()

    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
        with pytest.raises(InputError, match=r"the workers are gone \(BrokenProcessPool"):
            mre_core.batch(five, tmp_path / "out", executor=pool, on_progress=kill, **FAST)
    whole = mre_core.batch(five, tmp_path / "out", **FAST)
    assert set(whole["status"]) == {"done"}
    assert len(whole) == 5


def test_full_disk(five: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    arguments: Arguments = [
        "batch",
        five,
        "--model",
        "sinh",
        "--optimizer",
        "exact",
        "--out",
        out,
        "--no-figures",
    ]
    run = run_process(*arguments, before=FULL.format(18_000))
    assert (run.returncode, run.stdout, run.stderr.count("\n")) == (2, "", 1)
    assert "cannot be written" in run.stderr
    assert not list(out.rglob("*.parquet"))
    assert run_process(*arguments).returncode == 0
    assert set(mre_core.read_results(out)["status"]) == {"done"}


def test_refused(cli: Cli, five: Path, tmp_path: Path) -> None:
    from filelock import FileLock

    out = tmp_path / "out"
    good: Arguments = ["batch", five, "--optimizer", "exact", "--out", out, "--no-figures", "--quiet"]
    sinh = [*good, "--model", "sinh"]
    assert cli(*sinh)[0] == 0

    def refused(*arguments: str | Path) -> str:
        before = everything_in(tmp_path)
        status, shown, err = cli(*arguments)
        assert (status, shown, err.count("\n")) == (2, "", 1)
        assert everything_in(tmp_path) == before
        return err.removeprefix("mre-core: ").rstrip()

    with FileLock(out / "batch.lock"):
        assert refused(*sinh) == f"{out}: another process is at work there, wanted its end, or another folder"
    assert "a batch with other settings is there (model sinh, now kelvin_voigt)" in refused(
        *good, "--model", "kelvin_voigt"
    )
    new: Arguments = ["--out", tmp_path / "new"]
    assert (
        refused(*good)
        == "neither a model nor a base is given, wanted a model to identify, or a base to diagnose"
    )
    assert "both a model and a base are given" in refused(*sinh, "--base", "sinh")
    assert "the model is 'sin'" in refused(*good, "--model", "sin")
    nothing = refused("batch", tmp_path, "--model", "sinh", *new)
    assert f"a folder without recordings ({out.name}: results of mre-core batch), wanted" in nothing
    assert "nowhere: cannot be read: No such file" in refused("batch", tmp_path / "nowhere", *sinh[2:], *new)
    assert "--seeds 3:1" in refused(*sinh, *new, "--seeds", "3:1")
    assert "both a seed and seeds" in refused(*sinh, *new, "--seeds", "1:3", "--seed", "1")
    assert "budget is -1.0 s" in refused(*sinh, *new, "--budget", "-1")
    assert "workers is 0" in refused(*sinh, *new, "--workers", "0")
    assert (
        refused(*sinh, *new, "--false-alarm", "0.1")
        == "--false-alarm with --model, wanted no --false-alarm there"
    )
    assert refused(*sinh, *new, "--fixed") == "--fixed with --model, wanted no --fixed there"
    assert "--fish with --optimizer exact" in refused(*sinh, *new, "--fish", "9")
    assert "--bootstrap with --base" in refused(
        "batch", five, "--base", "sinh", "--bootstrap", "9", "--quiet", *new
    )
    for wrong in ({"budget": "x"}, {"budget": float("nan")}, {"workers": "x"}, {"workers": 1.5}):
        with pytest.raises(InputError, match=f"{next(iter(wrong))} is "):
            mre_core.batch(five, tmp_path / "new", model="sinh", **wrong)
    with sqlite3.connect(out / "batch.sqlite3") as db:
        db.execute("update batch set version = '0.0.1'")
    db.close()
    assert "a batch of version 0.0.1 is there" in refused(*sinh)


def test_what_is_no_table(tmp_path: Path) -> None:
    (tmp_path / "x.parquet").write_text("no")
    for path, problem in [(tmp_path, "cannot be read"), (tmp_path / "x.parquet", "is no Parquet file")]:
        with pytest.raises(InputError, match=problem):
            mre_core.read_results(path)


def test_results_beside_the_recordings_are_no_items(tmp_path: Path) -> None:
    folder = recordings(tmp_path / "in", 2)
    first = mre_core.batch(folder, folder, **FAST)
    with pytest.warns(mre_core.SkippedWarning, match="results of mre-core batch"):
        second = mre_core.batch(folder, folder, **FAST)
    assert_frame_equal(lasting(first), lasting(second))
