"""Effects on a base with a hysteretic force of its own, and several effects at once."""

import mre_core
import numpy as np
import pytest
from missing import NOISE, campaign, with_series
from mre_core import Diagnosis, Effect, Level, Model, Recording, _core
from mre_core.concealed import make_campaign
from mre_core.trial.case import Case
from rig import BOUC_WEN, force_of, motion
from test_effects import SIZES

DEGRADED = {"s": 0.3}
PATH = 550.0
"""mm, of the sizes that the model was fitted with."""
PATHS = {"stiffness": "path, stiffness", "spring": "path, spring", "whole": "path, whole force"}


def diagnosed(effects: list[str], base: str, seed: int, velocity: str = "given") -> Diagnosis:
    made = make_campaign(effects, base=base, strength=2.0, seed=seed, velocity=velocity, samples=4000)
    recordings = [
        Recording(r.time, r.displacement, r.force, velocity=r.velocity, name=r.name) for r in made.recordings
    ]
    return mre_core.diagnose(recordings, base, seed=1)


def forces(law: str | None) -> np.ndarray:
    effects = (Effect("cyclic_degradation", law, DEGRADED),) if law else ()
    model = Model(
        "bouc_wen", (Level(None, BOUC_WEN),), effects=effects, sizes=SIZES | {"path": PATH} if law else {}
    )
    return mre_core.simulate(model, motion())


def test_what_each_law_scales_of_a_hysteretic_base() -> None:
    moved = motion()
    alone = forces(None)
    spring = BOUC_WEN["kx"] * moved.displacement
    damped = BOUC_WEN["c0"] * moved.velocity
    hysteretic = alone - spring - damped - BOUC_WEN["F0"]
    speed = np.abs(moved.velocity)
    path = np.concatenate([[0.0], np.cumsum(np.diff(moved.time) * (speed[1:] + speed[:-1]) / 2)])
    lost = DEGRADED["s"] * path / PATH
    for law, scaled in (
        ("spring", spring),
        ("stiffness", spring + hysteretic),
        ("whole", spring + hysteretic + damped),
    ):
        np.testing.assert_allclose(forces(PATHS[law]) - alone, -lost * scaled, atol=1e-9 * np.ptp(alone))


def test_laws_on_the_spring_belong_to_hysteretic_bases() -> None:
    laws = {row["law"] for row in _core.catalogue() if row["law"].endswith("spring")}
    assert len(laws) > 5
    named = diagnosed(["cyclic_degradation"], "sinh", 1).effects
    assert [e.id for e in named] == ["cyclic_degradation"]
    assert named[0].law not in laws


@pytest.mark.parametrize(
    ("effects", "base", "seed"),
    [
        (["cyclic_degradation", "quadratic_damping"], "bouc_wen", 2),
        (["mullins_softening", "rig_compliance"], "bouc_wen", 3),
        (["coulomb_friction", "stiffness_jump"], "sinh", 4),
    ],
)
def test_both_of_two_are_named(effects: list[str], base: str, seed: int) -> None:
    found = diagnosed(effects, base, seed)
    assert sorted(e.id for e in found.effects) == sorted(effects), found.verdict


def test_three_are_named_where_no_second_alone_is_worth_its_name() -> None:
    case = Case(
        effects=("thermal_softening", "fractional_viscoelasticity", "coulomb_friction"),
        laws=("lump", "springpot", "sign"),
        base="kelvin_voigt",
        strength=2.0,
        noise="white",
        velocity="derived",
        excitation=None,
        samples=None,
        noise_share=0.01,
        displacement_noise=0.0,
        seed=124586260,
    )
    recordings = [Recording(r.time, r.displacement, r.force, name=r.name) for r in case.simulate().recordings]
    found = mre_core.diagnose(recordings, case.base, seed=1)
    assert sorted(e.id for e in found.effects) == sorted(case.effects), found.verdict


def test_stribeck_is_told_from_coulomb_where_the_velocity_is_derived() -> None:
    found = diagnosed(["stribeck_friction"], "kelvin_voigt", 5, velocity="derived")
    assert [e.id for e in found.effects] == ["stribeck_friction"]


def test_a_faint_hum_beside_an_effect_is_named() -> None:
    """It lowers no rms by much, and goes on whatever moves: it patches the form of nothing."""
    humming = []
    for i, r in enumerate(campaign()):
        hum = 0.2 * NOISE * np.sqrt(2) * np.sin(2 * np.pi * 50 * r.time + i)
        humming.append(with_series(r, force=force_of(r) + hum))
    found = mre_core.diagnose(humming, "kelvin_voigt", seed=1)
    assert found.verdict == "missing_physics"
    assert {e.id: e.form for e in found.effects}["mains_interference"] == "exact"
    plain = mre_core.diagnose(campaign(), "kelvin_voigt", seed=1)
    others = [(e.id, e.form) for e in found.effects if e.id != "mains_interference"]
    assert others == [(e.id, e.form) for e in plain.effects]
