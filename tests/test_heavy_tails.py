"""Noise of heavy tails (Student's, three degrees of freedom): a wild sample is no physics, and hides none."""

import mre_core
import pytest
from mre_core.trial import Case
from rig import diagnosed, recordings_of


@pytest.mark.parametrize(
    ("velocity", "displacement_noise", "seed"),
    [
        pytest.param("given", 0.0, 3483221476, id="moment"),
        pytest.param("given", 0.0, 2721446349, id="turns"),
        pytest.param("given", 0.0, 1904457669, id="law"),
        pytest.param("derived", 0.003, 3009282139, id="ends"),
    ],
)
def test_wild_samples_are_not_explained(velocity: str, displacement_noise: float, seed: int) -> None:
    """Each stands where few samples are: at a moment, the turns, in a law, the largest displacements."""
    base = "kelvin_voigt"
    case = Case((), (), base, 0.0, "student", velocity, None, 10_000, 0.01, displacement_noise, seed)
    assert mre_core.diagnose(recordings_of(case.simulate()), base, seed=1).verdict == "adequate"


@pytest.mark.parametrize(
    ("effect", "law"),
    [("end_stop", "one_sided"), ("stiffness_jump", "step"), ("coulomb_friction", "sign")],
)
def test_what_a_few_samples_tell_is_named(effect: str, law: str) -> None:
    found = diagnosed((effect,), (law,), "kelvin_voigt", "student", 0.5, 5, 10_000)
    assert found.verdict == "missing_physics"
    assert [e.id for e in found.effects] == [effect]
