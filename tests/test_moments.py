"""Ctrl-C and SIGTERM at random moments: status 130, whole files, nobody left at work, and batches go on."""

import importlib
import random
import signal
from dataclasses import replace
from pathlib import Path
from typing import Any

import mre_core
import pandas as pd
import pytest
from moments.jobs import JOBS
from moments.stop import SIGNALS, check, stop
from mre_core import Recording, StopReason
from mre_core.interruption import uninterrupted
from mre_core.output import staged
from rig import Cli, everything_in, run_script


@pytest.mark.parametrize("name", sorted(set(JOBS) - {"trial run, one process"}))
def test_stopped(name: str, tmp_path: Path) -> None:
    # More of them by `python -m moments 200`.
    draw = random.Random(name)
    job = JOBS[name]
    job.prepare(tmp_path)
    found = stop(job.arguments, tmp_path, draw.uniform(0, job.span), draw.choice(SIGNALS))
    check(found, tmp_path)


def test_a_batch_goes_on(tmp_path: Path, cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    job = JOBS["batch"]
    job.prepare(tmp_path)
    for moment, number in zip((0.8, 1.0), SIGNALS, strict=True):
        check(stop(job.arguments, tmp_path, moment, number), tmp_path)
    monkeypatch.chdir(tmp_path)
    for out in ("out", "never_stopped"):
        assert cli(*job.arguments[:-1], out, "--quiet")[0] == 0
    stopped, never = (mre_core.read_results(tmp_path / out) for out in ("out", "never_stopped"))
    same = [name for name in never if not str(name).endswith("time") and name != "settings"]
    pd.testing.assert_frame_equal(stopped[same], never[same])
    assert (never["status"] == "done").sum() == 8


def test_a_signal_waits_for_a_short_piece_of_work() -> None:
    code = """
import os, signal
from mre_core import Recording, StopReason
from mre_core.interruption import Interruptions, uninterrupted
signal.signal(signal.SIGINT, signal.default_int_handler)
with Interruptions():
    for number in (signal.SIGINT, signal.SIGTERM):
        done = False
        try:
            with uninterrupted():
                os.kill(os.getpid(), number)
                done = True
            print("not raised")
        except KeyboardInterrupt:
            print(done)
print(signal.getsignal(signal.SIGTERM) is signal.SIG_DFL)
"""
    run = run_script(code)
    assert (run.returncode, run.stdout, run.stderr) == (0, "True\nTrue\nTrue\n", "")


def test_a_signal_that_falls_into_a_finalizer_is_raised_after_it() -> None:
    code = """
import os, signal, time, weakref
from mre_core.interruption import Interruptions
class Thing: pass
signal.signal(signal.SIGINT, signal.default_int_handler)
with Interruptions():
    for number in (signal.SIGINT, signal.SIGTERM):
        thing = Thing()
        watch = weakref.ref(thing, lambda _: os.kill(os.getpid(), number))
        try:
            del thing
            time.sleep(5)
            print("not raised")
        except KeyboardInterrupt:
            print("raised")
"""
    run = run_script(code)
    assert (run.returncode, run.stdout, run.stderr) == (0, "raised\nraised\n", "")


def test_what_is_moved_is_moved_together(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    import os

    moved = os.replace

    def interrupted(*paths: Path) -> None:
        signal.raise_signal(signal.SIGINT)
        moved(*paths)

    monkeypatch.setattr(os, "replace", interrupted)
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        with pytest.raises(KeyboardInterrupt), staged(tmp_path / "out") as stage:
            for name in ("a", "b", "c"):
                stage.path(name).write_text("new")
    finally:
        signal.signal(signal.SIGINT, before)
    assert everything_in(tmp_path) == {"out", "out/a", "out/b", "out/c"}


def test_in_other_threads_nothing_changes() -> None:
    from threading import Thread

    before = signal.getsignal(signal.SIGINT)

    def work() -> None:
        with uninterrupted():
            assert signal.getsignal(signal.SIGINT) is before

    thread = Thread(target=work)
    thread.start()
    thread.join()


def test_a_signal_after_the_swarm_counts(monkeypatch: pytest.MonkeyPatch, sinh_4mm: Recording) -> None:
    # Ctrl-C while the swarm's result is compared with the exact optimum.
    module = importlib.import_module("mre_core.identify")
    exact = mre_core.exact

    def stopped(*given: Any, **options: Any) -> mre_core.SwarmResult:
        return replace(exact(*given, **options), reason=StopReason.INTERRUPTED)

    monkeypatch.setattr(module, "exact", stopped)
    found = mre_core.identify(sinh_4mm, optimizer="pso", seed=1, max_iterations=2, on_interrupt="return")
    assert found.interrupted
    assert found.result.optimum is None
