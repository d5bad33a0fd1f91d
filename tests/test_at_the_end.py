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
