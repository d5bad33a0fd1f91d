"""A simulated replica of the paper's twelve tests: their recordings are not public.

The parameters reproduce Table 2 at 0 A and 2 mm and the peak forces that the figures show; beta is
0.302 1/mm and F0 0.001 N throughout.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ._core import Recording, simulate

SAMPLING_RATE = 256.0
CYCLES = 3
DISPLACEMENT_NOISE = 0.005
BETA, OFFSET = 0.302, 0.001


@dataclass(frozen=True)
class Condition:
    """One test of Table 1 with the parameters of its device: A, mm, N s/mm, N/mm, N."""

    current: float
    amplitude: float
    c0: float
    k0: float
    alpha: float

    @property
    def name(self) -> str:
        """Name of the recording."""
        return f"{self.current:g}A-1Hz-{self.amplitude:g}mm"

    @property
    def values(self) -> list[float]:
        """Parameters of the sinh model."""
        return [self.c0, self.k0, self.alpha, BETA, OFFSET]


CAMPAIGN = (
    Condition(0, 2, 0.354, 3.572, 4.579),
    Condition(0, 4, 0.307, 3.501, 2.920),
    Condition(0, 8, 0.278, 3.479, 1.350),
    Condition(1, 2, 1.357, 10.892, 35.991),
    Condition(1, 4, 1.108, 13.702, 14.645),
    Condition(1, 8, 0.966, 13.660, 5.876),
    Condition(2, 2, 2.434, 14.122, 96.195),
    Condition(2, 4, 1.834, 23.638, 31.620),
    Condition(2, 8, 1.525, 23.559, 11.171),
    Condition(3, 2, 3.153, 8.823, 165.53),
    Condition(3, 4, 2.372, 30.116, 49.656),
    Condition(3, 8, 1.899, 30.441, 15.838),
)


def record(condition: Condition, seed: int) -> Recording:
    """Simulate one test as a rig would record it.

    Three steady cycles at 256 Hz; 0.005 mm noise on the displacement, 0.5 % of the largest force but at
    least 0.2 N on the force; the velocity is not recorded.

    Parameters
    ----------
    condition : Condition
        A test of `CAMPAIGN`.
    seed : int
        Of the noise.

    Returns
    -------
    Recording
        With force and constant current.
    """
    time = np.arange(round(CYCLES * SAMPLING_RATE) + 1) / SAMPLING_RATE
    turn = 2 * np.pi
    true = Recording(
        time,
        condition.amplitude * np.sin(turn * time),
        None,
        velocity=condition.amplitude * turn * np.cos(turn * time),
    )
    return measured(condition, true, simulate("sinh", [(None, condition.values)], true), seed)


def measured(condition: Condition, true: Recording, force: NDArray[np.float64], seed: int) -> Recording:
    """Add the rig's noise to a motion and its force; the velocity is left out.

    Parameters
    ----------
    condition : Condition
        Gives the recording its current and name.
    true : Recording
        n samples of the motion.
    force : ndarray, shape (n,)
        In N.
    seed : int
        Of the noise.

    Returns
    -------
    Recording
        With 0.005 mm of noise on the displacement, and on the force 0.5 % of the largest but at least 0.2 N.
    """
    rng = np.random.default_rng([seed, round(10 * condition.current), round(10 * condition.amplitude)])
    noise = max(0.2, 0.005 * float(np.abs(force).max()))
    return Recording(
        true.time,
        true.displacement + rng.normal(0, DISPLACEMENT_NOISE, len(force)),
        force + rng.normal(0, noise, len(force)),
        current=condition.current,
        name=condition.name,
    )
