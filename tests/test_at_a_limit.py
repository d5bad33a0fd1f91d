"""A parameter of the base at its limit hides nothing: what would push it further is a mismatch."""

import mre_core
import numpy as np
import pytest
from mre_core import Diagnosis, Recording
from numpy.typing import NDArray

RATE, NOISE = 200.0, 0.25
SINES = ((0.3, 6.0), (0.7, 6.0), (1.2, 4.0), (0.5, 2.0), (1.5, 3.0))
"""Hz and mm."""


def moved(
    t: NDArray[np.float64], frequency: float, amplitude: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Displacement in mm and velocity in mm/s of a sine that begins smoothly."""
    ramp, w = np.clip(t, 0, 1), 2 * np.pi * frequency
    share, slope = ramp**2 * (3 - 2 * ramp), 6 * ramp * (1 - ramp)
    x = amplitude * share * np.sin(w * t)
    return x, amplitude * (slope * np.sin(w * t) + share * w * np.cos(w * t))


def diagnosed(c0: float, late: float, seed: int) -> Diagnosis:
    """A spring of 20 N/mm and a dashpot in N s/mm, whose force is recorded so many seconds late."""
    rng = np.random.default_rng([seed, 51])
    recordings = []
    for frequency, amplitude in SINES:
        t = np.arange(round(12 * RATE)) / RATE
        (x, v), (x_late, v_late) = (moved(at, frequency, amplitude) for at in (t, t - late))
        force = c0 * v_late + 20 * x_late + NOISE * rng.normal(size=t.size)
        recordings.append(Recording(t, x, force, velocity=v, name=f"{frequency:g}Hz_{amplitude:g}mm"))
    return mre_core.diagnose(recordings, "kelvin_voigt", seed=1)


@pytest.mark.parametrize("seed", [1, 2])
def test_a_late_force_of_a_device_of_little_damping_is_named(seed: int) -> None:
    found = diagnosed(0.05, 0.005, seed)
    assert found.verdict == "missing_physics", found
    assert "time_delay" in {one for e in found.effects for one in (e.id, *e.indistinguishable_from)}
    (alone,) = found.pressed["base"]
    assert (alone["parameter"], alone["value"], alone["unit"]) == ("c0", 0.0, "N s/mm")
    assert "limit that the recordings would have it pass: c0 = 0 N s/mm." in str(found)
    assert found.to_dict()["pressed"] == {"base": [alone], "final": []}


@pytest.mark.parametrize("seed", [1, 2])
def test_a_damping_below_zero_is_not_noise(seed: int) -> None:
    found = diagnosed(-0.1, 0.0, seed)
    assert found.verdict != "adequate", found


@pytest.mark.parametrize("seed", range(4))
def test_a_device_without_damping_is_adequate(seed: int) -> None:
    """At the limit by chance in every other draw."""
    found = diagnosed(0.0, 0.0, seed)
    assert (found.verdict, found.pressed) == ("adequate", {})
