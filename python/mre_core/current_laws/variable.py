"""What laws run over: the current, or in its place the temperature or the amplitude."""

from typing import Literal

import numpy as np
from numpy.typing import NDArray

from .._core import Recording
from ..checks import choice
from ..errors import InputError
from ..grouping import same_level

Over = Literal["current", "temperature", "amplitude"]
UNITS = {"current": "A", "temperature": "degC", "amplitude": "mm"}


def check_over(over: str) -> None:
    """Refuse what laws do not run over."""
    choice(over, "over", UNITS)


def series_of(recording: Recording, over: str) -> NDArray[np.float64]:
    """Values of the variable: one, or one a sample where it changes within the recording.

    The amplitude is the largest displacement in absolute value.

    Raises
    ------
    InputError
        The recording does not say.
    """
    if over == "amplitude":
        return np.array([np.abs(recording.displacement).max()])
    known = recording.current if over == "current" else recording.temperature
    if known is None:
        wanted = f"a column of it, {over}=VALUE[{UNITS[over]}], or {{{over}}} in a name pattern"
        raise InputError(f"recording '{recording.name}' has no {over}", wanted=wanted)
    values = np.atleast_1d(np.asarray(known, dtype=np.float64))
    if over == "current":
        steady = not recording.current_varies
    else:
        steady = same_level(float(values.min()), float(values.max()))
    return np.array([values.mean()]) if steady else values
