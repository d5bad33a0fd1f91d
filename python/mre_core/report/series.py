"""Recordings and models as a page carries them: thinned for display, and packed."""

from base64 import b64encode
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

Values = NDArray[np.float64]

MOST_POINTS: Final = 60_000
"""Samples that a page draws, over all recordings."""
_LEAST_POINTS: Final = 300
"""Of a single recording, however many there are."""
_LARGE_FORCE: Final = 10_000.0
"""N, from which on forces are drawn in kN."""
_MOST_CELLS: Final = 28
"""Cells along each axis of the map of errors."""


@dataclass(frozen=True)
class Series:
    """One recording and the forces of models over it, shape (n,) each."""

    name: str
    time: Values
    displacement: Values
    velocity: Values
    measured: Values
    models: Mapping[str, Values]
    """Force in N by label."""


def pack(recordings: list[Series]) -> dict[str, Any]:
    """Content of the page's block of data."""
    share = max(_LEAST_POINTS, MOST_POINTS // max(1, len(recordings)))
    spare = sum(max(0, share - len(r.time)) for r in recordings)
    long = sum(len(r.time) > share for r in recordings)
    share += spare // long if long else 0
    largest = max((float(np.abs(r.measured).max()) for r in recordings), default=0.0)
    unit, newtons = ("kN", 1000.0) if largest >= _LARGE_FORCE else ("N", 1.0)
    return {
        "unit": unit,
        "models": list(recordings[0].models) if recordings else [],
        "recordings": [_pack(recording, share, newtons) for recording in recordings],
    }


def kept(series: Series, most: int) -> NDArray[np.intp]:
    """Find the samples to draw: of every stretch the extremes of force, displacement and errors.

    Parameters
    ----------
    series : Series
        n samples.
    most : int
        How many to keep.

    Returns
    -------
    (m,) ndarray
        Indices in rising order, all of them where n is at most `most`.
    """
    n = len(series.time)
    if n <= most:
        return np.arange(n)
    watched = [series.measured, series.displacement]
    watched += [series.measured - force for force in series.models.values()]
    stretches = max(1, (most - 2) // (2 * len(watched)))
    edges = np.linspace(0, n, stretches + 1).astype(np.intp)
    found = [np.array([0, n - 1])]
    for values in watched:
        for extreme in (np.argmin, np.argmax):
            picked = [a + int(extreme(values[a:b])) for a, b in pairwise(edges)]
            found.append(np.array(picked))
    return np.unique(np.concatenate(found))


def rms(values: Values) -> float:
    """Root mean square."""
    return float(np.sqrt(np.mean(values**2)))


def _pack(series: Series, most: int, newtons: float) -> dict[str, Any]:
    """Pack one recording; `newtons` are in one unit of force."""
    at = kept(series, most)
    forces = series.models.values()
    return {
        "name": series.name,
        "samples": len(series.time),
        "shown": len(at),
        "rms": [rms(series.measured - force) / newtons for force in forces],
        "time": _text(series.time[at], "<f8"),
        "displacement": _text(series.displacement[at]),
        "velocity": _text(series.velocity[at]),
        "measured": _text(series.measured[at] / newtons),
        "forces": [_text(force[at] / newtons) for force in forces],
        "map": _map(series, newtons),
    }


def _map(series: Series, newtons: float) -> dict[str, Any]:
    """Mean error over displacement and velocity, of all samples; empty cells are not numbers."""
    x, v = series.displacement, series.velocity
    cells = int(np.clip(np.sqrt(len(x)) / 3, 6, _MOST_CELLS))
    count, x_edges, v_edges = np.histogram2d(x, v, bins=cells)
    means = []
    for force in series.models.values():
        total, _, _ = np.histogram2d(x, v, bins=(x_edges, v_edges), weights=series.measured - force)
        means.append(_text(np.where(count > 0, total / np.maximum(count, 1) / newtons, np.nan).ravel()))
    ends = {"x": [x_edges[0], x_edges[-1]], "v": [v_edges[0], v_edges[-1]]}
    return {"cells": cells, "means": means} | {key: [float(e) for e in pair] for key, pair in ends.items()}


def _text(values: Values, kind: str = "<f4") -> str:
    return b64encode(np.ascontiguousarray(values, dtype=kind).tobytes()).decode("ascii")
