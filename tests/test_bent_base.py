"""A base that bends under an effect does not hide it: recordings by the independent simulator."""

import mre_core
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
