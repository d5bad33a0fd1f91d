"""Limits that a user gives the next test."""

from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np

from ._core import Recording
from .checks import choice
from .errors import InputError, shown
from .stored import number

LEAST, MOST = 1e-6, 1e9
"""Of every limit: nine digits behind the point are written."""
UNITS: Final = {"stroke": "mm", "speed": "mm/s", "highest": "Hz", "duration": "s", "current": "A"}
FASTEST = 0.1
"""Highest frequency over the sampling rate: fewer samples a cycle do not show a model."""
ROUNDED = 1.01
"""A stroke may be so many times the largest that was recorded."""
LONGEST = 200_000
"""Samples of a test that is proposed, or"""
USUAL = 40.0
"""s, the longest test that is proposed without limits."""


def limited(name: str, value: Any) -> float:
    """Check one limit.

    Raises
    ------
    MreError
        It is not a positive number of usable size.
    """
    found = number(value, name)
    if not LEAST <= found <= MOST:
        raise InputError(f"{name} is {shown(found)}", wanted=f"a number from {LEAST:g} to {MOST:g}")
    return found


def ends(current: Any) -> tuple[float, float]:
    """Check the lowest and the highest current in A.

    Raises
    ------
    MreError
        There are not two of them in this order.
    """
    if isinstance(current, list | tuple) and len(current) == 2:
        low, high = (number(end, "current_A") for end in current)
        if -MOST <= low <= high <= MOST:
            return low, high
    raise InputError(f"current_A is {shown(current)}", wanted="the lowest and the highest current")


def limits_for(
    given: Mapping[str, float | tuple[float, float]], recordings: Sequence[Recording], *, fixed: bool
) -> dict[str, Any]:
    """Check limits by name, and those of the current apart from them.

    Raises
    ------
    MreError
        A name or a value that cannot be used with these recordings, or beyond what they show of the device.
    """
    if not isinstance(given, Mapping):
        raise TypeError(f"limits are {shown(given)}: wanted limits by name, such as {{'stroke': 5.0}}")
    names = [choice(name, "limits", list(UNITS)) for name in given]
    found = {name: limited(name, given[name]) for name in names if name != "current"}
    far = max(float(np.abs(recording.displacement).max()) for recording in recordings)
    if (stroke := found.get("stroke", 0.0)) > ROUNDED * far:
        wanted = f"at most {far:.6g} mm, which was tested: beyond it no model is known"
        raise InputError(f"stroke is {stroke:g} mm", wanted=wanted)
    rate = max(recording.sampling_rate for recording in recordings)
    if (highest := found.get("highest", 0.0)) > FASTEST * rate:
        wanted = f"at most {FASTEST * rate:g} Hz: ten samples a cycle"
        raise InputError(f"highest is {highest:g} Hz at {rate:g} samples a second", wanted=wanted)
    longest = max(LONGEST / rate, USUAL)
    if (duration := found.get("duration")) is not None and not 16 / rate <= duration <= longest:
        wanted = f"from {16 / rate:g} to {longest:g} s"
        raise InputError(f"duration is {duration:g} s at {rate:g} samples a second", wanted=wanted)
    if "current" not in given:
        return {"limits": found}
    return {"limits": found, "limit_current": _of_current(given["current"], recordings, fixed=fixed)}


def _of_current(given: Any, recordings: Sequence[Recording], *, fixed: bool) -> tuple[float, float]:
    low, high = ends(given)
    known = [np.asarray(recording.current) for recording in recordings if recording.current is not None]
    tested = (min(map(np.min, known)), max(map(np.max, known))) if known else (0.0, 0.0)
    if not any(recording.current_varies for recording in recordings) and not (
        fixed and tested[0] < tested[1]
    ):
        wanted = "none: a test that changes the current is proposed where it changes in a recording"
        raise InputError(f"limits of the current are {shown(given)}", wanted=wanted)
    if low < tested[0] or high > tested[1] or low == high:
        wanted = f"a range within {tested[0]:g} to {tested[1]:g} A, which was tested"
        raise InputError(f"limits of the current are {shown(given)}", wanted=wanted)
    return low, high
