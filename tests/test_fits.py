"""Exact and hybrid fits: at the optimum, inside the box, the same for every thread count."""

from typing import Any

import mre_core
import numpy as np
import pytest
from mre_core import Problem, Recording
from mre_core.study.campaign import replica
from reference.exact import sinh_optimum
from rig import BOUC_WEN, KELVIN_VOIGT, SINH, force_of, made_of, motion, record
from scipy.optimize import lsq_linear  # type: ignore[import-untyped]


@pytest.fixture(scope="module")
def sinh_recording() -> Recording:
    return record(made_of("sinh", SINH), motion(), noise=0.5, seed=3)


@pytest.fixture(scope="module")
def bouc_wen_problem() -> Problem:
    recording = record(made_of("bouc_wen", BOUC_WEN), motion(cycles=2.0), noise=0.3, seed=4)
    return Problem(recording, "bouc_wen")


def test_sinh_meets_an_optimum_found_without_our_code(sinh_recording: Recording) -> None:
    problem = Problem(sinh_recording, "sinh")
    found = mre_core.exact(problem)
    # SciPy's refinement of beta stops at 1e-9, where the fitness is flat to far less than 1e-9 of itself.
    assert found.fun == pytest.approx(sinh_optimum(sinh_recording, problem), rel=1e-9)
    assert found.fun == problem.fitness(found.x)
    assert found.success


@pytest.mark.parametrize(
    "bounds",
    [
        {"c0": (0.0, 0.9)},
        {"k0": (16.0, 30.0)},
        {"alpha": (0.0, 5.0)},
        {"beta": (0.5, 0.7)},
        {"F0": (1.0, 2.0)},
        {"c0": (2.0, 3.0), "k0": (0.0, 1.0), "beta": (0.05, 0.2)},
    ],
)
def test_active_bounds_are_honoured(
    sinh_recording: Recording, bounds: dict[str, tuple[float, float]]
) -> None:
    problem = Problem(sinh_recording, "sinh", bounds)
    found = mre_core.exact(problem)
    assert found.fun == pytest.approx(sinh_optimum(sinh_recording, problem), rel=1e-9)
    assert np.all((problem.lower <= found.x) & (found.x <= problem.upper))
    assert any(p.on_bound for p in found.parameters if p.name in bounds)


def test_kelvin_voigt_is_linear_least_squares() -> None:
    recording = record(made_of("kelvin_voigt", KELVIN_VOIGT), motion(), noise=0.5, seed=5)
    problem = Problem(recording, "kelvin_voigt")
    columns = np.column_stack([recording.velocity, recording.displacement, np.ones(len(recording))])
    best = lsq_linear(columns, force_of(recording), (problem.lower, problem.upper), tol=1e-14)
    found = mre_core.exact(problem)
    assert found.fun == pytest.approx(2 * best.cost / len(recording), rel=1e-12)
    np.testing.assert_allclose(found.x, best.x, rtol=1e-9, atol=1e-9)


def test_hybrid_reaches_the_optimum_with_every_seed(sinh_recording: Recording) -> None:
    problem = Problem(sinh_recording, "sinh")
    best = mre_core.exact(problem).fun
    worst = max(mre_core.hybrid(problem, seed=seed).fun for seed in range(100))
    assert worst <= best * (1 + 1e-9)


def test_bouc_wen_by_both_ways_is_the_same_point(bouc_wen_problem: Problem) -> None:
    best = mre_core.exact(bouc_wen_problem)
    runs = [mre_core.hybrid(bouc_wen_problem, seed=seed) for seed in range(10)]
    lowest = min(best.fun, *(run.fun for run in runs))
    for run in (best, *runs):
        assert run.fun <= lowest * (1 + 1e-9)
        np.testing.assert_allclose(run.x, best.x, rtol=1e-3)


def test_every_seed_reaches_an_optimum_where_the_sub_steps_change() -> None:
    # A descent that meets the edge ends there, up to 3e-7 of the cost above its best place.
    (recording,) = [case.recording for case in replica(1).cases if case.recording.name == "3A-1Hz-8mm"]
    problem = Problem(recording, "bouc_wen")
    found = [mre_core.hybrid(problem, seed=seed) for seed in range(6)]
    shape = dict(zip(problem.names, found[0].x, strict=True))
    octaves = np.log2(shape["rho"] * shape["n"] * max(2 * shape["sigma"] - 1, 1))
    assert octaves == pytest.approx(round(octaves), abs=1e-6), "this recording has no such optimum any more"
    costs = [result.fun for result in found]
    assert max(costs) <= mre_core.exact(problem).fun * (1 + 1e-9)
    assert max(costs) <= min(costs) * (1 + 1e-9)


def test_hybrid_is_never_above_exact_where_the_hysteresis_is_as_small_as_the_noise() -> None:
    problem = Problem(replica(1).cases[0].recording, "bouc_wen")
    best = mre_core.exact(problem).fun
    # With 5 and 9 the swarm alone ends in a valley that is 0.3 % above it.
    assert all(mre_core.hybrid(problem, seed=seed).fun <= best for seed in (5, 9))


def test_no_point_near_the_bouc_wen_optimum_is_better(bouc_wen_problem: Problem) -> None:
    best = mre_core.exact(bouc_wen_problem)
    rng = np.random.default_rng(6)
    for size in (1e-1, 1e-3, 1e-5):
        near = best.x * (1 + size * rng.normal(size=(200, len(best.x))))
        near = np.clip(near, bouc_wen_problem.lower, bouc_wen_problem.upper)
        # Sums of squares through the normal equations: right to about 1e-12 of the squared force.
        assert bouc_wen_problem.fitness(near).min() >= best.fun * (1 - 1e-10)


def test_swarms_show_their_gap(sinh_recording: Recording) -> None:
    found = mre_core.identify(sinh_recording, "sinh", optimizer="pso", seed=1, max_iterations=30)
    best = mre_core.exact(Problem(sinh_recording, "sinh")).fun
    assert found.result.optimum == best
    assert found.result.gap == found.result.fun / best - 1
    assert found.result.gap > 0
    assert "above the best known optimum" in str(found)


def test_hybrid_is_the_default_and_has_a_history(sinh_recording: Recording) -> None:
    found = mre_core.identify(sinh_recording, "sinh", seed=1)
    assert (found.optimizer, found.result.algorithm) == ("hybrid", "hybrid")
    assert len(found.result.history) == found.result.nit + 1 == 16
    assert found.result.fun <= found.result.history["best"][-1]


@pytest.mark.parametrize("threads", [2, 3])
def test_same_bits_for_any_number_of_threads(bouc_wen_problem: Problem, threads: int) -> None:
    one, many = (mre_core.exact(bouc_wen_problem, threads=n) for n in (1, threads))
    assert one.x.tobytes() == many.x.tobytes()
    assert (one.fun, one.nfev) == (many.fun, many.nfev)
    one, many = (mre_core.hybrid(bouc_wen_problem, seed=9, threads=n) for n in (1, threads))
    assert one.x.tobytes() == many.x.tobytes()
    assert (one.fun, one.nfev) == (many.fun, many.nfev)


def test_law_over_a_changing_current() -> None:
    moved = motion(8.0, cycles=4.0)
    current = np.linspace(0.0, 2.0, len(moved))
    low, high = SINH | {"c0": 0.5}, SINH | {"k0": 20.0}
    ends = [mre_core.simulate(made_of("sinh", p), moved) for p in (low, high)]
    force = ends[0] * (1 - current / 2) + ends[1] * current / 2
    recording = Recording(moved.time, moved.displacement, force, velocity=moved.velocity, current=current)
    found = mre_core.identify(recording, "sinh", seed=1)
    # Made without noise: what is left is the rounding of the normal equations.
    assert found.result.rms < 1e-5 * np.abs(force).max()
    assert [level.current for level in found.model.levels] == [0.0, 2.0]
    assert found.model.levels[1].parameters["k0"] == pytest.approx(20.0, rel=1e-3)


WRONG: dict[str, tuple[str, dict[str, Any]]] = {
    "n_fish is 0: a whole number from 1": ("hybrid", {"n_fish": 0}),
    "max_iterations is -1: a whole number from 1": ("hybrid", {"max_iterations": -1}),
    "n_particles is 0: a whole number from 1": ("pso", {"n_particles": 0}),
    "max_iterations is given": ("exact", {"max_iterations": 3}),
    "max_evaluations is 0: a whole number of at least 1": ("hybrid", {"max_evaluations": 0}),
    "max_evaluations is -3: a whole number of at least 1": ("mafsa", {"max_evaluations": -3}),
    "time_limit is 0: a number of seconds above 0": ("hybrid", {"time_limit": 0}),
    "time_limit is -1: a number of seconds above 0": ("pso", {"time_limit": -1.0}),
    "time_limit is NaN: a number of seconds above 0": ("hybrid", {"time_limit": np.nan}),
    "target is NaN: a number": ("afsa", {"target": np.nan}),
    "x0 is NaN: finite numbers": ("hybrid", {"x0": [1.0, np.nan, 1.0, 0.1, 0.0]}),
    "threads is 0, wanted a whole number from 1": ("exact", {"threads": 0}),
    "bound of beta is 0.5:0.1: the lower bound has to be below": ("exact", {"bounds": {"beta": (0.5, 0.1)}}),
    "bound of beta is 0.1:1000: at most 175 1/mm, above": ("exact", {"bounds": {"beta": (0.1, 1000)}}),
    "bound of beta is 0.1:NaN: both bounds have": ("hybrid", {"bounds": {"beta": (0.1, np.nan)}}),
}


@pytest.mark.parametrize("wanted", WRONG)
def test_wrong_settings_are_named(sinh_recording: Recording, wanted: str) -> None:
    optimizer, options = WRONG[wanted]
    with pytest.raises(mre_core.MreError) as caught:
        mre_core.identify(sinh_recording, "sinh", optimizer=optimizer, seed=1, **options)  # type: ignore[arg-type]
    assert str(caught.value).startswith(wanted)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("option", "value", "wanted"),
    [
        ("max_evaluations", "many", "max_evaluations is 'many': wanted a whole number of at least 1"),
        ("time_limit", "long", "time_limit is 'long': wanted a number"),
        ("threads", 1.5, "threads is 1.5: wanted a whole number"),
    ],
)
def test_options_of_another_type_are_named(
    sinh_recording: Recording, option: str, value: Any, wanted: str
) -> None:
    for search in (mre_core.pso, mre_core.hybrid):
        with pytest.raises(TypeError) as caught:
            search(Problem(sinh_recording), seed=1, **{option: value})
        assert str(caught.value) == wanted


def test_a_wide_box_short_of_overflow_is_searched(sinh_recording: Recording) -> None:
    narrow = mre_core.exact(Problem(sinh_recording))
    wide = mre_core.exact(Problem(sinh_recording, bounds={"beta": (0.001, 174.0)}))
    assert wide.fun <= narrow.fun * (1 + 1e-9)
