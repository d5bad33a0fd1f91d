"""Closed cycles of a recording: from one upward passage through the middle of the stroke to the next."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Series = NDArray[np.float64]

_BAND = 0.05
"""Half-width about the middle, as a share of the largest half stroke, within which noise is no passage."""
_REPEATS = 0.05
"""Largest rms difference, as a share of the half stroke, of two periods that repeat each other."""
_ENOUGH = 0.25
"""Share of a neighbouring period that has to be there for a comparison."""
_PHASES = 64


@dataclass(frozen=True)
class Cycle:
    """Times in s at which the displacement passes its middle (mm): upwards, downwards, upwards."""

    start: float
    turn: float
    stop: float
    middle: float


def find_cycles(time: Series, displacement: Series) -> list[Cycle]:
    """Find the closed cycles: those whose motion a neighbouring period repeats, or the only one.

    Ramps, incomplete cycles and motion that does not repeat are left out.

    Parameters
    ----------
    time, displacement : (n,) ndarray
        Samples in s and mm.

    Returns
    -------
    list of Cycle
        In the order of time; empty where nothing repeats.
    """
    middle = float(displacement.max() + displacement.min()) / 2
    passages = _passages(time, displacement - middle)
    ups = [i for i, (_, upward) in enumerate(passages[:-2]) if upward]
    cycles = [Cycle(passages[i][0], passages[i + 1][0], passages[i + 2][0], middle) for i in ups]
    return [cycle for cycle in cycles if _is_closed(cycle, time, displacement)]


def _is_closed(cycle: Cycle, time: Series, x: Series) -> bool:
    """Tell whether the motion a period before or after a cycle is the same, or there is none."""
    period = cycle.stop - cycle.start
    t = cycle.start + np.arange(_PHASES) / _PHASES * period
    own = np.interp(t, time, x)
    alike = []
    for other in (t - period, t + period):
        there = (other >= time[0]) & (other <= time[-1])
        if np.count_nonzero(there) >= _ENOUGH * _PHASES:
            difference = np.interp(other[there], time, x) - own[there]
            alike.append(float(np.sqrt(np.mean(difference**2))) < _REPEATS * float(np.ptp(own)) / 2)
    return any(alike) or not alike


def _passages(time: Series, x: Series) -> list[tuple[float, bool]]:
    """Find when x passes zero from one side of the band to the other, and whether upwards."""
    band = _BAND * float(np.abs(x).max())
    side = np.where(x > band, 1, np.where(x < -band, -1, 0))
    outside = np.flatnonzero(side)
    if len(outside) == 0:
        return []
    changes = np.flatnonzero(np.diff(side[outside]))
    pairs = [(int(outside[i]), int(outside[i + 1])) for i in changes]
    found = [(_passage(time, x, i, j), bool(side[j] > 0)) for i, j in pairs]
    # A recording may begin and end on a passage.
    first, last = int(outside[0]), int(outside[-1])
    if _near(x, 0, 1):
        found.insert(0, (_passage(time, x, 0, first), bool(side[first] > 0)))
    if last < len(x) - 1 and _near(x, len(x) - 1, len(x) - 2):
        found.append((_passage(time, x, last, len(x) - 1), bool(side[last] < 0)))
    return found


def _near(x: Series, end: int, inner: int) -> bool:
    """Tell whether an end lies on zero, to within the step beside it."""
    return abs(float(x[end])) <= abs(float(x[end] - x[inner]))


def _passage(time: Series, x: Series, i: int, j: int) -> float:
    """Time at which the line through the samples from i to j is zero."""
    if j <= i:
        return float(time[i])
    t, y = time[i : j + 1], x[i : j + 1]
    rise = y - y.mean()
    slope = float(rise @ (t - t.mean())) / float(rise @ rise)
    return float(np.clip(t.mean() - slope * y.mean(), t[0], t[-1]))
