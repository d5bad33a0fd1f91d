"""Identification of recordings whose truth is known."""

import re
from importlib import resources
from pathlib import Path
from types import MappingProxyType
from typing import Any, Literal

import mre_core
import numpy as np
import pytest
from mre_core import MreError, Problem, Recording
from numpy.typing import ArrayLike
from reference.exact import sinh_optimum
from rig import BOUC_WEN, KELVIN_VOIGT, SINH, force_of, made_of, motion, record, rms

TRUTH = {"kelvin_voigt": KELVIN_VOIGT, "sinh": SINH, "bouc_wen": BOUC_WEN}


def stiffness(p: dict[str, float]) -> float:
    """Tangent at rest in N/mm, which is determined where its shares are not."""
    if "rho" in p:
        return p["kx"] + p["kw"] * p["rho"]
    return p["k0"] + p.get("alpha", 0.0) * p.get("beta", 0.0)


CASES = [
    (name, optimizer, noise) for name in TRUTH for optimizer in ("mafsa", "pso") for noise in (0.0, 0.01)
]


@pytest.mark.parametrize(("name", "optimizer", "noise"), CASES)
def test_recovery(name: str, optimizer: Literal["mafsa", "pso"], noise: float) -> None:
    moved = motion(8.0)
    truth = mre_core.simulate(made_of(name, TRUTH[name]), moved)
    level = noise * float(np.abs(truth).max())
    recording = record(made_of(name, TRUTH[name]), moved, noise=level, seed=2)
    # Bouc-Wen takes much longer for a candidate: fewer iterations, which end less close.
    hurried = (name, optimizer) == ("bouc_wen", "mafsa")
    shorter: dict[str, Any] = {"max_iterations": 40} if hurried else {}
    allowed = (0.01 if hurried else 0.003) * float(np.abs(truth).max())
    found = mre_core.identify(recording, name, optimizer=optimizer, seed=1, **shorter)
    assert found.result.success
    # The curve is what is determined: different k0, alpha and beta give nearly the same one.
    error = rms(mre_core.simulate(found.model, moved) - truth)
    assert error < allowed
    assert found.result.rms < 1.03 * level + allowed
    values = found.result.values
    assert values["c0"] == pytest.approx(TRUTH[name]["c0"], rel=0.1 if hurried else 0.02)
    assert stiffness(values) == pytest.approx(stiffness(TRUTH[name]), rel=0.1 if hurried else 0.04)


def test_literal_mafsa_comes_within_1_percent_of_the_optimum_20_times_of_20(sinh_4mm: Recording) -> None:
    problem = Problem(sinh_4mm, "sinh")
    optimum = sinh_optimum(sinh_4mm, problem)
    # Noise of 0.5 N, of which a fit of five parameters to 769 samples takes hardly anything.
    assert optimum == pytest.approx(0.25, rel=0.1)
    for seed in range(20):
        excess = mre_core.mafsa(problem, seed=seed).fitness / optimum - 1
        assert -1e-9 < excess < 0.01, seed


def test_force_weights_make_a_weak_test_count() -> None:
    strong, weak = ({"c0": 0.1 * k0, "k0": k0, "F0": 0.0} for k0 in (50.0, 2.0))
    recordings = [record(made_of("kelvin_voigt", p), motion(), name=str(p["k0"])) for p in (strong, weak)]

    def stiffness_by(weights: Literal["samples", "force"] | None) -> float:
        found = mre_core.identify(recordings, "kelvin_voigt", optimizer="pso", seed=1, weights=weights)
        return found.result.values["k0"]

    assert stiffness_by(None) == pytest.approx((50 + 2) / 2, rel=1e-3)
    assert stiffness_by("samples") == stiffness_by(None)
    # Weighted mean with weights 1/k0^2, by which the mean squared forces differ.
    assert stiffness_by("force") == pytest.approx((1 / 50 + 1 / 2) / (1 / 50**2 + 1 / 2**2), rel=1e-3)


def test_recordings_are_grouped_by_current() -> None:
    truth = {1.0: 9.0, 0.0: 5.0, 0.004: 5.0, 2.0: 20.0}
    recordings = [
        record(
            made_of("kelvin_voigt", KELVIN_VOIGT | {"k0": k0}),
            motion(4 + current, current=current),
            name=f"{current} A",
        )
        for current, k0 in truth.items()
    ]
    called: list[tuple[int, int, float | None]] = []
    found = mre_core.identify(
        recordings, "kelvin_voigt", optimizer="pso", seed=1, on_level=lambda *level: called.append(level)
    )
    assert [level.current for level in found.model.levels] == [0.002, 1.0, 2.0]
    np.testing.assert_allclose(
        [level.parameters["k0"] for level in found.model.levels], [5, 9, 20], rtol=1e-6
    )
    assert called == [(0, 3, 0.002), (1, 3, 1.0), (2, 3, 2.0)]
    assert len(found.runs) == 3
    # Every recording is compared, in the order in which it was given.
    assert [fit.recording for fit in found.fits] == [f"{current} A" for current in truth]
    with pytest.raises(ValueError, match="3 runs"):
        _ = found.result
    unknown = record(made_of("kelvin_voigt", KELVIN_VOIGT), motion(), name="unknown")
    with pytest.raises(mre_core.InputError, match="recording 'unknown' has no current"):
        mre_core.identify([*recordings, unknown], "kelvin_voigt", seed=1)


def changing(name: str) -> tuple[Recording, list[dict[str, float]]]:
    """A recording during which the current rises from 0 A to 2 A, and the parameters at both ends."""
    moved = motion(8.0, rate=64, cycles=6)
    share = moved.time / moved.time[-1]
    scaled = {key: 3 * TRUTH[name][key] for key in ("c0", "k0", "kx", "kw", "alpha") if key in TRUTH[name]}
    ends = [TRUTH[name], TRUTH[name] | scaled]
    low, high = (mre_core.simulate(made_of(name, end), moved) for end in ends)
    force = (1 - share) * low + share * high
    columns = (moved.time, moved.displacement, force)
    return Recording(*columns, velocity=moved.velocity, current=2 * share), ends


@pytest.mark.parametrize("name", TRUTH)
def test_law_of_a_changing_current(name: str) -> None:
    recording, (low, high) = changing(name)
    problem = Problem(recording, name)
    # Coefficients have a value at either end, shapes and offset one.
    split = [
        (low[n.partition("(")[0]] if n.endswith("(0 A)") else high[n.partition("(")[0]])
        for n in problem.names
    ]
    assert len(split) == len(low) + sum(low[key] != high[key] for key in low)
    assert problem.fitness(split) < 1e-20
    levels = problem.levels(split)
    assert levels == [(0.0, list(low.values())), (2.0, list(high.values()))]


@pytest.mark.parametrize("name", ["kelvin_voigt", "sinh"])
def test_changing_current_gives_both_ends_of_the_law(name: str) -> None:
    recording, ends = changing(name)
    bounds = {"beta": (0.30, 0.304)} if name == "sinh" else {}
    found = mre_core.identify(recording, name, seed=1, bounds=bounds)
    assert [level.current for level in found.model.levels] == [0.0, 2.0]
    for level, end in zip(found.model.levels, ends, strict=True):
        curve = mre_core.simulate(made_of(name, level.parameters), recording)
        expected = mre_core.simulate(made_of(name, end), recording)
        assert rms(curve - expected) < 0.02 * float(np.abs(expected).max())
    assert found.result.rms == pytest.approx(found.fits[0].rms, rel=1e-9)


def test_parameters_on_bounds_are_named() -> None:
    moved = motion()
    # Stiffer than the box allows, and with a damping that no passive device has.
    force = 5.0 * moved.displacement - 0.1 * moved.velocity
    recording = Recording(moved.time, moved.displacement, force, velocity=moved.velocity)
    bounds = {"k0": (0.0, 4.0)}
    result = mre_core.identify(recording, "kelvin_voigt", optimizer="pso", seed=1, bounds=bounds).result
    damping, stiffness, offset = result.parameters
    assert (stiffness.value, stiffness.lower, stiffness.upper) == (4.0, 0.0, 4.0)
    assert (stiffness.on_bound, stiffness.at_limit) == ("upper", False)
    assert stiffness.note == "on its upper bound: widen it"
    assert (damping.value, damping.on_bound, damping.at_limit) == (0.0, "lower", True)
    assert damping.note == "at its physical limit"
    assert (offset.on_bound, offset.note) == (None, "")
    assert stiffness.note in str(result)
    assert damping.note in str(result)


def test_result_of_a_fit(sinh_4mm: Recording) -> None:
    found = mre_core.identify(sinh_4mm, "sinh", seed=7, n_fish=10, max_iterations=15)
    result = found.result
    np.testing.assert_array_equal(result.x, list(result.values.values()))
    np.testing.assert_array_equal(list(found.model.levels[0].parameters.values()), result.x)
    assert [p.unit for p in result.parameters] == ["N s/mm", "N/mm", "N", "1/mm", "N"]
    assert (result.fun, result.nfev, result.nit) == (result.fitness, result.n_evaluations, 15)
    assert result.fitness == Problem(sinh_4mm, "sinh").fitness(result.x)
    error = force_of(sinh_4mm) - mre_core.simulate(found.model, sinh_4mm)
    assert result.rms == pytest.approx(rms(error), rel=1e-9)
    fit = found.fits[0]
    assert fit.rms == pytest.approx(rms(error), rel=1e-9)
    assert fit.relative_rms == pytest.approx(fit.rms / float(np.std(force_of(sinh_4mm))), rel=1e-9)
    assert fit.peak_error == pytest.approx(float(np.abs(error).max() / np.abs(force_of(sinh_4mm)).max()))
    # One screen, with everything a person asks for first.
    lines = str(found).splitlines()
    assert len(lines) <= 24
    assert max(map(len, lines)) <= 100
    for piece in (*SINH, "N^2", "15 iterations", f"{result.nfev} evaluations", "max_iterations", "seed 7"):
        assert piece in str(found)


def test_excluded_samples_are_simulated_but_not_scored() -> None:
    moved = motion()
    spoiled = mre_core.simulate(made_of("bouc_wen", BOUC_WEN), moved)
    spoiled[:30] += 50.0
    recording = Recording(moved.time, moved.displacement, spoiled, velocity=moved.velocity)
    whole, part = Problem(recording, "bouc_wen"), Problem(recording.exclude("start_transient"), "bouc_wen")
    truth = list(BOUC_WEN.values())
    assert whole.fitness(truth) == pytest.approx(50.0**2 * 30 / len(moved), rel=1e-6)
    # Zero only if z has its history from before the part that is scored.
    assert part.fitness(truth) < 1e-20


@pytest.mark.parametrize(
    "pair", [[0.1, 0.2], np.array([0.1, 0.2]), (0.1, 0.2)], ids=["list", "array", "tuple"]
)
def test_bounds_are_any_mapping_of_pairs(pair: ArrayLike) -> None:
    problem = mre_core.Problem(two_currents()[0], bounds=MappingProxyType({"c0": pair}))
    assert dict(zip(problem.names, zip(problem.lower, problem.upper, strict=True), strict=True))["c0"] == (
        0.1,
        0.2,
    )


@pytest.mark.parametrize(
    ("bounds", "said"),
    [
        ({"c0": (0, 1, 2)}, "number of bounds of c0 is 3"),
        ({"c0": (None, 1)}, "bounds of c0 is (None, 1)"),
        ([(0, 1)], "bounds is [(0, 1)]"),
        ({3: (0, 1)}, "a name of bounds is 3"),
    ],
)
def test_wrong_bounds_are_named(bounds: object, said: str) -> None:
    with pytest.raises(MreError, match=re.escape(said)):
        mre_core.Problem(two_currents()[0], bounds=bounds)  # type: ignore[arg-type]


def test_weights_of_recordings_go_with_them_to_their_currents() -> None:
    first, second, third = two_currents()
    found = mre_core.identify([first, third, second], "kelvin_voigt", weights=[1.0, 5.0, 3.0])
    alone = mre_core.identify([first, second], "kelvin_voigt", weights=[1.0, 3.0])
    assert found.model.levels[0].parameters == alone.model.levels[0].parameters
    with pytest.raises(MreError, match="weights is 2 numbers"):
        mre_core.identify([first, second, third], "kelvin_voigt", weights=[1.0, 3.0])


def test_a_recording_counts_once() -> None:
    first = two_currents()[0]
    with pytest.raises(MreError, match="given twice"):
        mre_core.identify([first, first])


def test_a_dead_force_channel_is_refused_by_name() -> None:
    t = np.arange(512) / 256
    dead = Recording(t, np.sin(6 * t), np.full(512, 3.0), name="dead")
    with pytest.raises(MreError, match="'dead': the force is 3 N throughout"):
        mre_core.identify(dead)


def test_a_swarm_that_ran_out_of_time_is_not_compared() -> None:
    run = mre_core.identify(two_currents()[0], "bouc_wen", optimizer="mafsa", time_limit=0.05, seed=1).runs[0]
    assert run.reason == "time_limit"
    assert run.gap is None
    assert run.uncertainty is not None
    assert "stopped and not compared with the optimum" in run.uncertainty.words[-1]


@pytest.mark.parametrize(
    "ended",
    [
        {"time_limit": 0.001},
        {"max_evaluations": 60},
        # So many iterations that the callback is asked: it is, some 20 times a second.
        {"max_iterations": 1_000_000, "callback": lambda *_: True},
    ],
)
def test_a_run_that_ended_early_shows_its_gap_where_that_is_quick(ended: dict[str, Any]) -> None:
    recording = two_currents()[0]
    run = mre_core.identify(recording, "sinh", optimizer="mafsa", seed=1, **ended).runs[0]
    assert run.reason in ("time_limit", "max_evaluations", "callback")
    best = mre_core.exact(Problem(recording, "sinh")).fun
    assert run.gap == pytest.approx(run.fitness / best - 1)
    assert "above the best known optimum" in str(run)


def test_a_hybrid_of_one_evaluation_is_compared_and_a_whole_one_stands_at_the_optimum() -> None:
    recording = two_currents()[0]
    short, whole = (
        mre_core.identify(recording, "bouc_wen", seed=1, max_evaluations=most).runs[0] for most in (1, None)
    )
    assert short.gap is not None
    assert whole.gap == 0.0
    assert "at the best known optimum" in str(whole)


def test_profiles_of_a_swarm_that_stopped_short_are_about_the_optimum() -> None:
    recording = two_currents()[0]
    swarm = mre_core.identify(recording, "sinh", optimizer="pso", seed=1, max_iterations=2)
    best = mre_core.identify(recording, "sinh", seed=1)
    assert swarm.result.gap is not None
    assert swarm.result.gap > 0.1
    for found, right in zip(swarm.profile()[0], best.profile()[0], strict=True):
        assert found.interval == right.interval


def test_a_gap_to_an_error_of_rounding_is_told_as_an_error() -> None:
    clean = record(made_of("kelvin_voigt", KELVIN_VOIGT), motion(), noise=0.0, seed=1)
    run = mre_core.identify(clean, "kelvin_voigt", optimizer="pso", seed=1, max_iterations=5).runs[0]
    assert "far above the best known optimum (rms error" in str(run)
    assert "%" not in run.standing


def test_a_model_is_saved_and_read(tmp_path: Path) -> None:
    model = mre_core.identify(two_currents()[0], "kelvin_voigt").model
    model.save(tmp_path / "model.json")
    assert mre_core.Model.load(tmp_path / "model.json") == model


def test_the_package_is_typed() -> None:
    assert resources.files("mre_core").joinpath("py.typed").is_file()


def two_currents() -> list[Recording]:
    model = made_of("bouc_wen", BOUC_WEN)
    conditions = [(2.0, 0.0), (4.0, 0.0), (4.0, 1.0)]
    return [
        record(model, motion(a, rate=100, cycles=3, current=i), noise=0.3, seed=k, name=f"{k}")
        for k, (a, i) in enumerate(conditions)
    ]
