"""Effects of a quarter of the noise, or of a few steps of the signal, beside what the measurement adds."""

import mre_core
import pytest
from mre_core import Diagnosis, Recording
from mre_core.trial.case import Case

MAINS = "mains_interference"


def diagnosed(effect: str, law: str, base: str, noise: str, strength: float, seed: int) -> Diagnosis:
    excitation = "field" if effect.startswith("field") else "rich"
    case = Case((effect,), (law,), base, strength, noise, "given", excitation, None, 0.01, 0.0, seed)
    made = case.simulate()
    assert made.unexplained_rms < 1.05 * strength * made.noise_rms
    recordings = [
        Recording(r.time, r.displacement, r.force, velocity=r.velocity, current=r.current, name=r.name)
        for r in made.recordings
    ]
    return mre_core.diagnose(recordings, base, seed=1)


@pytest.mark.parametrize(
    ("effect", "law", "base"),
    [("creep", "logarithmic", "sinh"), ("field_remanence", "largest_current", "sinh")],
)
def test_a_weak_effect_in_a_force_of_coarse_steps(effect: str, law: str, base: str) -> None:
    """The saw tooth follows from the force of the device with the effect: without it, it is off by teeth."""
    found = diagnosed(effect, law, base, "quantised", 0.25, 644125691)
    assert (found.verdict, [e.id for e in found.effects]) == ("missing_physics", [effect])


@pytest.mark.parametrize(
    ("effect", "law", "base"),
    [("field_dependence", "quadratic", "sinh"), ("backlash", "dead_zone", "bouc_wen")],
)
def test_a_weak_effect_beside_a_strong_hum(effect: str, law: str, base: str) -> None:
    """What the hum explains is no measure of an effect of the device, which cannot patch the hum's form."""
    found = diagnosed(effect, law, base, "mains", 0.25, 4058267409)
    assert found.verdict == "missing_physics"
    assert sorted(e.id for e in found.effects) == sorted([effect, MAINS])


@pytest.mark.parametrize(("base", "strength"), [("sinh", 1.0), ("kelvin_voigt", 0.5)])
def test_play_of_thousandths_of_the_stroke(base: str, strength: float) -> None:
    """It stops where the motion turns, between samples; one of twice the size explains nothing."""
    found = diagnosed("backlash", "series_play", base, "white", strength, 7)
    assert (found.verdict, [e.law for e in found.effects]) == ("missing_physics", ["play"])


def test_damping_alone_that_saturates_with_the_current() -> None:
    found = diagnosed("field_dependence", "damping_tanh", "bouc_wen", "quantised", 3.0, 2496422944)
    assert [(e.id, e.law) for e in found.effects] == [("field_dependence", "damping scaled, saturating")]


def test_a_joint_that_stiffens_is_a_compliant_rig() -> None:
    found = diagnosed("rig_compliance", "contact", "sinh", "white", 1.0, 7)
    assert [e.id for e in found.effects] == ["rig_compliance"]
