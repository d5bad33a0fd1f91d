"""Whether the first place that is told of a mismatch is where it is, for effects that have a place.

A jump has its moment in its recording, an end stop the displacements beyond its gap, clipping the forces at
its level, a bump its position in its direction: the place told has to hold a sample there, and be narrow.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import mre_core
import numpy as np
from judge import recordings_of
from mre_core import Recording
from numpy.typing import NDArray
from plans import Trial

Mask = NDArray[np.bool_]

SPAN = 0.25
"""Of the range of displacements, or of the duration: a place is not wider."""
CLIPPED = 0.98
"""Share of the level from which a noisy sample counts as clipped."""


@dataclass(frozen=True)
class Located:
    """What was told of a trial first."""

    trial: Trial
    right: bool
    told: str
    """Kind of the first place; empty where none is told."""


def run(trial: Trial) -> Located:
    """Diagnose, and look at the first entry of `where`."""
    made = trial.case.simulate()
    recordings = recordings_of(made)
    found = mre_core.diagnose(recordings, trial.case.base, seed=1, false_alarm=trial.false_alarm, threads=1)
    if not found.where:
        return Located(trial, False, "")
    first = found.where[0]
    acts = _ACTS[trial.case.effects[0]]
    hit = any(
        np.any(_inside(first, recording) & acts(made.effects[0].parameters, recording, place))
        for place, recording in enumerate(recordings)
    )
    return Located(trial, hit and _narrow(first, recordings), str(first["kind"]))


def _inside(place: Mapping[str, Any], recording: Recording) -> Mask:
    """Samples in a place."""
    if "x_mm" in place:
        (left, right), (slow, fast) = place["x_mm"], place["v_mm_s"]
        x, v = recording.displacement, recording.velocity
        return (left <= x) & (x <= right) & (slow <= v) & (v <= fast)
    if "from" in place and place["recording"] == recording.name:
        return (place["from"] <= recording.time) & (recording.time <= place["to"])
    return np.zeros(len(recording.time), dtype=bool)


def _narrow(place: Mapping[str, Any], recordings: Sequence[Recording]) -> bool:
    if "x_mm" in place:
        far = max(float(np.abs(r.displacement).max()) for r in recordings)
        return float(np.diff(place["x_mm"])[0]) <= SPAN * 2 * far
    own = next(r for r in recordings if r.name == place["recording"])
    return float(place["to"] - place["from"]) <= SPAN * float(np.ptp(own.time))


def _at_the_jump(p: Mapping[str, float], r: Recording, place: int) -> Mask:
    return (place == p["recording"]) & (np.abs(r.time - p["moment"]) <= np.diff(r.time).max())


def _at_the_stop(p: Mapping[str, float], r: Recording, place: int) -> Mask:
    sides = [p["sides"]] if p["sides"] else [1.0, -1.0]
    return np.any([side * r.displacement > p["gap"] for side in sides], axis=0)


def _at_the_level(p: Mapping[str, float], r: Recording, place: int) -> Mask:
    force = np.asarray(r.force)
    felt = p["side"] * force if "side" in p else np.abs(force)
    return felt >= CLIPPED * (1 - p["cut"]) * p["peak"]


def _at_the_bump(p: Mapping[str, float], r: Recording, place: int) -> Mask:
    return (np.abs(r.displacement - p["place"]) < 0.1 * p["width"]) & (p["side"] * r.velocity > 0)


_ACTS: dict[str, Callable[[Mapping[str, float], Recording, int], Mask]] = {
    "stiffness_jump": _at_the_jump,
    "end_stop": _at_the_stop,
    "force_clipping": _at_the_level,
    "unknown": _at_the_bump,
}
