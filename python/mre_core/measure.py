"""How well a model follows a recording."""

from dataclasses import dataclass

import numpy as np

from ._core import Recording
from .errors import InputError
from .model import Model, simulate


@dataclass(frozen=True)
class Fit:
    """How well the model follows one recording, over the samples that are scored."""

    recording: str
    current: float | None
    """Level of the current in A; None where it is not known or changes."""
    samples: int
    rms: float
    """Root mean square error in N (eq. 9)."""
    relative_rms: float
    """The same as a share of the force's root mean square about its mean; infinite for a constant force."""
    peak_error: float
    """Largest error as a share of the largest force."""


def measure_fit(model: Model, recording: Recording) -> Fit:
    """Compare a model with the force of a recording, over the samples that are scored."""
    scored = slice(*recording.scored)
    if recording.force is None:
        raise InputError(f"recording '{recording.name}' has no force", wanted="a force to compare with")
    force = recording.force[scored]
    error = force - simulate(model, recording)[scored]
    rms = float(np.sqrt(np.mean(error**2)))
    spread = float(np.std(force))
    return Fit(
        recording=recording.name,
        current=recording.current_level,
        samples=len(force),
        rms=rms,
        relative_rms=rms / spread if spread > 0 else float("inf"),
        peak_error=float(np.abs(error).max() / np.abs(force).max()),
    )
