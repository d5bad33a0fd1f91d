"""One case as every method gets it: recordings to learn from, and one to predict."""

from dataclasses import dataclass, replace

import numpy as np
from mre_core import Recording
from mre_core.concealed import Recorded
from mre_core.trial import Case
from numpy.typing import NDArray

Array = NDArray[np.float64]
OF_THE_MEASUREMENT = {"force_drift", "mains_interference", "force_clipping"}
"""What a model of the device cannot predict."""


@dataclass(frozen=True)
class Problem:
    """Recordings with the noise-free velocity; forces in N."""

    case: Case
    train: list[Recording]
    test: Recording
    test_oracle: float
    """Rms error on `test` of the device itself: its noise."""

    @property
    def predictable(self) -> bool:
        """Whether an error on `test` says something about the model of the device."""
        return self.case.noise != "mains" and not OF_THE_MEASUREMENT & set(self.case.effects)


def problem_of(case: Case) -> tuple[Problem, bool]:
    """Simulate a case; false where the base absorbs the effect, so that nothing can be found."""
    made = replace(case, velocity="given").simulate()
    middle = len(made.recordings) // 2
    test = made.recordings[middle]
    train = [r for i, r in enumerate(made.recordings) if i != middle]
    oracle = float(np.sqrt(np.mean((test.force - test.truth) ** 2)))
    return Problem(case, [recording(r) for r in train], recording(test), oracle), made.reached


def recording(made: Recorded) -> Recording:
    """Hand over what was recorded."""
    current = float(made.current[0]) if np.ptp(made.current) == 0 else made.current
    return Recording(
        made.time, made.displacement, made.force, velocity=made.velocity, current=current, name=made.name
    )


def force_of(recordings: list[Recording]) -> Array:
    """All forces in one row."""
    return np.concatenate([np.asarray(r.force) for r in recordings])


def rms(error: Array) -> float:
    """Root mean square."""
    return float(np.sqrt(np.mean(error**2)))
