"""Trials of strangers: their cases, answers and diagnoses."""

import hashlib
import json
from typing import Any

from .made import Command

RUN = ["trial", "run", "d", "--workers", "1", "--quiet"]
OPEN = ["trial", "open", "d"]
SHA = "0" * 64

CASE = {
    **{"effects": ["inertia"], "laws": ["mass"], "base": "sinh", "noise": "white", "velocity": "given"},
    **{"displacement_noise": 0.0, "excitation": "rich", "samples": None},
}
TRUTH = {
    "effects": [{"effect": "inertia", "law": "mass", "unexplained": 1.0, "parameters": {"m": 0.1}}],
    "noise_rms": 1.0,
    "reached": True,
}
FOUND = {
    "verdict": "missing_physics",
    "effects": [{"id": "inertia", "indistinguishable_from": [], "parameters": {}}],
    "fit": {"held_out_rms_before": 2.0, "held_out_rms_after": 1.0},
}


def folder(case: dict[str, Any], answer: dict[str, Any], said: dict[str, Any]) -> dict[str, bytes]:
    """A trial of one case that was run, with a seal that holds."""
    one = {"case": CASE, "truth": TRUTH, "error_shown": 0.1, "recordings_sha256": SHA} | answer
    answers = json.dumps({"schema": "mre-core/trial-answers/1", "seed": 1, "cases": {"0001": one}}).encode()
    diagnosis = {"schema": "mre-core/trial-diagnosis/1", "recordings_sha256": SHA, "seconds": 1.0}
    cases = [{"id": "0001", "base": "sinh"} | case]
    seal = hashlib.sha256(answers).hexdigest()
    trial = {"schema": "mre-core/trial/1", "seal": seal, "cases": cases}
    return {
        "d/trial.json": json.dumps(trial).encode(),
        "d/answers.json": answers,
        "d/diagnoses/0001.json": json.dumps(diagnosis | {"diagnosis": FOUND} | said).encode(),
    }


def case(*says: str, **entries: Any) -> Command:
    return Command(RUN, ["d/trial.json: ", *says], folder(entries, {}, {}))


def answer(*says: str, **entries: Any) -> Command:
    return Command(OPEN, ["d/answers.json: ", *says], folder({}, entries, {}))


def said(*says: str, **entries: Any) -> Command:
    return Command(OPEN, ["d/diagnoses/0001.json: ", *says], folder({}, {}, entries))


TRIALS = {
    "a case that is a path": case("id of a case is '../../x'", "letters and digits", id="../../x"),
    "a case that is a path from the root": case("id of a case is '/tmp/x'", id="/tmp/x"),
    "a case that is a number": case("id of cases[0] is 3", "a text", id=3),
    "half of a character": case("holds half of a character", "text", id="\ud800"),
    "a base of nobody": case("base of case 0001 is '../x.json'", "sinh", base="../x.json"),
    "answers without truth": answer("truth of 0001 of cases is None", "entries in braces", truth=None),
    "answers without noise": answer("has no 'noise_rms'", truth={"effects": [], "reached": True}),
    "answers with a word": answer("error_shown of 0001 of cases is 'x'", "a finite number", error_shown="x"),
    "answers with NaN": answer("error_shown of 0001 of cases is nan", error_shown=float("nan")),
    "answers without any noise": answer("case 0001 cannot be compared", truth=TRUTH | {"noise_rms": 0.0}),
    "effects that are numbers": answer("effects of case of 0001", "a text", case=CASE | {"effects": [3]}),
    "a diagnosis that is a word": said("diagnosis is 'x'", "entries in braces", diagnosis="x"),
    "a diagnosis without verdict": said("diagnosis has no 'verdict'", diagnosis={}),
    "a diagnosis that took no number of seconds": said("seconds is 'x'", "a finite number", seconds="x"),
    "an effect without parameters": said(
        "effects of diagnosis[0] has no 'parameters'",
        diagnosis=FOUND | {"effects": [{"id": "inertia", "indistinguishable_from": []}]},
    ),
    "a name too long": Command(["trial", "open", "x" * 300], ["holds no trial", "'trial make'"]),
    "made where names are too long": Command(
        ["trial", "make", "x" * 300, "--cases", "1"], ["cannot be written", "File name too long"]
    ),
    "a million workers": Command([*RUN, "--workers", "1000000"], ["workers is 1000000", "1 to 1024"]),
}
