"""A zero of the load cell that settles in every recording is a drift, not slow noise."""

import numpy as np
import pytest
from mre_core import Recording, diagnose

NOISE = 0.26
SETTLING = 4.0


def settling(time_constant: float) -> list[Recording]:
    """Four sines of 10 s on a Kelvin-Voigt device, mm and N; the zero settles in s."""
    rng = np.random.default_rng([44, 0])
    t = np.arange(5000) / 500
    zero = SETTLING * -np.expm1(-t / time_constant)
    recordings = []
    for i, (amplitude, frequency) in enumerate([(10, 0.3), (4, 0.3), (9, 0.6), (3, 0.6)]):
        rising = np.clip(t / 2, 0, 1)
        x = amplitude * rising**2 * (3 - 2 * rising) * np.sin(2 * np.pi * frequency * t)
        v = np.gradient(x, t)
        force = 10 * x + 0.2 * v + zero + NOISE * rng.normal(size=t.size)
        recordings.append(Recording(t, x, force, velocity=v, name=f"sine {i}"))
    return recordings


@pytest.mark.parametrize("time_constant", [0.5, 1.5, 3.0])
def test_a_settling_zero_is_named_and_leaves_the_noise(time_constant: float) -> None:
    found = diagnose(settling(time_constant), base="kelvin_voigt", seed=1)
    assert [(effect.id, effect.law) for effect in found.effects] == [("force_drift", "settling")], found
    assert found.verdict == "missing_physics"
    assert found.fit.noise_rms == pytest.approx(NOISE, rel=0.02)
    parameters = found.effects[0].parameters
    assert parameters["tau_d"].value == pytest.approx(time_constant, rel=0.03)
    sizes = [parameter.value for name, parameter in parameters.items() if name != "tau_d"]
    assert sizes == pytest.approx([SETTLING] * 4, rel=0.03)
