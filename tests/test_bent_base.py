"""A base that bends under an effect does not hide it: recordings by the independent simulator."""

import mre_core
import numpy as np
import pytest
from mre_core import Recording
from mre_core.trial import Case

DRIFT = Case(
    effects=("force_drift",),
    laws=("linear",),
    base="bouc_wen",
    strength=2.0,
    noise="student",
    velocity="given",
    excitation="rich",
    samples=2000,
    noise_share=0.015,
    displacement_noise=0.0,
    seed=2791594298,
)


def test_a_drift_that_a_hysteretic_base_bends_to_is_named() -> None:
    made = DRIFT.simulate()
    recordings = [
        Recording(one.time, one.displacement, one.force, velocity=one.velocity, current=1.0, name=one.name)
        for one in made.recordings
    ]
    found = mre_core.diagnose(recordings, "bouc_wen", seed=1)
    assert (found.verdict, [effect.id for effect in found.effects]) == ("missing_physics", ["force_drift"])
    assert found.fit.held_out_rms_before > 2.5 * made.noise_rms
    assert found.fit.held_out_rms_after == pytest.approx(made.noise_rms, rel=0.1)


@pytest.mark.parametrize("steepness", [0.5, 3.5, 4.5, 5.5])
def test_a_sinh_device_of_any_steepness_lacks_nothing(steepness: float) -> None:
    """Swarms search for beta up to 3 / X."""
    rng = np.random.default_rng([107, round(10 * steepness)])
    t = np.arange(4000) / 150
    swell = 5 * np.minimum(t / 20, 1)
    x = swell * np.sin(2 * np.pi * t)
    v = np.gradient(x, t)
    stiffening = np.sinh(steepness * x / 5) / np.sinh(steepness)
    force = 6 * x + 0.3 * v + 15 * stiffening + 0.15 * rng.normal(size=t.size)
    found = mre_core.diagnose(Recording(t, x, force, velocity=v, name="steep"), "sinh", seed=1)
    assert found.verdict == "adequate", found
