"""Limits that a user gives the next test."""

from collections.abc import Mapping, Sequence
from typing import Any, Final

from ._core import Recording
from .checks import choice
from .errors import InputError, shown
from .stored import number

LEAST, MOST = 1e-6, 1e9
"""Of every limit: nine digits behind the point are written."""
UNITS: Final = {"stroke": "mm", "speed": "mm/s", "highest": "Hz", "duration": "s", "current": "A"}
FASTEST = 0.1
"""Highest frequency over the sampling rate: fewer samples a cycle do not show a model."""
LONGEST = 200_000
"""Samples of a test that is proposed."""


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
    given: Mapping[str, float | tuple[float, float]], recordings: Sequence[Recording]
) -> dict[str, Any]:
    """Check limits by name, and those of the current apart from them.

    Raises
    ------
    MreError
        A name or a value that cannot be used with these recordings.
    """
    if not isinstance(given, Mapping):
        raise TypeError(f"limits are {shown(given)}: wanted limits by name, such as {{'stroke': 5.0}}")
    names = [choice(name, "limits", list(UNITS)) for name in given]
    found = {name: limited(name, given[name]) for name in names if name != "current"}
    rate = max(recording.sampling_rate for recording in recordings)
    if (highest := found.get("highest", 0.0)) > FASTEST * rate:
        wanted = f"at most {FASTEST * rate:g} Hz: ten samples a cycle"
        raise InputError(f"highest is {highest:g} Hz at {rate:g} samples a second", wanted=wanted)
    if (duration := found.get("duration")) is not None and not 16 <= duration * rate <= LONGEST:
        wanted = f"from {16 / rate:g} to {LONGEST / rate:g} s"
        raise InputError(f"duration is {duration:g} s at {rate:g} samples a second", wanted=wanted)
    if "current" not in given:
        return {"limits": found}
    if not any(recording.current_varies for recording in recordings):
        wanted = "none: a test that changes the current is proposed where it changes in a recording"
        raise InputError(f"limits of the current are {shown(given['current'])}", wanted=wanted)
    return {"limits": found, "limit_current": ends(given["current"])}
