"""The command signal of the test that a diagnosis proposes."""

import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from . import _core
from .errors import InputError
from .limits import LEAST, ends, limited
from .stored import conform, read_json

MOST_SAMPLES = 10_000_000
PROPOSAL: Final[Any] = {"excitation": str, "limits": {}}


@dataclass(frozen=True)
class Command:
    """A command signal for a test machine."""

    excitation: str
    time: NDArray[np.float64]
    """s, shape (n,)."""
    displacement: NDArray[np.float64]
    """mm, shape (n,)."""
    current: NDArray[np.float64] | None
    """A, shape (n,), where it is commanded."""


def command(
    proposal: Mapping[str, Any],
    *,
    stroke: float | None = None,
    speed: float | None = None,
    highest: float | None = None,
    duration: float | None = None,
    rate: float | None = None,
    current: tuple[float, float] | None = None,
) -> Command:
    """Make the signal of a proposed test, within limits.

    Parameters
    ----------
    proposal : mapping
        ``next_test`` of a diagnosis.
    stroke, speed, highest, duration, rate : float, optional
        Largest displacement in mm and speed in mm/s, highest frequency in Hz, duration in s, samples a
        second; those of the diagnosis by default.
    current : (float, float), optional
        Lowest and highest current in A, where the test commands it; those of the diagnosis by default.

    Returns
    -------
    Command
        Time in s and displacement in mm, and the current in A where it is commanded.

    Raises
    ------
    MreError
        A limit that is not positive and finite, or currents in the wrong order (a ValueError).
    """
    conform(proposal, PROPOSAL, "the proposal")
    known = proposal["limits"]
    given = {
        "stroke": (stroke, "stroke_mm"),
        "speed": (speed, "speed_mm_s"),
        "highest": (highest, "highest_hz"),
        "duration": (duration, "duration_s"),
        "rate": (rate, "rate_hz"),
    }
    limits = {
        name: limited(name, known.get(key) if value is None else value)
        for name, (value, key) in given.items()
    }
    if limits["highest"] > limits["rate"] / 2:
        raise InputError(
            f"highest is {limits['highest']:g} Hz at {limits['rate']:g} samples a second",
            wanted="less than half the rate",
        )
    if limits["rate"] * limits["duration"] < 16:
        raise InputError(
            f"duration is {limits['duration']:g} s at {limits['rate']:g} samples a second",
            wanted="at least 16 samples",
        )
    if limits["rate"] * limits["duration"] > MOST_SAMPLES:
        raise InputError(
            f"duration is {limits['duration']:g} s at {limits['rate']:g} samples a second",
            wanted=f"at most {MOST_SAMPLES} samples",
        )
    excitation, currents = str(proposal.get("excitation")), known.get("current_A")
    if current is not None:
        currents = current
    range_of_current = None if currents is None else ends(currents)
    time, displacement, steps = _core.excitation(excitation, **limits, current=range_of_current)
    if (far := np.abs(displacement).max()) < LEAST:
        found = f"the signal moves {far:g} mm with speed {limits['speed']:g} mm/s"
        raise InputError(found, wanted=f"at least {LEAST:g} mm: a larger speed or a lower highest frequency")
    return Command(excitation, time, displacement, steps)


def read_proposal(folder: str | os.PathLike[str]) -> Mapping[str, Any]:
    """Read what a diagnosis in a folder proposes.

    Raises
    ------
    MreError
        No diagnosis, or one that proposes nothing.
    """
    path = Path(folder) / "diagnosis.json"
    try:
        found = read_json(path)
    except InputError as error:
        raise InputError(str(error), wanted="a folder that `diagnose --out` has written") from None
    proposal = found.get("next_test") if isinstance(found, dict) else None
    if not (isinstance(proposal, dict) and isinstance(proposal.get("limits"), dict)):
        raise InputError(
            f"{path} proposes no test", wanted="a diagnosis with something in doubt that a test would resolve"
        )
    return proposal
