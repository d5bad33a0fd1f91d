"""Effects of a quarter of the noise, or of a few steps of the signal, beside what the measurement adds."""

from collections.abc import Callable

import mre_core
import numpy as np
import pytest
from mre_core import Diagnosis, Recording
from mre_core.trial.case import Case
from numpy.typing import NDArray
from rig import recordings_of

Array = NDArray[np.float64]

MAINS = "mains_interference"


def diagnosed(effect: str, law: str, base: str, noise: str, strength: float, seed: int) -> Diagnosis:
    excitation = "field" if effect.startswith("field") else "rich"
    case = Case((effect,), (law,), base, strength, noise, "given", excitation, None, 0.01, 0.0, seed)
    made = case.simulate()
    assert made.unexplained_rms < 1.05 * strength * made.noise_rms
    return mre_core.diagnose(recordings_of(made), base, seed=1)


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
    assert [(e.id, e.law) for e in found.effects] == [("rig_compliance", "joint in series")]


def swept(force: Callable[[Array, Array], Array], hum: float = 0.0, step: float = 0.0) -> list[Recording]:
    """Spring, dashpot and another force from rest under white noise of 0.5 N, with a hum and in steps, N."""
    recordings = []
    for i, (amplitude, frequency) in enumerate([(3, 0.5), (5, 1), (8, 2), (6, 3)]):
        random = np.random.default_rng([1, i])
        time = np.arange(1600) / 400.0
        x = amplitude * (1 - np.exp(-((3 * time) ** 3))) * np.sin(2 * np.pi * frequency * time)
        v = np.gradient(x, time, edge_order=2)
        mains = hum * np.sin(2 * np.pi * 50 * time + i)
        total = 10 * x + 0.4 * v + force(x, v) + mains + 0.5 * random.normal(size=len(time))
        shown = step * np.round(total / step) if step else total
        recordings.append(Recording(time, x, shown, velocity=v, name=f"r{i}"))
    return recordings


def of_swept(force: Callable[[Array, Array], Array], hum: float) -> Diagnosis:
    return mre_core.diagnose(swept(force, hum), "kelvin_voigt", seed=1)


@pytest.mark.parametrize(
    "force", [lambda x, v: 1.0 * np.sin(2 * np.pi * 3 * x / 8), lambda x, v: 1.5 * x**2 * v / 900]
)
def test_a_hum_keeps_its_name_beside_physics_of_no_catalogue(force: Callable[[Array, Array], Array]) -> None:
    calm = of_swept(force, 0.0)
    assert (calm.verdict, calm.effects) == ("unexplained", ())
    found = of_swept(force, 3.0)
    assert (found.verdict, [e.id for e in found.effects]) == ("partly_explained", [MAINS])


def test_a_hum_alone_explains_all_and_shows_at_no_place_of_the_motion() -> None:
    found = of_swept(lambda x, v: 0 * x, 3.0)
    assert (found.verdict, [e.id for e in found.effects]) == ("missing_physics", [MAINS])
    assert "mm" not in found.effects[0].statement
    assert "drive" not in found.effects[0].statement


def test_coarse_steps_beside_a_kept_model_with_an_effect() -> None:
    """The saw tooth is that of the model with its effects, in the steps of these recordings."""

    def cubic(x: Array, v: Array) -> Array:
        return 0.1 * x**3

    kept = mre_core.diagnose(swept(cubic), "kelvin_voigt", seed=1).model
    assert [effect.id for effect in kept.effects] == ["cubic_stiffness"]
    again = mre_core.diagnose(swept(cubic, step=4.0), kept, fixed=True, seed=1)
    assert (again.verdict, again.effects) == ("adequate", ())
    assert again.fit.held_out_rms_before == pytest.approx(again.fit.held_out_rms_after, rel=0.01)
