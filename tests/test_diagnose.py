"""The diagnosis from Python: what it finds, what it says, and that it is the same each time."""

import json
import math
import pickle
from typing import Any

import mre_core
import numpy as np
import pytest
from missing import K_M, NOISE, TAU, campaign, record, with_series
from mre_core import Diagnosis, Effect, InputError, Level, Model, _core
from rig import SINH, force_of, rms


@pytest.fixture(scope="module")
def relaxing() -> Diagnosis:
    return mre_core.diagnose(campaign(), seed=1)


@pytest.fixture(scope="module")
def plain() -> Diagnosis:
    return mre_core.diagnose(campaign(0.0), seed=1)


def check_contract(content: dict[str, Any]) -> None:
    """Names and types of the fields that scripts read."""
    json.dumps(content, allow_nan=False)
    assert content["schema"] == "mre-core/diagnosis/1"
    assert content["verdict"] in {"adequate", "missing_physics", "partly_explained", "unexplained"}
    assert bool(content["effects"]) == (content["verdict"] in {"missing_physics", "partly_explained"})
    ids = {row["id"] for row in _core.catalogue()}
    for effect in content["effects"]:
        assert effect["id"] in ids
        assert effect["statement"].endswith(".")
        assert "\n" not in effect["statement"]
        assert all(isinstance(effect[key], str) and effect[key] for key in ("law", "equation", "reference"))
        assert 0 <= effect["p_value"] <= content["false_alarm"]
        assert effect["form"] in {"exact", "approximate"}
        assert effect["lack_of_fit"] >= 0
        assert set(effect["indistinguishable_from"]) <= ids - {effect["id"]}
        assert isinstance(effect["held_out_rms_before"], float)
        assert isinstance(effect["held_out_rms_after"], float)
        assert effect["parameters"]
        for p in effect["parameters"].values():
            assert set(p) == {"value", "low", "high", "unit"}
            assert math.isfinite(p["value"])
            assert p["low"] is None or p["low"] <= p["value"]
            assert p["high"] is None or p["value"] <= p["high"]
    strengths = [place["strength"] for place in content["where"]]
    assert strengths == sorted(strengths, reverse=True)
    wanted = {
        "time": {"recording", "from", "to", "unit"},
        "state": {"x_mm", "v_mm_s"},
        "harmonic": {"recording", "harmonic"},
        "recording": {"recording"},
    }
    for place in content["where"]:
        assert wanted[place["kind"]] <= set(place)
        assert isinstance(place["what"], str) and place["what"].endswith(".")
        assert place.get("recording", content["recordings"][0]) in content["recordings"]
        assert None not in place.values()
    names = ("train_rms_before", "train_rms_after", "held_out_rms_before", "held_out_rms_after", "noise_rms")
    assert all(isinstance(content["fit"][name], float) for name in names)
    assert content["fit"]["unit"] == "N"
    assert content["absorbed"] == [detail["id"] for detail in content["absorbed_detail"]]
    for detail in content["absorbed_detail"]:
        assert isinstance(detail["up_to"], float)
        assert isinstance(detail["unit"], str) and detail["why"]
    assert content["next_test"] is None or content["next_test"]["separates"]
    assert (content["unknown"] is None) == (content["verdict"] in {"adequate", "missing_physics"})
    assert isinstance(content["seed"], int)
    assert content["interrupted"] is False
    assert content["version"] == mre_core.__version__
    assert set(content["p_values"]) == {"base", "rest", "even", "effects"}


def test_a_branch_is_found(relaxing: Diagnosis) -> None:
    assert relaxing.verdict == "missing_physics"
    (effect,) = relaxing.effects
    assert (effect.id, effect.law, effect.form) == ("maxwell_relaxation", "one branch", "exact")
    assert effect.parameters["k_m"].value == pytest.approx(K_M, rel=0.01)
    assert effect.parameters["tau"].value == pytest.approx(TAU, rel=0.01)
    assert (effect.parameters["k_m"].unit, effect.parameters["tau"].unit) == ("N/mm", "s")
    # Held-out data at the noise, which are NOISE with a standard error of 0.5 %.
    assert relaxing.fit.held_out_rms_before > 3 * NOISE
    assert relaxing.fit.held_out_rms_after == pytest.approx(NOISE, rel=0.03)
    assert relaxing.fit.noise_rms == pytest.approx(NOISE, rel=0.03)
    assert relaxing.p_values["base"] < 1e-12 < relaxing.p_values["rest"]
    assert relaxing.where
    for piece in ("sinh", "maxwell_relaxation", "falls from"):
        assert piece in str(relaxing)
    assert effect.statement.startswith("Part of the stiffness relaxes with time")
    assert f"to {effect.held_out_rms_after:.3g} N" in effect.statement


def test_nothing_is_found_where_nothing_is_missing(plain: Diagnosis) -> None:
    assert (plain.verdict, plain.effects) == ("adequate", ())
    assert plain.p_values["base"] > plain.false_alarm
    # A copy of the base model.
    assert plain.model == plain.base_model
    assert "down to their noise" in str(plain)


def test_contract(relaxing: Diagnosis, plain: Diagnosis) -> None:
    for found in (relaxing, plain):
        check_contract(found.to_dict())


def test_files_of_models_are_simulated_to_the_same_force(relaxing: Diagnosis, plain: Diagnosis) -> None:
    for found, recordings in ((relaxing, campaign()), (plain, campaign(0.0))):
        for recording, history in zip(recordings, found.histories, strict=True):
            for model, force in ((found.base_model, history.base), (found.model, history.final)):
                simulated = mre_core.simulate(Model.from_dict(model.to_dict()), recording)
                np.testing.assert_allclose(simulated, force, atol=1e-9)
            np.testing.assert_array_equal(history.measured, recording.force)
        errors = np.concatenate([h.measured - h.final for h in found.histories])
        assert rms(errors) == pytest.approx(NOISE, rel=0.03)


def test_same_bits_for_any_number_of_threads(relaxing: Diagnosis) -> None:
    for threads in (1, 3):
        again = mre_core.diagnose(campaign(), seed=1, threads=threads)
        assert json.dumps(again.to_dict()) == json.dumps(relaxing.to_dict())
        assert again == relaxing
        for a, b in zip(again.histories, relaxing.histories, strict=True):
            np.testing.assert_array_equal(a.final, b.final)
            np.testing.assert_array_equal(a.base, b.base)


def test_seed_is_drawn_and_reported() -> None:
    recordings = campaign(0.0)[2:4]
    found = mre_core.diagnose(recordings)
    assert mre_core.diagnose(recordings, seed=found.seed) == found


def test_pickle(relaxing: Diagnosis) -> None:
    copy = pickle.loads(pickle.dumps(relaxing))
    assert copy == relaxing
    np.testing.assert_array_equal(copy.histories[0].final, relaxing.histories[0].final)


def test_effects_are_added_to_a_simulated_force() -> None:
    [plain, *_] = campaign()
    given = with_series(plain, simulated=plain.displacement)
    mass = Effect("inertia", "moving mass", {"m": 3.0})
    sizes = dict.fromkeys(
        ("displacement", "velocity", "force", "step", "duration", "total", "path", "energy"), 1.0
    )
    bare, heavy = (Model("simulated", (Level(None, {}),), {}, effects, sizes) for effects in ((), (mass,)))
    np.testing.assert_array_equal(mre_core.simulate(bare, given), plain.displacement)
    spring = Model("kelvin_voigt", (Level(None, {"k0": 1.0, "c0": 0.0, "F0": 0.0}),), {}, (mass,), sizes)
    np.testing.assert_allclose(
        mre_core.simulate(heavy, given), mre_core.simulate(spring, plain), rtol=0, atol=1e-9
    )
    with pytest.raises(InputError, match=f"'{plain.name}' has no simulated force"):
        mre_core.simulate(heavy, plain)


def test_fixed_and_simulated_are_the_same_question() -> None:
    base = Model("sinh", (Level(None, SINH | {"c0": 0.4, "k0": 8.0, "alpha": 10.0, "beta": 0.3, "F0": 0.0}),))
    recordings = [with_series(r, simulated=mre_core.simulate(base, r)) for r in campaign()]
    fixed = mre_core.diagnose(recordings, base, fixed=True, seed=1)
    simulated = mre_core.diagnose(recordings, "simulated", seed=1)
    assert fixed.base_model is base
    assert fixed.model.levels == base.levels
    assert simulated.base_model.to_dict()["model"] == "simulated"
    for found in (fixed, simulated):
        check_contract(found.to_dict())
        assert found.verdict == "missing_physics"
        assert found.effects[0].id == "maxwell_relaxation"
        # The base has the true parameters: what is left is the branch alone.
        assert found.effects[0].parameters["k_m"].value == pytest.approx(K_M, rel=0.01)
        for recording, history in zip(recordings, found.histories, strict=True):
            np.testing.assert_array_equal(history.base, recording.simulated)
            np.testing.assert_allclose(mre_core.simulate(found.model, recording), history.final, atol=1e-9)


def test_the_true_model_held_is_adequate() -> None:
    true = Model("sinh", (Level(None, {"c0": 0.4, "k0": 8.0, "alpha": 10.0, "beta": 0.3, "F0": 0.0}),))
    adequate = mre_core.diagnose(campaign(0.0), true, fixed=True, seed=1)
    assert (adequate.verdict, adequate.refitted) == ("adequate", None)
    wrong = Model("sinh", (Level(None, {"c0": 0.4, "k0": 9.0, "alpha": 10.0, "beta": 0.3, "F0": 0.0}),))
    found = mre_core.diagnose(campaign(0.0), wrong, fixed=True, seed=1)
    assert found.verdict != "adequate"
    # Whatever is named: fitted parameters would leave the noise alone.
    assert found.refitted is not None
    assert found.refitted.rms_fitted == pytest.approx(found.fit.noise_rms, rel=0.05)
    assert found.refitted.rms_as_given > 3 * found.refitted.rms_fitted
    assert "parameters were kept as given" in str(found)
    assert found.to_dict()["refitted"]["unit"] == "N"
    # Fitted anyway, nothing is to be told of it.
    assert mre_core.diagnose(campaign(), wrong, seed=1).refitted is None


def test_currents_have_parameters_of_their_own() -> None:
    stiffer = [
        with_series(r, force=force_of(r) + 5 * r.displacement, current=1.0, name=f"{r.name}_1A")
        for r in campaign(seed=1)
    ]
    found = mre_core.diagnose([*stiffer, *campaign(current=0.0)], seed=1)
    assert [level.current for level in found.model.levels] == [0.0, 1.0]
    assert [effect.id for effect in found.effects] == ["maxwell_relaxation"]
    x = 3.0  # mm, at which the two elastic forces differ by 5 N/mm
    low, high = (
        p["k0"] * x + p["alpha"] * math.sinh(p["beta"] * x)
        for p in (level.parameters for level in found.model.levels)
    )
    assert high - low == pytest.approx(5 * x, rel=0.02)
    for recording, history in zip([*stiffer, *campaign(current=0.0)], found.histories, strict=True):
        np.testing.assert_allclose(mre_core.simulate(found.model, recording), history.final, atol=1e-9)


def test_clipping_is_seen_by_the_diagnosis_and_not_by_the_device() -> None:
    recordings = [with_series(r, force=np.clip(force_of(r), -40, 40)) for r in campaign(0.0)]
    found = mre_core.diagnose(recordings, seed=1)
    assert [effect.id for effect in found.effects] == ["force_clipping"]
    assert max(h.final.max() for h in found.histories) == pytest.approx(40, rel=0.01)
    assert max(mre_core.simulate(found.model, r).max() for r in recordings) > 50


def test_names_are_made_different() -> None:
    recordings = [with_series(r, name=name) for r, name in zip(campaign(0.0), "aab", strict=False)]
    found = mre_core.diagnose([*recordings, record(1.0, 3.0, name=" ")], seed=1)
    assert found.recordings == ("a (1)", "a (2)", "b", " ")


def test_one_recording_is_enough() -> None:
    found = mre_core.diagnose(record(1.0, 4.0, seed=1), seed=1)
    assert found.verdict == "adequate"
    check_contract(found.to_dict())


def test_path_of_a_model_is_a_base(tmp_path: Any, plain: Diagnosis) -> None:
    path = tmp_path / "m.json"
    path.write_text(json.dumps(plain.model.to_dict()), encoding="utf-8")
    found = mre_core.diagnose(campaign(0.0), path, seed=1)
    assert found.to_dict() == plain.to_dict()
    with pytest.raises(InputError, match=r"no\.json: cannot be read"):
        mre_core.diagnose(campaign(0.0), tmp_path / "no.json")
