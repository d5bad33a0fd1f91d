"""Arrays of which no recording can be made."""

from collections.abc import Mapping
from functools import partial
from typing import Any

import numpy as np
from mre_core import Problem, Recording, identify, simulate
from rig import SINH, made_of

from .made import Call

TIME = np.arange(200) / 100
X = 2 * np.sin(9 * TIME)
FORCE = 11 * X + np.cos(9 * TIME)
SERIES: Mapping[str, Any] = {"time": TIME, "displacement": X, "force": FORCE}


stream: Any = Problem.streamed
masked: Any = np.ma.MaskedArray


def put(values: Any, value: float, at: int = 7) -> Any:
    """The same with one other sample."""
    return np.where(np.arange(len(values)) == at, value, values)


def recording(**other: Any) -> Recording:
    return Recording(**{**SERIES, **other})


def bad(says: list[str], **other: Any) -> Call:
    return Call(partial(recording, **other), says)


def fitted(**other: Any) -> object:
    return identify(recording(**other), "sinh", optimizer="exact")


ARRAYS = {
    "NaN in one sample": bad(["force is NaN at sample 7", "finite"], force=put(FORCE, np.nan)),
    "infinity in one sample": bad(["displacement is inf at sample 7"], displacement=put(X, np.inf)),
    "1e300 in one sample": bad(["force is 1e300 at sample 7", "within 1e30"], force=put(FORCE, 1e300)),
    "1e300 throughout": bad(["displacement is", "e299 at sample 1", "within 1e30"], displacement=X * 1e300),
    "time of 1e300 s": bad(["time is 1e300 at sample 1", "within 1e30"], time=np.arange(200) * 1e300),
    "steps of 1e-300 s": bad(
        ["velocity from the displacement is", "at sample", "within 1e30"], time=TIME * 1e-300
    ),
    "a displacement of denormal numbers": bad(
        ["displacement changes by", "e-3", "at least 1e-30 mm"], displacement=X * 5e-324
    ),
    "a force of denormal numbers": Call(
        partial(fitted, force=FORCE * 1e-310), ["the force is at most", "e-309 N", "below 1e-30 N"]
    ),
    "no force at all": Call(partial(fitted, force=FORCE * 0), ["the force is 0 N throughout"]),
    "a force is missing": Call(partial(fitted, force=None), ["there is no force", "a measured force"]),
    "one sample": bad(["1 samples: at least 8"], time=[0.0], displacement=[1.0], force=[1.0]),
    "no sample": bad(["0 samples: at least 8"], time=[], displacement=[], force=[]),
    "other lengths": bad(["force has 199 samples, but time has 200"], force=FORCE[:-1]),
    "two dimensions": bad(
        ["force is an array of shape (2, 200) of float64", "one-dimensional"], force=np.stack([FORCE, FORCE])
    ),
    "no dimension": bad(["force is an array of shape ()", "one-dimensional"], force=np.array(3.0)),
    "words": bad(["force is an array of shape (200,) of <U3", "numbers"], force=np.array(["1.0"] * 200)),
    "objects that are no numbers": bad(
        ["force is an array of shape (200,) of object"], force=np.array(["a"] * 200, dtype=object)
    ),
    "complex numbers": bad(["of complex128", "numbers"], force=FORCE + 1j),
    "dates": bad(["time is an array", "datetime64", "numbers"], time=np.arange(200).astype("M8[ms]")),
    "a masked array": bad(["force is an array", "numbers"], force=masked(FORCE, mask=FORCE > 20)),
    "nothing": bad(["displacement is NoneType", "one-dimensional"], displacement=None),
    "a mapping": bad(["time is dict"], time={}),
    "time that stands": bad(["time goes from 0.06 s to 0.06 s at sample 7"], time=put(TIME, 0.06)),
    "time that runs backward": bad(["time goes from 1.99 s to 1.98 s at sample 1"], time=TIME[::-1]),
    "time without digits for its steps": bad(
        ["time goes from", "at sample 1", "increase"], time=1e18 + np.arange(200)
    ),
    "a device that does not move": bad(["displacement is 3 mm throughout"], displacement=X * 0 + 3),
    "no velocity though it moves": Call(
        partial(fitted, velocity=X * 0), ["velocity is zero throughout, though"]
    ),
    "a current that is NaN": bad(["current is NaN at sample 0"], current=np.nan),
    "a current that is a word": bad(["current is str"], current="high"),
    "a current of another length": bad(["current has 5 samples, but time has 200"], current=TIME[:5]),
    "a temperature of 1e300": bad(["temperature is 1e300", "within 1e30"], temperature=1e300),
    "a temperature below absolute zero": bad(
        ["temperature is -300 degC", "at least -273.15 degC"], temperature=-300.0
    ),
    "one sample below absolute zero": bad(
        ["temperature is -274 degC at sample 7"], temperature=put(TIME, -274.0)
    ),
    "a name that is no text": Call(partial(recording, name=3), ["'int' object", "'str'", "name"], TypeError),
    "a part that is not there": Call(
        lambda: recording(name="r").cut(5, 6), ["recording 'r': cut is 5 s to 6 s", "0 s to 1.99 s"]
    ),
    "a part of no such name": Call(
        lambda: recording().exclude("middle"), ["part to exclude is 'middle'", "start_transient"]
    ),
    "a stream that leaves its bound": Call(
        lambda: Problem.streamed([(X, X, FORCE)], 1.0),
        ["chunk 0: displacement at sample", "largest_displacement of 1 mm"],
    ),
    "a stream with 1e300": Call(
        lambda: Problem.streamed([(X, X, put(FORCE, 1e300))], 9.0), ["chunk 0: force is 1e300 at sample 7"]
    ),
    "a stream of nothing": Call(lambda: Problem.streamed([], 9.0), ["0 samples: at least 8"]),
    "a stream of something else": Call(
        lambda: stream([3], 9.0),
        ["chunk is int", "(displacement, velocity, force)"],
    ),
    "a motion too fast for the model": Call(
        lambda: simulate(made_of("sinh", SINH | {"beta": 1000.0}), recording(name="r")),
        ["recording 'r'", "cannot be computed at", "too large, for these parameters"],
    ),
}
