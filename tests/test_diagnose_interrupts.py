"""Stages of a diagnosis, and Ctrl-C at any of them: it ends soon, and what is known is written whole."""

import json
import os
import signal
import subprocess
from pathlib import Path
from typing import IO, Any

import mre_core
import pytest
from missing import campaign, write_all
from mre_core import Diagnosis, Model
from mre_core.output import to_json
from mre_core.report import report_diagnosis
from rig import command, everything_in, run_process
from test_diagnose_cli import FILES
from test_interrupts import LISTEN

FIRST = "fitting the base model"
STAGES = [
    FIRST,
    "scoring the catalogue beside the base model",
    "refitting the strongest candidates",
    "scoring the catalogue beside 1 effect",
    "refitting the strongest candidates",
    "trying other laws of the effects named",
    "proving on held-out data",
    "testing what is left",
    "locating the mismatch",
    "asking what the recordings would hide",
    "proving on held-out data",
    "looking for alternatives",
    "looking for the next test",
    "done",
]
"""Of recordings with a Maxwell branch, base sinh."""


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    return write_all(tmp_path_factory.mktemp("relaxing"), campaign()[:4])


def broken_off_at(stage: int, base: str = "sinh") -> Diagnosis:
    """A diagnosis that Ctrl-C ends when it tells of a stage."""
    told = []

    def on_stage(words: str) -> None:
        told.append(words)
        if len(told) == stage + 1:
            raise KeyboardInterrupt

    return mre_core.diagnose(campaign()[:4], base, seed=1, on_stage=on_stage, on_interrupt="return")


def test_stages_in_order() -> None:
    told: list[str] = []
    found = mre_core.diagnose(campaign()[:4], seed=1, on_stage=told.append)
    assert told == STAGES
    assert not found.interrupted
    assert found.to_dict() == mre_core.diagnose(campaign()[:4], seed=1).to_dict()


def test_lines_where_there_is_no_terminal(files: list[Path]) -> None:
    options = ["--base", "sinh", "--seed", "1"]
    run = run_process("diagnose", *files, *options)
    lines = [f"mre-core: diagnosing: {stage}" for stage in STAGES[:-1]]
    assert (run.returncode, run.stderr.splitlines()) == (0, lines)
    assert run_process("diagnose", *files, *options, "--quiet", "--json").stderr == ""


@pytest.mark.parametrize("stage", range(1, len(STAGES)))
def test_what_is_known_at_each_stage(stage: int) -> None:
    found = broken_off_at(stage)
    content = json.loads(to_json(found.to_dict()))
    # The core may be a stage or two further when it is told of one.
    if stage < STAGES.index("locating the mismatch") - 3:
        assert content["interrupted"]
    if content["verdict"] is None:
        assert content["interrupted"]
        assert content["statement"].startswith("Interrupted before a verdict")
        assert set(content["fit"].values()) == {None, "N"}
    else:
        assert content["verdict"] == "missing_physics"
        assert stage >= STAGES.index("testing what is left") - 3
    if stage > STAGES.index("testing what is left"):
        assert content["verdict"] is not None
    named = ["maxwell_relaxation"] if content["effects"] else []
    if stage >= STAGES.index("trying other laws of the effects named"):
        assert named
    assert [effect["id"] for effect in content["effects"]] == named
    assert [effect.id for effect in found.model.effects] == named
    for model in (found.base_model, found.model):
        again = Model.from_dict(json.loads(to_json(model.to_dict())))
        assert len(mre_core.simulate(again, campaign()[0])) == len(campaign()[0].time)
    assert content["statement"] in report_diagnosis(found)


def test_the_model_so_far_is_that_of_its_file() -> None:
    found = broken_off_at(STAGES.index("trying other laws of the effects named"))
    for recording, history in zip(campaign()[:4], found.histories, strict=True):
        error = mre_core.simulate(found.model, recording) - history.final
        assert abs(error).max() < 0.02 * found.histories[0].final.std()
        error = mre_core.simulate(found.base_model, recording) - history.base
        assert abs(error).max() < 1e-9


def test_nothing_is_known_before_the_base_is_fitted() -> None:
    with pytest.raises(KeyboardInterrupt):
        broken_off_at(0, "bouc_wen")


def test_an_interruption_is_raised_unless_asked_otherwise() -> None:
    def on_stage(_: str) -> None:
        os.kill(os.getpid(), signal.SIGINT)

    with pytest.raises(KeyboardInterrupt):
        mre_core.diagnose(campaign()[:4], seed=1, on_stage=on_stage)
    with pytest.raises(mre_core.MreError, match="on_interrupt is 'stop'"):
        mre_core.diagnose(campaign()[:4], on_interrupt="stop")  # type: ignore[arg-type]


def test_an_error_of_the_callback_is_raised() -> None:
    def on_stage(_: str) -> None:
        raise OSError("full")

    with pytest.raises(OSError, match="full"):
        mre_core.diagnose(campaign()[:4], seed=1, on_stage=on_stage, on_interrupt="return")


def read_until(stream: IO[str], stage: str) -> None:
    for line in stream:
        if line.strip().endswith(stage):
            return
    raise AssertionError(f"the process ended before '{stage}'")


def content_of(out: Path) -> Any:
    """Of a folder with all the files, whole."""
    assert everything_in(out) == FILES
    for name in ("model.json", "base_model.json"):
        Model.load(out / name)
    content = json.loads((out / "diagnosis.json").read_text(encoding="utf-8"))
    assert (out / "report.html").read_text(encoding="utf-8").rstrip().endswith("</html>")
    rows = (out / "residuals.csv").read_text(encoding="utf-8").splitlines()
    assert len(rows) == 1 + sum(len(r.time) for r in campaign()[:4])
    return content


@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM"])
@pytest.mark.parametrize("stage", [1, 4, 6])
def test_signal_to_the_command(tmp_path: Path, files: list[Path], stage: int, name: str) -> None:
    out = tmp_path / "result"
    arguments = command("diagnose", *files, "--base", "bouc_wen", "--seed", "1", "--out", out, before=LISTEN)
    job = subprocess.Popen(arguments, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        assert job.stderr is not None
        for before in STAGES[: stage + 1]:
            read_until(job.stderr, before)
            if before == "trying other laws of the effects named":
                break
        job.send_signal(getattr(signal, name))
        shown, _ = job.communicate(timeout=60)
    finally:
        job.kill()
    assert job.returncode == 130
    content = content_of(out)
    assert (content["interrupted"], content["verdict"]) == (True, None)
    assert content["statement"].split()[:4] == "Interrupted before a verdict".split()
    assert shown.startswith("interrupted: Interrupted before a verdict")


@pytest.mark.parametrize("share", [0.1, 0.3, 0.5, 0.7, 0.9, 0.97, 1.0])
def test_signal_at_any_moment(tmp_path: Path, files: list[Path], share: float) -> None:
    out = tmp_path / "result"
    # The moment is a share of the stages' lines that a whole run says, without waiting in between.
    arguments = command("diagnose", *files, "--base", "sinh", "--seed", "1", "--out", out, before=LISTEN)
    job = subprocess.Popen(arguments, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        assert job.stderr is not None
        for stage in STAGES[: max(1, round(share * (len(STAGES) - 1)))]:
            read_until(job.stderr, stage)
        job.send_signal(signal.SIGINT)
        _, error = job.communicate(timeout=60)
    finally:
        job.kill()
    assert "Traceback" not in error
    if not out.exists():
        assert (job.returncode, share) == (130, 0.1)
        assert error.endswith("mre-core: interrupted\n")
        return
    assert (job.returncode, content_of(out)["interrupted"]) in {(130, True), (0, False)}


SIGNALLED = f"""
{LISTEN}
import os
import mre_core.report
whole = mre_core.report.report_diagnosis
def signalled(found):
    for _ in range(TIMES):
        os.kill(os.getpid(), signal.SIGTERM)
    return whole(found)
mre_core.report.report_diagnosis = signalled
"""


def test_a_signal_while_the_results_are_written_lets_them_be(tmp_path: Path, files: list[Path]) -> None:
    out = tmp_path / "result"
    options = ["--base", "sinh", "--seed", "1", "--quiet", "--out", str(out)]
    run = run_process("diagnose", *files, *options, before=f"TIMES = 1\n{SIGNALLED}")
    assert (run.returncode, run.stderr) == (0, "")
    assert content_of(out)["interrupted"] is False


def test_a_second_signal_ends_that_too(tmp_path: Path, files: list[Path]) -> None:
    out = tmp_path / "result"
    options = ["--base", "sinh", "--seed", "1", "--quiet", "--out", str(out)]
    run = run_process("diagnose", *files, *options, before=f"TIMES = 2\n{SIGNALLED}")
    assert (run.returncode, run.stderr.strip()) == (130, "mre-core: interrupted")
    assert not out.exists()
