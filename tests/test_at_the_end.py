"""A name whose law fits only at the end of its range is not the whole answer."""

import mre_core
import numpy as np
import pytest
from missing import campaign, with_series


@pytest.fixture(scope="module")
def nearest() -> mre_core.Diagnosis:
    """Maxwell's branch, which a springpot in series with a spring turns into at the end of its order."""
    return mre_core.diagnose(campaign(), seed=1, without=["maxwell_relaxation", "rig_compliance"])


def test_a_parameter_at_its_end_is_told(nearest: mre_core.Diagnosis) -> None:
    (effect,) = nearest.effects
    assert effect.id == "fractional_viscoelasticity"
    assert effect.at_the_end == ("a",)
    assert effect.form == "approximate"
    assert effect.lack_of_fit == 0.0


def test_it_is_not_the_whole_answer(nearest: mre_core.Diagnosis) -> None:
    assert nearest.verdict == "partly_explained"
    assert "may be another effect" in str(nearest)
    assert "a mismatch is left" not in str(nearest)
    assert nearest.unknown is None
    assert nearest.to_dict()["effects"][0]["at_the_end"] == ["a"]


def test_a_law_within_its_range_is() -> None:
    found = mre_core.diagnose(campaign(), seed=1)
    assert found.verdict == "missing_physics"
    assert [e.at_the_end for e in found.effects] == [()]


def test_a_part_that_cannot_be_told_from_nothing_is() -> None:
    """Friction without an excess at rest is a Stribeck friction only where no other may be named."""

    def rubbed(r: mre_core.Recording) -> mre_core.Recording:
        return with_series(r, force=np.asarray(r.force) + 3.0 * np.tanh(r.velocity / 0.05))

    found = mre_core.diagnose([rubbed(r) for r in campaign(0.0)], seed=1, without=["coulomb_friction"])
    assert found.verdict == "partly_explained"
    assert ("stribeck_friction", ("F_b",)) in [(e.id, e.at_the_end) for e in found.effects]


def test_an_ideal_end_is_no_end() -> None:
    """A sign as sharp as it may be is dry friction."""

    def rubbed(r: mre_core.Recording) -> mre_core.Recording:
        return with_series(r, force=np.asarray(r.force) + 3.0 * np.sign(r.velocity))

    found = mre_core.diagnose([rubbed(r) for r in campaign(0.0)], seed=1)
    assert found.verdict == "missing_physics"
    assert [(e.id, e.at_the_end) for e in found.effects] == [("coulomb_friction", ())]


def test_a_change_between_recordings_may_be_one_of_a_calibration() -> None:
    """The last recording's force is four hundredths too large: no moment of a crack is seen."""
    recordings = []
    for k, (frequency, amplitude) in enumerate(((0.7, 4.0), (1.6, 6.0), (2.9, 5.0))):
        rng = np.random.default_rng([k, 78])
        t = np.arange(3000) / 200
        x = amplitude * np.clip(t, 0, 1) * np.clip(15 - t, 0, 1) * np.sin(2 * np.pi * frequency * t)
        v = np.gradient(x, t)
        force = (1.04 if k == 2 else 1.0) * (10 * x + 0.3 * v) + 0.3 * rng.normal(size=t.size)
        recordings.append(mre_core.Recording(t, x, force, velocity=v, name=f"{frequency} Hz"))
    found = mre_core.diagnose(recordings, base="kelvin_voigt", seed=1)
    assert found.verdict in ("partly_explained", "unexplained"), found
    assert all("t_0" in e.at_the_end for e in found.effects if e.id == "stiffness_jump")
    assert not found.effects or "a calibration" in str(found)
