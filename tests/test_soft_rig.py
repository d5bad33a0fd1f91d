"""A soft rig under a linear device: in closed form it is the device behind a filter, and both fit as well."""

import mre_core
import numpy as np
import pytest
from mre_core import Recording
from mre_core.concealed import effects

STIFFNESS, DAMPING, RIG = 20.0, 1.0, 40.0
RATE = 200.0
NOISE = 0.5
FINER = 10
SINES = ((1.0, 4.0), (1.0, 8.0), (4.0, 2.0), (10.0, 0.7))


def recorded(frequency: float, amplitude: float, seed: int) -> Recording:
    """A sine from rest: T F' + F = k k_r/(k + k_r) (x + c/k v), T = c/(k + k_r), exact between samples."""
    w, count = 2 * np.pi * frequency, round(8 * RATE)
    time = np.arange(count * FINER) / (RATE * FINER)
    start = np.minimum(time, 1.0)
    size, growth = start**2 * (3 - 2 * start), 6 * start * (1 - start)
    x = amplitude * size * np.sin(w * time)
    v = amplitude * (growth * np.sin(w * time) + w * size * np.cos(w * time))
    wished = STIFFNESS * RIG / (STIFFNESS + RIG) * (x + DAMPING / STIFFNESS * v)
    q = (STIFFNESS + RIG) / DAMPING / (RATE * FINER)
    decay, early, late = np.exp(-q), -np.expm1(-q) / q - np.exp(-q), 1 + np.expm1(-q) / q
    force = np.zeros_like(time)
    for i in range(1, len(time)):
        force[i] = decay * force[i - 1] + early * wished[i - 1] + late * wished[i]
    shown = force[::FINER] + np.random.default_rng(seed).normal(0.0, NOISE, count)
    return Recording(
        time[::FINER], x[::FINER], shown, velocity=v[::FINER], name=f"{frequency:g} Hz, {amplitude:g} mm"
    )


@pytest.fixture(scope="module")
def recordings() -> list[Recording]:
    return [recorded(*sine, seed=i) for i, sine in enumerate(SINES)]


def test_a_soft_rig_is_found_to_be_as_soft_as_it_is(recordings: list[Recording]) -> None:
    others = sorted({*effects()} - {"rig_compliance", "unknown"})
    found = mre_core.diagnose(recordings, "kelvin_voigt", seed=1, without=others)
    assert [effect.id for effect in found.effects] == ["rig_compliance"]
    flexibility = found.effects[0].parameters["f_r"]
    assert flexibility.value == pytest.approx(1 / RIG, rel=0.02)
    # Nothing else of the catalogue was tried: that is no sign of a mismatch.
    assert found.p_values["rest"] > 0.01
    assert found.effects[0].form == "exact"


def test_it_is_not_told_from_a_filter(recordings: list[Recording]) -> None:
    found = mre_core.diagnose(recordings, "kelvin_voigt", seed=1)
    (effect,) = found.effects
    assert {"rig_compliance", "filter_lag"} <= {effect.id, *effect.indistinguishable_from}
    if found.next_test is not None:
        assert not {"rig_compliance", "filter_lag"} & set(found.next_test["separates"])
