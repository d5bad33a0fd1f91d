"""Calls of functions with arguments that cannot be."""

import os
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import mre_core as package
import numpy as np
from mre_core import InputError
from rig import SINH, made_of

from .arrays import FORCE, recording
from .made import Call

mre_core: Any = package
"""Called against its types."""
Effect, Level, Model, Problem = mre_core.Effect, mre_core.Level, mre_core.Model, mre_core.Problem

GOOD = recording(name="r")
MASKED: Any = np.ma.MaskedArray([0.0, 1.0], mask=[True, False])
SQUARE = [(-1.0, 1.0)]


def problem(says: list[str], **options: Any) -> Call:
    return Call(partial(Problem, GOOD, "sinh", **options), says)


def swarm(says: list[str], run: Any = mre_core.mafsa, **options: Any) -> Call:
    return Call(lambda: run(Problem(GOOD, "sinh"), **{"max_iterations": 1, "seed": 1} | options), says)


def typed(call: Callable[[], object], *says: str) -> Call:
    """An argument of another kind altogether."""
    return Call(call, says, TypeError)


def function(returned: Callable[[Any], Any], says: list[str], bounds: Any = SQUARE) -> Call:
    return Call(lambda: mre_core.mafsa(returned, bounds, max_iterations=1, seed=1), says)


def cost(points: Any) -> Any:
    return points[:, 0]


def recursive(points: Any) -> Any:
    return recursive(points)


def level(**other: Any) -> Mapping[str, Any]:
    return SINH | other


def many(count: int) -> Any:
    return Model("sinh", (Level(0.0, SINH),) * count)


CALLED = {
    "swarm: no fish": swarm(["n_fish is 0", "from"], n_fish=0),
    "swarm: 10^12 fish": swarm(["n_fish is 1000000000000"], n_fish=10**12),
    "swarm: no particles": swarm(["n_particles is -3"], mre_core.pso, n_particles=-3),
    "swarm: a seed below zero": swarm(["seed is -1", "2^64"], seed=-1),
    "swarm: a seed of 65 bits": swarm(["seed is 18446744073709551616"], seed=2**64),
    "swarm: a seed that is a fraction": swarm(["seed is 1.5", "whole number"], seed=1.5),
    "swarm: a range of NaN": swarm(["visual"], visual=np.nan),
    "swarm: a crowd of nobody": swarm(["crowd is"], crowd="x"),
    "swarm: a start of NaN": swarm(["x0 is NaN", "finite"], x0=[np.nan] * 5),
    "swarm: a start of other length": swarm(["x0 is", "5"], x0=[1.0]),
    "swarm: no evaluation": swarm(["max_evaluations is 0"], max_evaluations=0),
    "swarm: an endless time": swarm(["time_limit is inf"], time_limit=np.inf),
    "swarm: 10^9 threads": swarm(["threads is 1000000000"], threads=10**9),
    "swarm: an answer to Ctrl-C of nobody": swarm(["on_interrupt is"], on_interrupt="x"),
    "swarm: an option of nobody": typed(
        lambda: mre_core.mafsa(cost, SQUARE, fishes=3),
        "mafsa()",
        "'fishes'",
    ),
    "swarm: a count that is a fraction": typed(swarm([], n_fish=1.5).call, "n_fish is 1.5", "a whole number"),
    "swarm: a number for a text": typed(swarm([], search=3).call, "search is 3", "a text"),
    "stream: a stroke of 400 digits": typed(
        lambda: mre_core.Problem.streamed([], 10**400), "largest_displacement", "too many digits"
    ),
    "swarm: a problem that is none": typed(lambda: mre_core.mafsa(3), "problem is a int"),
    "function: no bounds": function(cost, ["bounds are missing", "(lower, upper)"], None),
    "function: bounds reversed": function(cost, ["x[0]", "1"], [(1, 0)]),
    "function: bounds of NaN": function(cost, ["x[0]", "NaN"], [(0, np.nan)]),
    "function: bounds of 1e308": function(cost, ["x[0]", "1e308", "1e100"], [(0, 1e308)]),
    "function: bounds with a mask": function(cost, ["bounds are masked"], [MASKED]),
    "function: bounds of words": function(cost, ["bounds cannot be read"], [("a", "b")]),
    "function: three costs for fifty": function(lambda p: p[:3, 0], ["returned 3 costs", "wanted 50"]),
    "function: no costs": function(lambda p: None, ["value of the function is NoneType"]),
    "function: complex costs": function(lambda p: p[:, 0] + 1j, ["complex128", "numbers"]),
    "function: one that calls itself": Call(
        function(recursive, []).call, ["maximum recursion depth"], RecursionError
    ),
    "problem: no recordings": Call(lambda: Problem([], "sinh"), ["recordings", "at least one"]),
    "problem: no such model": Call(lambda: Problem(GOOD, "cinh"), ["'cinh'", "sinh"]),
    "problem: bounds of nobody": problem(["'x'", "beta"], bounds={"x": (0, 1)}),
    "problem: bounds of NaN": problem(["beta", "NaN", "finite"], bounds={"beta": (np.nan, 1)}),
    "problem: bounds of 1e308": problem(["F0", "-1e308:1e308", "1e100"], bounds={"F0": (-1e308, 1e308)}),
    "problem: a bound without the other": problem(
        ["number of bounds of c0 is 1", "two"], bounds={"c0": (1.0,)}
    ),
    "problem: bounds with a mask": problem(["bounds of c0 is masked_array"], bounds={"c0": MASKED}),
    "problem: weights of nobody": problem(["weights is 'x'", "'samples'"], weights="x"),
    "problem: another number of weights": problem(["weights", "1"], weights=[1.0, 2.0]),
    "problem: weights below zero": problem(["weight", "-1"], weights=[-1.0]),
    "problem: another number of parameters": Call(
        lambda: Problem(GOOD, "sinh").fitness([0.1] * 4), ["x is list", "(n, 5)"]
    ),
    "identify: no recordings": Call(lambda: mre_core.identify([]), ["recordings are an empty list"]),
    "identify: numbers for recordings": typed(
        lambda: mre_core.identify([3]),
        "recordings hold 3 at place 0",
        "a Recording",
    ),
    "identify: nothing for recordings": typed(
        lambda: mre_core.identify(None),
        "recordings are None",
        "a Recording",
    ),
    "diagnose: a text for recordings": typed(
        lambda: mre_core.diagnose("a.csv"),
        "recordings are 'a.csv'",
        "a Recording",
    ),
    "loops: an array for recordings": typed(
        lambda: mre_core.loops(np.zeros(5)),
        "recordings hold 0.0 at place 0",
    ),
    "fit_laws: a text for recordings": typed(
        lambda: mre_core.fit_laws("abc"),
        "recordings are 'abc'",
    ),
    "simulate: no recording": typed(
        lambda: mre_core.simulate(many(1), None),
        "recording is None",
    ),
    "identify: no such optimizer": Call(
        lambda: mre_core.identify(GOOD, optimizer="x"),
        ["optimizer is 'x'", "hybrid"],
    ),
    "diagnose: the same recording twice": Call(
        lambda: mre_core.diagnose([GOOD, GOOD]), ["a recording is given twice"]
    ),
    "diagnose: a false alarm that is a word": Call(
        lambda: mre_core.diagnose(GOOD, false_alarm="a"),
        ["false_alarm is 'a'", "below 0.5"],
    ),
    "model: no levels": Call(lambda: Model("sinh", ()), ["no levels", "at least one"]),
    "model: the same current twice": Call(lambda: many(2), ["0 A twice", "one level a current"]),
    "model: a current that is a word": Call(
        lambda: Model("sinh", (Level("a", SINH),)),
        ["current of a level is 'a'"],
    ),
    "model: a current that is NaN": Call(
        lambda: Model("sinh", (Level(np.nan, SINH),)), ["current of a level is nan", "finite"]
    ),
    "model: a number for a level": typed(lambda: Model("sinh", (3,)), "levels hold 3", "a Level"),
    "model: a text for what was tested": typed(
        lambda: Model("sinh", (Level(0.0, SINH),), "far"), "tested is 'far'", "a mapping"
    ),
    "model: a parameter that is a word": Call(
        lambda: Model("sinh", (Level(0.0, level(c0="a")),)), ["c0 is 'a'", "a finite number"]
    ),
    "model: a parameter below its limit": Call(
        lambda: made_of("sinh", level(c0=-1.0)), ["c0 is -1", "from 0"]
    ),
    "model: a number for an effect": typed(
        lambda: Model("sinh", (Level(0.0, SINH),), {}, (3,), {"a": 1}),
        *("effects hold 3", "an Effect"),
    ),
    "effect: a parameter that is a word": Call(
        lambda: Effect("inertia", "moving mass", {"m": "a"}),
        ["m of inertia is 'a'"],
    ),
    "load: a name that is no text": Call(
        lambda: mre_core.load(os.fsdecode(b"\xff.csv")), ["its name is no text in UTF-8"], InputError
    ),
    "load: a name with a null byte": Call(
        lambda: mre_core.load("a\0.csv"), ["a?.csv: its name is no text"], InputError
    ),
    "uncertainty: a force that cannot be computed": Call(
        lambda: mre_core.uncertainty(Problem(GOOD, "bouc_wen"), [1.0, 1.0, 1.0, 1e9, 0.5, 2.0, 0.0]),
        ["recording 'r': the force of bouc_wen cannot be computed", "for these parameters"],
    ),
    "certificate: an array for a result": typed(
        lambda: mre_core.certificate(Problem(GOOD, "sinh"), np.zeros(5)), "result is [0.", "the SwarmResult"
    ),
    "inertia_weight: below zero": Call(lambda: mre_core.inertia_weight(-1, 9, 1), ["iteration is -1", "0"]),
    "inertia_weight: of no iterations": Call(
        lambda: mre_core.inertia_weight(0, 0, 1), ["iterations is 0", "from 1"]
    ),
    "fit_laws: a bound without the other": Call(
        lambda: mre_core.fit_laws(
            [recording(current=1.0), recording(current=2.0, force=FORCE[::-1])], bounds={"c0": (1,)}
        ),
        ["bounds of c0 are (1,)", "(lower, upper)"],
    ),
    "fit_laws: laws that are a text": typed(
        lambda: mre_core.fit_laws(recording(current=1.0), laws="linear"), "laws is 'linear'", "a mapping"
    ),
    "load: a number": typed(lambda: mre_core.load(3), "PathLike", "int"),
    "read_chunks: no file": Call(lambda: list(mre_core.read_chunks("no.csv")), ["no.csv"], InputError),
    "read_results: no folder": Call(lambda: mre_core.read_results("no"), ["no"], InputError),
    "batch: no folder": Call(
        lambda: mre_core.batch("no", "new", model="sinh"), ["no: cannot be read"], InputError
    ),
}
