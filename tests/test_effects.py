"""Effects of a model: their catalogue, their parameters, their files, and their simulation."""

import json
import pickle
from pathlib import Path
from typing import Any

import mre_core
import numpy as np
import pytest
from missing import K_M, TAU, campaign, maxwell, record, with_series
from mre_core import Effect, InputError, Level, Model, MreError, Recording, _core
from numpy.typing import NDArray
from rig import BOUC_WEN, SINH, motion, rms

# The contract's list.
IDS = """
maxwell_relaxation fractional_viscoelasticity coulomb_friction stribeck_friction hysteresis inertia time_delay
cubic_stiffness asymmetric_stiffness quadratic_damping mullins_softening cyclic_degradation thermal_softening
payne_softening stiffness_jump pinching backlash end_stop rig_compliance force_drift force_clipping
mains_interference filter_lag creep field_lag field_remanence field_dependence
""".split()
SIZES = {
    "displacement": 4.0,
    "velocity": 80.0,
    "force": 70.0,
    "step": 0.005,
    "duration": 12.0,
    "total": 84.0,
    "path": 550.0,
    "energy": 2e4,
    "current": None,
    "current_varies": False,
    "quantum": None,
}
BRANCH = Effect("maxwell_relaxation", "one branch", {"k_m": K_M, "tau": TAU})


def device(*effects: Effect) -> Model:
    return Model("sinh", (Level(None, SINH),), effects=effects, sizes=SIZES if effects else {})


def laws(*, of_the_measurement: bool) -> list[tuple[str, str]]:
    rows = [row for row in _core.catalogue() if row["of_the_measurement"] is of_the_measurement]
    return [(row["id"], row["law"]) for row in rows]


def test_the_catalogue_is_complete() -> None:
    rows = _core.catalogue()
    assert {row["id"] for row in rows} == set(IDS)
    assert len({(row["id"], row["law"]) for row in rows}) == len(rows)
    for row in rows:
        assert all(row[key].strip() for key in ("plain", "equation", "reference", "limit")), row
        coefficients, shapes, own = _core.effect_parameters(row["id"], row["law"])
        names = [name for name, _ in [*coefficients, *shapes]]
        assert len(set(names)) == len(names)
        assert own is row["of_the_measurement"]


def test_a_branch_against_numpy() -> None:
    moved = motion(rate=500)
    added = mre_core.simulate(device(BRANCH), moved) - mre_core.simulate(device(), moved)
    np.testing.assert_allclose(added, K_M * maxwell(moved.time, moved.velocity, TAU), rtol=1e-9, atol=1e-9)


def test_a_mass_against_its_closed_form() -> None:
    moved = motion(rate=500)
    added = mre_core.simulate(device(Effect("inertia", "moving mass", {"m": 20.0})), moved)
    added -= mre_core.simulate(device(), moved)
    # N from kg and mm/s^2; the acceleration is derived from the velocity, worst at the ends.
    expected = -20e-3 * (2 * np.pi) ** 2 * moved.displacement
    np.testing.assert_allclose(added[10:-10], expected[10:-10], atol=1e-3 * np.abs(expected).max())


def swelling(rate: int) -> Recording:
    """4 mm at 1 Hz, reached in one second from rest."""
    time, turn = np.arange(3 * rate + 1) / rate, 2 * np.pi
    late = np.minimum(time, 1.0)
    velocity = 4.0 * (turn * np.cos(turn * time) * late**2 + np.sin(turn * time) * 2 * late * (time < 1))
    return Recording(time, 4.0 * np.sin(turn * time) * late**2, None, velocity=velocity)


def on_a_spring(model: str, truth: dict[str, float], moved: Recording, flexibility: float) -> Any:
    rig = Effect("rig_compliance", "spring in series", {"f_r": flexibility})
    return mre_core.simulate(Model(model, (Level(None, truth),), effects=(rig,), sizes=SIZES), moved)


@pytest.mark.parametrize("c", [0.4, 1.0, 3.0])
@pytest.mark.parametrize("softer", [0.3, 1.0, 3.0])
@pytest.mark.parametrize("rate", [256, 1024])
def test_a_viscous_device_on_a_spring_against_its_closed_form(c: float, softer: float, rate: int) -> None:
    # (1 + f k) F + f c F' = k x + c v, which is a lag of the Kelvin-Voigt force.
    k, fine = 20.0, swelling(16 * rate)
    flexibility = softer / k
    tau = flexibility * c / (1 + softer)
    driven = (k * fine.displacement + c * fine.velocity) / (1 + softer)
    # z' = u' - z/tau, so that u - z is the lag of u.
    expected = driven - maxwell(fine.time, np.gradient(driven, fine.time), tau)
    found = on_a_spring("kelvin_voigt", {"c0": c, "k0": k, "F0": 0.0}, swelling(rate), flexibility)
    assert rms(found - expected[::16]) < 5e-3 * rms(expected)


def test_a_hysteretic_device_that_is_stiffer_than_its_rig_against_numpy() -> None:
    # (kx + kw rho) f = 1.4: to put the force back into what it was made from would diverge.
    truth, flexibility, fine = {**BOUC_WEN, "F0": 0.0}, 0.04, swelling(256 * 32)
    c0, kx, kw, rho, sigma, n = (truth[name] for name in ("c0", "kx", "kw", "rho", "sigma", "n"))
    displacement = fine.displacement.tolist()

    def rates(i: int, x: float, z: float) -> NDArray[np.float64]:
        v = ((displacement[i] - x) / flexibility - kx * x - kw * z) / c0
        return np.array(
            [v, rho * (v - sigma * abs(v) * abs(z) ** (n - 1) * z + (sigma - 1) * v * abs(z) ** n)]
        )

    h, state, expected = 2 / (256 * 32), np.zeros(2), []
    for i in range(0, len(displacement), 2):
        if i % 32 == 0:
            expected.append((displacement[i] - state[0]) / flexibility)
        if i + 2 < len(displacement):
            a = rates(i, *state)
            b = rates(i + 1, *(state + h / 2 * a))
            d = rates(i + 1, *(state + h / 2 * b))
            state = state + h / 6 * (a + 2 * b + 2 * d + rates(i + 2, *(state + h * d)))
    found = on_a_spring("bouc_wen", truth, swelling(256), flexibility)
    assert rms(found - np.array(expected)) < 2e-3 * rms(np.array(expected))


def test_effects_add_up() -> None:
    moved = motion()
    both = device(BRANCH, Effect("inertia", "moving mass", {"m": 20.0}))
    alone = [mre_core.simulate(device(effect), moved) for effect in both.effects]
    expected = sum(alone) - mre_core.simulate(device(), moved)
    np.testing.assert_allclose(mre_core.simulate(both, moved), expected, atol=1e-10)


@pytest.mark.parametrize(("id", "law"), laws(of_the_measurement=True))
def test_the_measurement_is_no_part_of_the_device(id: str, law: str) -> None:
    effect = Effect(id, law, {name: 1.0 for name, _ in _core.effect_parameters(id, law)[1]})
    assert effect.of_the_measurement
    moved = motion()
    force = mre_core.simulate(device(), moved)
    np.testing.assert_allclose(mre_core.simulate(device(effect), moved), force, atol=1e-10)


def test_clipping_is_no_part_of_the_device() -> None:
    moved = motion()
    clipped = device(Effect("force_clipping", "both sides", {"L": 10.0}))
    np.testing.assert_allclose(
        mre_core.simulate(clipped, moved), mre_core.simulate(device(), moved), atol=1e-10
    )


@pytest.mark.parametrize("model", [device(), device(BRANCH), device(BRANCH, BRANCH)])
def test_round_trip(tmp_path: Path, model: Model) -> None:
    path = tmp_path / "m.json"
    path.write_text(json.dumps(model.to_dict()), encoding="utf-8")
    assert Model.load(path) == model
    assert pickle.loads(pickle.dumps(model)) == model
    moved = motion()
    np.testing.assert_array_equal(mre_core.simulate(path, moved), mre_core.simulate(model, moved))


def test_a_file_from_before_there_were_effects() -> None:
    content = device().to_dict()
    del content["sizes"]
    assert Model.from_dict(content) == device()


BAD = {
    "unknown effect": (("inertai", "moving mass", {"m": 1.0}), ["'inertai'", "inertia", "creep"]),
    "unknown law": (("inertia", "mass", {"m": 1.0}), ["law of inertia", "'mass'", "moving mass"]),
    "parameter missing": (("maxwell_relaxation", "one branch", {"tau": 1.0}), ["are tau", "k_m, tau"]),
    "parameter too many": (("inertia", "moving mass", {"m": 1.0, "n": 2.0}), ["are m, n", "wanted m"]),
    "no parameter": (("inertia", "moving mass", {}), ["are none", "wanted m"]),
    "not finite": (("inertia", "moving mass", {"m": float("nan")}), ["m of inertia", "nan", "finite"]),
    "not admissible": (("inertia", "moving mass", {"m": -1.0}), ["m of inertia", "-1", "from 0"]),
    "coefficients of a measurement": (
        ("mains_interference", "fundamental", {"A_1": 1.0, "B_1": 1.0, "f": 50.0}),
        ["are A_1, B_1, f", "wanted f"],
    ),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_effects(name: str) -> None:
    (id, law, parameters), pieces = BAD[name]
    with pytest.raises(MreError) as caught:
        Effect(id, law, parameters)
    assert "\n" not in str(caught.value)
    for piece in pieces:
        assert piece in str(caught.value)


def test_counts_of_parameters_are_checked_in_the_core() -> None:
    for coefficients, shapes in (([1.0], []), ([], [1.0]), ([1.0, 2.0], [1.0])):
        with pytest.raises(MreError, match=r"number of (coefficients|shapes) of maxwell_relaxation"):
            _core.check_effect("maxwell_relaxation", "one branch", coefficients, shapes)


def test_effects_need_sizes() -> None:
    with pytest.raises(InputError, match="has effects and no sizes"):
        Model("sinh", (Level(None, SINH),), effects=(BRANCH,))
    with pytest.raises(MreError, match="sizes is missing"):
        _core.simulate("sinh", device().given(), motion(), [BRANCH.given()])
    for broken in ({"displacement": "far"}, {"displacement": float("inf")}):
        with pytest.raises(MreError, match="sizes have no usable 'displacement'"):
            _core.simulate("sinh", device().given(), motion(), [BRANCH.given()], SIZES | broken)
    with pytest.raises(MreError, match="sizes have no usable 'noise': wanted a number from 0"):
        _core.simulate("sinh", device().given(), motion(), [BRANCH.given()], SIZES | {"noise": -1.0})
    _core.simulate("sinh", device().given(), motion(), [BRANCH.given()], SIZES | {"noise": 1e-40})


BROKEN: dict[str, Any] = {
    "no list": 3,
    "no law": [{"id": "inertia", "parameters": {}}],
    "text": ["inertia"],
    "text for a value": [{"id": "inertia", "law": "moving mass", "parameters": {"m": {"value": "heavy"}}}],
    "unknown": [{"id": "inertai", "law": "moving mass", "parameters": {}}],
}


@pytest.mark.parametrize("effects", BROKEN.values(), ids=BROKEN)
def test_broken_files(effects: Any) -> None:
    with pytest.raises(InputError, match=r"^m\.json: ") as caught:
        Model.from_dict(device().to_dict() | {"effects": effects, "sizes": SIZES}, file="m.json")
    assert "\n" not in str(caught.value)


def test_a_simulation_of_the_users_own() -> None:
    given = record(1.0, 4.0, seconds=3.0)
    own = Model("simulated", (Level(None, {}),))
    assert Model.from_dict(own.to_dict()) == own
    simulated = with_series(given, simulated=7 * given.displacement)
    np.testing.assert_array_equal(mre_core.simulate(own, simulated), 7 * given.displacement)
    with pytest.raises(InputError, match="recording '1Hz_4mm' has no simulated force"):
        mre_core.simulate(own, given)


def test_a_base_with_effects_keeps_them() -> None:
    found = mre_core.diagnose(campaign(), device(BRANCH), seed=1)
    assert [effect.id for effect in found.base_model.effects] == ["maxwell_relaxation"]
    assert found.base_model.effects[0].parameters["k_m"] == pytest.approx(K_M, rel=0.01)
    assert found.model.effects[0].id == "maxwell_relaxation"
    assert "maxwell_relaxation" not in [effect.id for effect in found.effects]


@pytest.mark.parametrize("law", ["dead zone", "dead zone without damping", "play"])
def test_a_gap_below_zero_is_refused(law: str) -> None:
    with pytest.raises(MreError, match=r"^g of backlash is -1: a finite number from 0 to inf$"):
        Effect("backlash", law, {"g": -1.0})
