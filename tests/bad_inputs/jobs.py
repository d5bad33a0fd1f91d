"""Calls of the functions that work for long: nothing may be begun with arguments that cannot be."""

import math
from functools import partial
from pathlib import Path
from typing import Any

import mre_core as package
import numpy as np
from mre_core.next_test import command
from mre_core.study import Effort, study
from mre_core.trial import make_trial, run_trial

from .arrays import recording
from .calls import typed
from .made import Call, instead

mre_core: Any = package
"""Called against its types, as are these."""
untyped_study: Any = study
make: Any = make_trial
effort: Any = Effort

GOOD = recording(name="r")
LIMITS = {"stroke_mm": 4, "speed_mm_s": 90, "highest_hz": 10, "duration_s": 8, "rate_hz": 200}
BIG = 10**30
ARRAY = np.array(["exact", "mafsa"])


def batch(**options: Any) -> object:
    """A batch of one good recording, which is not to leave anything."""
    Path("a.csv").write_bytes(instead(1, "time_s,displacement_mm,force_N"))
    model = {} if "base" in options else {"model": "sinh", "optimizer": "exact"}
    return mre_core.batch(".", "new", **(model | options))


def in_batch(*says: str, **options: Any) -> Call:
    return Call(partial(batch, **options), says)


def diagnose(*says: str, **options: Any) -> Call:
    return Call(partial(mre_core.diagnose, GOOD, **options), says)


def identify(*says: str, **options: Any) -> Call:
    return Call(partial(mre_core.identify, GOOD, **{"optimizer": "exact"} | options), says)


def signal(*says: str, **limits: Any) -> Call:
    return Call(partial(command, {"excitation": "slow_sine", "limits": LIMITS}, **limits), says)


def trial(*says: str, **options: Any) -> Call:
    return Call(lambda: make("new", **{"cases": 1, "workers": 1} | options), says)


JOBS = {
    "identify: an array for an optimizer": identify(
        "optimizer is ['exact' 'mafsa']", "one of", optimizer=ARRAY
    ),
    "identify: 10^30 threads": identify(f"threads is {BIG}", "1 to 1024", threads=BIG),
    "identify: a text for a truth value": identify("certify is 'no'", "True or False", certify="no"),
    "identify: a number for a function": typed(
        partial(mre_core.identify, GOOD, on_level=3), "on_level is 3", "a function"
    ),
    "fitness: 10^30 threads": typed(
        lambda: mre_core.Problem(GOOD, "sinh").fitness([0.1] * 5, threads=BIG), "threads", "too many digits"
    ),
    "cut: a number of 600 digits": typed(lambda: GOOD.cut(0, 10**600), "stop", "too many digits"),
    "inertia weight: 10^30 iterations": typed(
        lambda: mre_core.inertia_weight(1, BIG, 2), "iterations", "too many digits"
    ),
    "exact: 10^30 threads": Call(
        lambda: mre_core.exact(mre_core.Problem(GOOD, "sinh"), threads=BIG), ["threads is 1000", "1 to 1024"]
    ),
    "bootstrap: 10^30 replicates": Call(
        lambda: mre_core.bootstrap(mre_core.Problem(GOOD, "sinh"), [0.1] * 5, BIG), ["replicates is 1000"]
    ),
    "model: an array for a name": Call(lambda: mre_core.Model(ARRAY, ()), ["model is ['exact'", "sinh"]),
    "fit_laws: an array for weights": Call(
        lambda: mre_core.fit_laws(GOOD, weights=ARRAY), ["weights is ['exact'", "samples, force"]
    ),
    "diagnose: a number for a function": typed(
        partial(mre_core.diagnose, GOOD, on_stage=3), "on_stage is 3", "a function"
    ),
    "diagnose: 10^30 threads": diagnose(f"threads is {BIG}", "1 to 1024", threads=BIG),
    "diagnose: a number of 400 digits": diagnose("false_alarm is 1000", "below 0.5", false_alarm=10**400),
    "diagnose: a number of 5000 digits": diagnose(
        "seed is unprintable (int)", "a whole number", seed=10**5000
    ),
    "diagnose: an array for a truth value": diagnose("fixed is ['exact'", "True or False", fixed=ARRAY),
    "diagnose: an array for an answer to Ctrl-C": diagnose(
        "on_interrupt is ['exact'", "raise, return", on_interrupt=ARRAY
    ),
    "diagnose: an effect of nobody": diagnose(
        "without is 'magic'", "one of maxwell_relaxation", without=["magic"]
    ),
    "diagnose: a number for limits": typed(lambda: mre_core.diagnose(GOOD, limits=3), "limits are 3"),
    "diagnose: a limit below zero": diagnose("stroke is -1", "from 1e-06", limits={"stroke": -1}),
    "diagnose: a stroke that was not tested": diagnose("stroke is 900 mm", "tested", limits={"stroke": 900}),
    "diagnose: a limit of NaN": diagnose("stroke is nan", limits={"stroke": math.nan}),
    "diagnose: a frequency that few samples show": diagnose(
        "highest is 900 Hz", "ten samples a cycle", limits={"highest": 900}
    ),
    "diagnose: a test of a year": diagnose("duration is 3e+07 s", limits={"duration": 3e7}),
    "diagnose: limits of a current that never changes": diagnose(
        "limits of the current", "where it changes", limits={"current": (0, 3)}
    ),
    "diagnose: a number for effects": typed(lambda: mre_core.diagnose(GOOD, without=3), "without is 3"),
    "diagnose: a number for a base": typed(lambda: mre_core.diagnose(GOOD, base=3), "base is 3", "a Model"),
    "batch: a seed below zero": in_batch("seed is -1", "from 0", seed=-1),
    "batch: seeds that are words": in_batch("one of seeds is 'a'", "a whole number", seeds="ab"),
    "batch: a name pattern without fields": in_batch("name pattern 'x'", "no field", name_pattern="x"),
    "batch: a part of no such name": in_batch("part to exclude is 'middle'", exclude="middle"),
    "batch: a map of nobody": in_batch("map names the role 'x'", "displacement", map={"x": "a"}),
    "batch: conditions of nobody": in_batch("'x' is no condition", conditions={"x": 1}),
    "batch: a cut of one end": in_batch("cut is (1,)", "(start, stop)", cut=(1,)),
    "batch: an option that cannot be written": in_batch(
        "certify is <built-in function len>", "numbers", certify=len
    ),
    "batch: bounds that are a text": Call(
        partial(batch, bounds="x"), ["bounds is 'x'", "a mapping"], TypeError
    ),
    "batch: a number for a function": typed(partial(batch, on_progress=3), "on_progress is 3", "a function"),
    "batch: 10^30 threads": in_batch("threads is 1000", "1 to 1024", threads=BIG),
    "batch: a text for a truth value": in_batch("fixed is 'no'", "True or False", base="sinh", fixed="no"),
    "batch: a null byte": Call(
        lambda: mre_core.batch(".", "a\0b", model="sinh"), ["a?b: its name is no text"]
    ),
    "next test: nothing proposed": Call(lambda: command({}), ["the proposal: ", "has no 'excitation'"]),
    "next test: limits that are a word": Call(
        lambda: command({"excitation": "slow_sine", "limits": "x"}), ["limits is 'x'", "entries in braces"]
    ),
    "next test: a stroke of 1e-300": signal("stroke is 1e-300", "from 1e-06", stroke=1e-300),
    "next test: a speed that moves nothing": signal("the signal moves", "at least 1e-06 mm", speed=1e-6),
    "study: numbers for recordings": typed(lambda: untyped_study([3]), "recordings hold 3 at place 0"),
    "study: a number for an effort": typed(lambda: untyped_study(effort=3), "effort is 3", "an Effort"),
    "study: a number for a function": typed(
        lambda: untyped_study(on_progress=3), "on_progress is 3", "a function"
    ),
    "study: 10^30 threads": Call(lambda: untyped_study(threads=BIG), ["threads is 1000", "1 to 1024"]),
    "study: a part of a repetition": Call(lambda: effort(1.5, 1, 1), ["seeds is 1.5", "a whole number"]),
    "trial: an array for cases": typed(lambda: make("new", np.arange(3)), "cases hold 0", "Case"),
    "trial: no cases": trial("the number of cases is 0", "from 1", cases=[]),
    "trial: a seed of 129 bits": trial("seed is 3402", "a whole number", seed=2**128),
    "trial: a part of a worker": trial("workers is 1.5", "a whole number", workers=1.5),
    "trial: a number for a function": typed(lambda: make("new", 1, on_done=3), "on_done is 3", "a function"),
    "trial: a null byte": Call(lambda: make("a\0b", 1), ["a?b: its name holds a null byte"]),
    "trial: a text for a truth value": Call(
        lambda: run_trial("new", resume="no"),  # type: ignore[arg-type]
        ["resume is 'no'", "True or False"],
    ),
}
