"""Noise of heavy tails (Student's, three degrees of freedom): a wild sample is no physics, and hides none."""

import mre_core
import pytest
from mre_core.trial import Case
from rig import diagnosed, recordings_of


@pytest.mark.parametrize(
    ("base", "velocity", "displacement_noise", "seed"),
    [
        pytest.param("kelvin_voigt", "given", 0.0, 3483221476, id="moment"),
        pytest.param("kelvin_voigt", "given", 0.0, 2721446349, id="turns"),
        pytest.param("sinh", "given", 0.0, 1914828541, id="law"),
        pytest.param("kelvin_voigt", "derived", 0.003, 3009282139, id="ends"),
    ],
)
def test_wild_samples_are_not_explained(
    base: str, velocity: str, displacement_noise: float, seed: int
) -> None:
    """Each stands where few samples are: at a moment, the turns, in a law, the largest displacements."""
    case = Case((), (), base, 0.0, "student", velocity, None, 10_000, 0.01, displacement_noise, seed)
    assert mre_core.diagnose(recordings_of(case.simulate()), base, seed=1).verdict == "adequate"


@pytest.mark.parametrize(
    ("effect", "law", "strength"),
    [
        ("end_stop", "one_sided", 0.5),
        ("stiffness_jump", "step", 0.5),
        ("coulomb_friction", "sign", 0.5),
        ("coulomb_friction", "sign", 0.25),
        ("maxwell_relaxation", "branch", 0.25),
    ],
)
def test_what_is_there_is_named_beside_wild_samples(effect: str, law: str, strength: float) -> None:
    found = diagnosed((effect,), (law,), "kelvin_voigt", "student", strength, 5, 10_000)
    assert found.verdict == "missing_physics"
    assert [e.id for e in found.effects] == [effect]
