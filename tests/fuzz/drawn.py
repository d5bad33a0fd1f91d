"""Recordings, parameters and numbers as Hypothesis draws them."""

from typing import Any

import numpy as np
from hypothesis import strategies as st
from mre_core import MreError, Recording
from numpy.typing import NDArray

Array = NDArray[np.float64]

ODD = st.sampled_from([0.0, -0.0, 5e-324, 1e-300, 1e-31, 1.0, -1.0, 1e30, 1e31, 1e300, np.inf, np.nan])
"""Numbers at which something might break."""


@st.composite
def scales(draw: st.DrawFn, decades: int = 12) -> float:
    """A positive number, of about size 1 more often than not."""
    power = draw(st.one_of(st.floats(-1, 1), st.floats(-decades, decades)))
    return float(10.0**power)


numbers = st.one_of(scales(), scales().map(lambda x: -x), st.floats(0, 1), ODD)
"""Parameters, most of them admissible for something."""


@st.composite
def series(draw: st.DrawFn, time: Array) -> Array:
    """A motion or a force: sines, noise, steps, ramps, each at any scale, with or without an offset."""
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    n, span = len(time), float(time[-1] - time[0])
    turns = draw(scales(2))
    with np.errstate(all="ignore"):
        phase = 8 * np.pi * turns * (time - time[0]) / span
        shapes = {
            "sine": np.sin(phase),
            "noise": rng.normal(size=n),
            "steps": np.round(2 * np.sin(phase)),
            "ramp": np.linspace(-1, 1, n),
            "spike": (np.arange(n) == n // 2).astype(float),
            "walk": np.cumsum(rng.normal(size=n)),
            "spiky": np.sin(phase) + rng.standard_cauchy(n),
        }
        found = shapes[draw(st.sampled_from(sorted(shapes)))] * draw(scales(34))
        if draw(st.integers(0, 4)) == 0:
            found = found + draw(scales(30))
        if draw(st.integers(0, 9)) == 0:
            found[draw(st.integers(0, n - 1))] = draw(ODD)
    return np.asarray(found, dtype=np.float64)


@st.composite
def times(draw: st.DrawFn, most: int) -> Array:
    """Even or uneven times."""
    n = draw(st.integers(8, most))
    steps = np.ones(n)
    if draw(st.booleans()):
        rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
        steps = np.exp(rng.normal(0, draw(st.floats(0, 3)), size=n))
    with np.errstate(all="ignore"):
        found: Array = np.cumsum(steps) * draw(scales(32)) * 0.01 + draw(st.sampled_from([0.0, 1e3, 1.7e9]))
    return found


@st.composite
def recordings(draw: st.DrawFn, most: int = 200, *, force: bool = True) -> Recording | None:
    """A recording, or None where it was refused."""
    time = draw(times(most))
    given: dict[str, Any] = {}
    if draw(st.integers(0, 2)) == 0:
        given["velocity"] = draw(series(time))
    kind = draw(st.sampled_from(["none", "constant", "series"]))
    if kind != "none":
        given["current"] = draw(scales(3)) if kind == "constant" else draw(series(time))
    try:
        measured = draw(series(time)) if force else None
        return Recording(time, draw(series(time)), measured, name="r", **given)
    except MreError:
        return None
