"""Ctrl-C in a long job: it ends soon, raises or returns as asked, and files are whole."""

import json
import signal
import subprocess
import time
from pathlib import Path

import pytest
from mre_core import Model
from mre_core.cli.main import cli, main
from rig import BOUC_WEN, command, everything_in, made_of, motion, record, run_script, write_csv

LONG_RUN = 10**6
# A process that a shell has put in the background ignores Ctrl-C.
LISTEN = "import signal; signal.signal(signal.SIGINT, signal.default_int_handler)"
# Long enough that Ctrl-C has to find its way into the middle of a generation.
LONG_JOB = f"""
import os, threading, signal
import numpy as np, mre_core
{LISTEN}
t = np.arange(200_000) / 256
recording = mre_core.Recording(t, 4 * np.sin(6 * t), 50 * np.sin(6 * t + 0.5))
problem = mre_core.Problem(recording, "bouc_wen")
threading.Timer(0.7, os.kill, (os.getpid(), signal.SIGINT)).start()
"""


def test_interrupt_raises() -> None:
    code = f"""
try:
    mre_core.mafsa(problem, seed=1, max_iterations={LONG_RUN})
except KeyboardInterrupt:
    print("KeyboardInterrupt")
"""
    run = run_script(LONG_JOB + code)
    assert (run.returncode, run.stdout, run.stderr) == (0, "KeyboardInterrupt\n", "")


@pytest.mark.parametrize("swarm", ["mafsa", "afsa", "pso"])
def test_interrupt_returns_the_best_so_far(swarm: str) -> None:
    code = f"""
recording = recording.cut(0, 20)
problem = mre_core.Problem(recording, "bouc_wen")
result = mre_core.{swarm}(problem, seed=1, max_iterations={LONG_RUN}, on_interrupt="return")
assert problem.fitness(result.x) == result.fun < np.inf, result
assert not result.success
print(result.reason)
"""
    run = run_script(LONG_JOB + code)
    assert (run.returncode, run.stdout, run.stderr) == (0, "interrupted\n", "")


@pytest.mark.parametrize("swarm", ["mafsa", "afsa", "pso"])
def test_an_interrupt_that_is_seen_when_the_run_is_through_counts(swarm: str) -> None:
    code = f"""
problem = mre_core.Problem(recording.cut(0, 1), "kelvin_voigt")
def stop(*told):
    signal.raise_signal(signal.SIGINT)
result = mre_core.{swarm}(problem, seed=1, max_iterations=1, callback=stop, on_interrupt="return")
print(result.reason)
"""
    run = run_script(LONG_JOB.rpartition("threading.Timer")[0] + code)
    assert (run.returncode, run.stdout, run.stderr) == (0, "interrupted\n", "")


def test_interrupt_of_a_function_of_the_user() -> None:
    code = f"""
def slow(points):
    import time
    time.sleep(0.01)
    return (points**2).sum(axis=1)
result = mre_core.pso(slow, [(-1, 1)], seed=1, max_iterations={LONG_RUN}, on_interrupt="return")
print(result.reason)
"""
    run = run_script(LONG_JOB + code)
    assert (run.returncode, run.stdout, run.stderr) == (0, "interrupted\n", "")


def test_interrupt_of_the_command(tmp_path: Path) -> None:
    moved = motion(cycles=200, rate=512)
    for current in (0, 1):
        write_csv(
            tmp_path / f"{current}A.csv",
            record(made_of("bouc_wen", BOUC_WEN), moved, noise=0.1, seed=current),
        )
    out = tmp_path / "result"
    files = [tmp_path / "0A.csv", tmp_path / "1A.csv"]
    options = ["--model", "bouc_wen", "--seed", "1", "--name-pattern", "{current}A", "--out", str(out)]
    arguments = command("identify", *files, *options, "--iterations", str(LONG_RUN), before=LISTEN)
    job = subprocess.Popen(arguments, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        # The work begins when the place for the results is there.
        while job.poll() is None and not list(out.glob(".mre-core-*")):
            time.sleep(0.02)
        time.sleep(0.7)
        job.send_signal(signal.SIGINT)
        shown, error = job.communicate(timeout=60)
    finally:
        job.kill()
    assert (job.returncode, error) == (130, "")
    assert "stopped by interrupted" in " ".join(shown.split())
    # Whole files of what was found so far, without figures; the current that was not begun has no level.
    assert everything_in(out) == {"model.json", "identification.json", "report.html", "settings.toml"}
    content = json.loads((out / "model.json").read_text(encoding="utf-8"))
    assert content["interrupted"] is True
    assert [level["current_A"] for level in content["levels"]] == [0.0]
    assert json.loads((out / "identification.json").read_text(encoding="utf-8"))["interrupted"] is True
    assert Model.load(out / "model.json").name == "bouc_wen"


def test_interrupt_that_comes_out_of_an_import_as_another_error(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def importing(*given: object, **more: object) -> None:
        try:
            signal.raise_signal(signal.SIGTERM)
        except KeyboardInterrupt as stop:
            raise RuntimeError("Error calling __set_name__") from stop

    monkeypatch.setattr(cli, "main", importing)
    assert main(["demo"]) == 130
    assert capsys.readouterr().err == "mre-core: interrupted\n"


def test_an_error_without_a_signal_is_none_of_an_interruption(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def failing(*given: object, **more: object) -> None:
        raise RuntimeError("no luck")

    monkeypatch.setattr(cli, "main", failing)
    assert main(["demo"]) == 1
    assert "RuntimeError: no luck" in capsys.readouterr().err


SWALLOWS = (
    "import signal\n"
    "try:\n    signal.raise_signal(signal.SIGTERM)\n    print('waited')\n"
    "except BaseException:\n    print('swallowed')\n"
)


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="needs timers of the system")
@pytest.mark.parametrize("block", ["nullcontext()", "interrupts()"])
def test_interrupt_waits_for_the_end_of_an_import(tmp_path: Path, block: str) -> None:
    (tmp_path / "swallows.py").write_text(SWALLOWS)
    code = f"""
import sys, time
from contextlib import nullcontext
from mre_core.cli.interrupts import interrupts
from mre_core.cli.main import cli, main
def late(*given, **more):
    sys.path.insert(0, {str(tmp_path)!r})
    with {block}:
        import swallows
        time.sleep(20)
cli.main = late
sys.exit(main(["demo"]))
"""
    run = run_script(code)
    assert (run.returncode, run.stdout, run.stderr) == (130, "waited\n", "mre-core: interrupted\n")


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="needs timers of the system")
def test_interrupt_does_not_wait_for_the_import_of_a_module_of_ours(tmp_path: Path) -> None:
    (tmp_path / "swallows.py").write_text(SWALLOWS)
    (tmp_path / "ours.py").write_text("import swallows\nimport time\ntime.sleep(2)\nprint('waited long')\n")
    code = f"""
import sys
import mre_core
from mre_core.cli.main import cli, main
sys.path.insert(0, {str(tmp_path)!r})
mre_core.__path__.append({str(tmp_path)!r})
def late(*given, **more):
    import mre_core.ours
cli.main = late
sys.exit(main(["demo"]))
"""
    run = run_script(code)
    assert (run.returncode, run.stdout, run.stderr) == (130, "waited\n", "mre-core: interrupted\n")


def test_interrupt_of_a_command_that_an_import_runs(tmp_path: Path) -> None:
    (tmp_path / "runs.py").write_text(
        "import signal, time\n"
        "from mre_core.cli.main import cli, main\n"
        "def late(*given, **more):\n    signal.raise_signal(signal.SIGTERM)\n    time.sleep(20)\n"
        "cli.main = late\n"
        "status = main(['demo'])\n"
    )
    run = run_script(f"import sys; sys.path.insert(0, {str(tmp_path)!r}); import runs; sys.exit(runs.status)")
    assert (run.returncode, run.stderr) == (130, "mre-core: interrupted\n")


def test_an_interruption_of_the_first_look_at_numpy_is_no_panic() -> None:
    code = """
import numpy.lib, mre_core
before = numpy.lib.NumpyVersion
def interrupted(version):
    numpy.lib.NumpyVersion = before
    raise KeyboardInterrupt
numpy.lib.NumpyVersion = interrupted
t = numpy.arange(100.0)
try:
    mre_core.Recording(t, numpy.sin(t), numpy.cos(t))
except KeyboardInterrupt:
    print("KeyboardInterrupt", len(mre_core.Recording(t, numpy.sin(t), numpy.cos(t))))
"""
    run = run_script(code)
    assert (run.returncode, run.stdout, run.stderr) == (0, "KeyboardInterrupt 100\n", "")
