"""The fitness of candidates against a plain twin, its symmetries, and the problems it belongs to."""

import math
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from mre_core import MreError, Problem, Recording, models
from numpy.typing import ArrayLike, NDArray
from reference import models as twin
from reference.models import TABLE_2, Motion, jittered, multisine, sine

Array = NDArray[np.float64]

PROPERTY = settings(derandomize=True, deadline=None, max_examples=50)

# Sums of a thousand squares in another order; RK4 adds up the rounding of its steps.
RTOL = {"kelvin_voigt": 1e-10, "sinh": 1e-10, "bouc_wen": 1e-9}


def measured(
    motion: Motion, seed: int = 0, size: float = 1.0, current: Array | float | None = None
) -> Recording:
    """Force of Table 2 with noise, so that no candidate fits to the last digit."""
    noise = np.random.default_rng(seed).normal(size=len(motion))
    force = size * (twin.sinh(TABLE_2, motion) + 0.5 * noise)
    return Recording(motion.time, motion.displacement, force, velocity=motion.velocity, current=current)


def force_of(recording: Recording) -> Array:
    assert recording.force is not None
    return recording.force


def motion_of(recording: Recording) -> Motion:
    return Motion(recording.time, recording.displacement, recording.velocity)


def candidates(problem: Problem, count: int, seed: int = 0) -> Array:
    share = np.random.default_rng(seed).uniform(size=(count, len(problem.names)))
    rows: Array = problem.lower + share * (problem.upper - problem.lower)
    return rows


def twin_fitness(
    problem: Problem, x: Array, weights: Sequence[float], currents: Sequence[Array | float | None]
) -> float:
    """From the measured forces and the twin's force of the candidate."""
    pairs = []
    for recording, current in zip(problem.recordings, currents, strict=True):
        simulated = twin.simulate(problem.model, problem.levels(x), motion_of(recording), current)
        pairs.append((force_of(recording), simulated))
    return twin.fitness(pairs, [recording.scored for recording in problem.recordings], weights)


# Lengths without a common divisor, different times between samples, one of them uniform.
THREE = [
    measured(multisine(0, 3.0, np.arange(0.5, 4.0, 0.5), jittered(0, 60.0, 2.35)), 0),
    measured(multisine(1, 1.0, np.arange(0.3, 5.0, 0.7), jittered(1, 100.0, 1.27)), 1, 3.0),
    measured(sine(2.0, 1.0, 64.0, 1.5), 2, 0.2),
]


def ramped(rate: float = 100.0, seed: int = 5) -> Recording:
    """A rig test of 1 Hz with ramps and rests; only its steady part is scored."""
    t = np.arange(round(10.0 * rate)) / rate
    envelope = np.clip((t - 0.5) / 2.0, 0.0, 1.0) * np.clip((9.5 - t) / 2.0, 0.0, 1.0)
    x = 2.0 * envelope * np.sin(2.0 * math.pi * t)
    return measured(Motion(t, x, np.gradient(x, t)), seed).exclude("start_transient", "stop_transient")


# The twin


@pytest.mark.parametrize("weights", [None, "samples", "force", [1.0, 2.0, 3.5]], ids=str)
@pytest.mark.parametrize("model", models())
def test_fitness_of_the_twin(model: str, weights: str | list[float] | None) -> None:
    problem = Problem(THREE, model, weights=weights)
    factors = {
        "force": [1.0 / float(np.mean(force_of(recording) ** 2)) for recording in THREE],
        "samples": [1.0] * 3,
        "None": [1.0] * 3,
    }.get(str(weights), [1.0, 2.0, 3.5])
    rows = candidates(problem, 7)
    wanted = [twin_fitness(problem, x, factors, [None] * 3) for x in rows]
    np.testing.assert_allclose(problem.fitness(rows), wanted, rtol=RTOL[model])
    # The weights do matter here.
    if factors != [1.0] * 3:
        plain = Problem(THREE, model).fitness(rows)
        assert (np.abs(plain / wanted - 1.0) > 1e-3).all()


@pytest.mark.parametrize("weights", [None, "force"])
@pytest.mark.parametrize("model", models())
def test_only_scored_samples_count(model: str, weights: str | None) -> None:
    recordings = [ramped(), THREE[0]]
    assert 0 < recordings[0].scored[0] < recordings[0].scored[1] < len(recordings[0])
    problem = Problem(recordings, model, weights=weights)
    rows = candidates(problem, 3)
    factors = [1.0, 1.0]
    if weights == "force":
        factors = [1.0 / float(np.mean(force_of(r)[slice(*r.scored)] ** 2)) for r in recordings]
    wanted = [twin_fitness(problem, x, factors, [None] * 2) for x in rows]
    np.testing.assert_allclose(problem.fitness(rows), wanted, rtol=RTOL[model])


@pytest.mark.parametrize("model", models())
def test_fitness_where_the_current_changes(model: str) -> None:
    """Coefficients linear in the current within a recording, beside a recording at one current."""
    n = len(THREE[0])
    sweep = 1.25 + 0.75 * np.sin(np.arange(n) / 9.0)
    sweep[[3, 5]] = 0.5, 2.0
    recordings = [
        Recording(r.time, r.displacement, force_of(r), velocity=r.velocity, current=current)
        for r, current in ((THREE[0], sweep), (THREE[1], 0.75))
    ]
    problem = Problem(recordings, model)
    rows = candidates(problem, 5)
    wanted = [twin_fitness(problem, x, [1.0, 1.0], [sweep, 0.75]) for x in rows]
    np.testing.assert_allclose(problem.fitness(rows), wanted, rtol=RTOL[model])


def test_fitness_is_the_mean_square_of_eq_5() -> None:
    motion = sine(2.0, 1.0, 64.0, 2.0)
    force = twin.sinh(TABLE_2, motion)
    recording = Recording(motion.time, motion.displacement, force + 3.0, velocity=motion.velocity)
    # 3 N off everywhere: 9 N^2; exact up to the rounding of forces of 11 N.
    assert Problem(recording).fitness(TABLE_2) == pytest.approx(9.0, rel=1e-14)


# One by one, in rows, on threads

PROBLEMS: dict[str, Callable[[], Problem]] = {
    **{model: partial(Problem, THREE, model) for model in models()},
    "weighted": lambda: Problem(THREE, "bouc_wen", weights="force"),
    "affine": lambda: Problem(
        [measured(motion_of(THREE[0]), 0, 1.0, np.linspace(0.5, 2.0, len(THREE[0])))], "bouc_wen"
    ),
}


@pytest.mark.parametrize("kind", PROBLEMS)
def test_rows_are_evaluated_as_if_alone(kind: str) -> None:
    """Bit for bit, for any number of threads, of rows and any order: a swarm has to be repeatable."""
    problem = PROBLEMS[kind]()
    rows = candidates(problem, 61)
    rows[17] = 1e300  # an impossible neighbour changes nothing
    rows[30] = np.nan
    alone = np.array([problem.fitness(x) for x in rows])
    assert np.isfinite(alone).sum() == 59
    for threads in (None, 1, 2, 4):
        np.testing.assert_array_equal(problem.fitness(rows, threads=threads), alone)
        order = np.random.default_rng(threads).permutation(len(rows))
        np.testing.assert_array_equal(problem.fitness(rows[order], threads=threads), alone[order])
    for count in range(10):
        np.testing.assert_array_equal(problem.fitness(rows[:count], threads=2), alone[:count])


def test_one_candidate_gives_a_number_and_rows_an_array() -> None:
    problem = Problem(THREE)
    x = candidates(problem, 3)
    one, rows = problem.fitness(x[0]), problem.fitness(x)
    assert isinstance(one, float)
    assert rows.shape == (3,)
    assert rows.dtype == np.float64
    assert problem.fitness(np.empty((0, 5))).shape == (0,)
    for same in (x.tolist(), np.asfortranarray(x), x.astype(">f8"), np.repeat(x, 2, axis=0)[::2]):
        np.testing.assert_array_equal(problem.fitness(same), rows)


# Symmetries

LINEAR = {
    "kelvin_voigt": [True, True, True],
    "sinh": [True, True, True, False, True],
    "bouc_wen": [True, True, True, False, False, False, True],
}


@pytest.mark.parametrize("model", models())
@given(seed=st.integers(0, 2**32 - 1), factor=st.floats(1e-3, 1e3))
@PROPERTY
def test_force_and_coefficients_times_s_are_fitness_times_s_squared(
    model: str, seed: int, factor: float
) -> None:
    motion = motion_of(THREE[0])
    problem = Problem(measured(motion), model)
    scaled = Problem(
        Recording(
            motion.time, motion.displacement, factor * force_of(measured(motion)), velocity=motion.velocity
        ),
        model,
    )
    x = candidates(problem, 3, seed)
    h = problem.fitness(x)
    # Rounding of single residuals; the noise keeps all of them from cancelling.
    np.testing.assert_allclose(
        scaled.fitness(np.where(LINEAR[model], factor * x, x)), factor**2 * h, rtol=1e-11
    )


@pytest.mark.parametrize("model", models())
@pytest.mark.parametrize("derived", [False, True])
@given(seed=st.integers(0, 2**32 - 1), shift=st.integers(-(10**6), 10**6))
@PROPERTY
def test_the_time_of_the_start_does_not_matter(model: str, derived: bool, seed: int, shift: int) -> None:
    motion = sine(2.0, 1.0, 64.0, 1.5)
    force = force_of(measured(motion))
    velocity = None if derived else motion.velocity
    here, there = (
        # Whole seconds and 64 Hz: the times between samples stay the same to the last bit.
        Problem(Recording(motion.time + by, motion.displacement, force, velocity=velocity), model)
        for by in (0, shift)
    )
    x = candidates(here, 3, seed)
    np.testing.assert_allclose(there.fitness(x), here.fitness(x), rtol=1e-12)


@pytest.mark.parametrize("model", models())
@given(seed=st.integers(0, 2**32 - 1))
@PROPERTY
def test_recordings_add_up(model: str, seed: int) -> None:
    together = Problem(THREE, model)
    x = candidates(together, 3, seed)
    counts = [len(recording) for recording in THREE]
    parts = sum(n * Problem(r, model).fitness(x) for n, r in zip(counts, THREE, strict=True))
    np.testing.assert_allclose(together.fitness(x) * sum(counts), parts, rtol=1e-12)
    # Neither their order nor a common factor of the weights matters.
    np.testing.assert_allclose(Problem(THREE[::-1], model).fitness(x), together.fitness(x), rtol=1e-12)
    weighted = Problem(THREE, model, weights=[7.0, 7.0, 7.0])
    np.testing.assert_allclose(weighted.fitness(x), together.fitness(x), rtol=1e-12)


# Candidates that no device has

WILD = st.one_of(
    st.floats(width=64),
    st.sampled_from([0.0, -0.0, 5e-324, -1e-310, 1e300, -1e300, 1.7e308, math.inf, -math.inf, math.nan]),
    st.floats(-5.0, 5.0),
)


@pytest.mark.parametrize("kind", PROBLEMS)
@given(data=st.data())
@settings(PROPERTY, max_examples=80)
def test_the_fitness_is_never_nan(kind: str, data: st.DataObject) -> None:
    problem = PROBLEMS[kind]()
    d = len(problem.names)
    rows = np.array(data.draw(st.lists(st.lists(WILD, min_size=d, max_size=d), min_size=1, max_size=5)))
    h = problem.fitness(rows)
    assert not np.isnan(h).any()
    assert (h >= 0.0).all()
    assert np.isposinf(h[~np.isfinite(rows).all(axis=1)]).all()


@pytest.mark.parametrize("model", models())
@given(seed=st.integers(0, 2**32 - 1))
@example(seed=0)
@PROPERTY
def test_the_fitness_is_finite_in_the_default_box(model: str, seed: int) -> None:
    """At corners of the box too: THREE is sampled finely enough for the sharpest yield."""
    problem = Problem(THREE, model)
    corner = np.random.default_rng(seed).integers(0, 2, size=(4, len(problem.names))) == 1
    rows = np.vstack([candidates(problem, 4, seed), np.where(corner, problem.lower, problem.upper)])
    assert np.isfinite(problem.fitness(rows)).all()


@pytest.mark.parametrize("size", [1e-25, 1e-12, 1e12, 1e28])
@pytest.mark.parametrize("model", models())
def test_forces_and_motions_of_any_admitted_size(model: str, size: float) -> None:
    motion = motion_of(THREE[0])
    huge = Motion(motion.time, size * motion.displacement, size * motion.velocity)
    for recording in (
        Recording(huge.time, huge.displacement, motion.displacement, velocity=huge.velocity),
        Recording(motion.time, motion.displacement, huge.displacement, velocity=motion.velocity),
    ):
        problem = Problem(recording, model)
        assert not np.isnan(problem.fitness(candidates(problem, 20))).any()


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_sinh_that_overflows_cannot_be_a_candidate(sign: float) -> None:
    x = np.linspace(-1.0, 0.5, 16)
    problem = Problem(Recording(np.arange(16), x, x, velocity=np.ones(16)))
    assert math.isfinite(problem.fitness([0.0, 0.0, 1e-300, sign * 710.4, 0.0]))
    assert problem.fitness([0.0, 0.0, 1e-300, sign * 710.5, 0.0]) == math.inf
    assert problem.fitness([0.0, 0.0, 0.0, sign * 710.5, 0.0]) == math.inf


def test_too_many_substeps_cannot_be_a_candidate() -> None:
    """Constant 10 mm/s and 0.01 s: a fifth of rho, rounded up to a power of two, for n = 1, sigma = 0.5."""
    t = 0.01 * np.arange(20, dtype=float)
    problem = Problem(Recording(t, 10.0 * t, t, velocity=np.full(20, 10.0)), "bouc_wen")
    rows = [[0.0, 0.0, 1.0, rho, 0.5, 1.0, 0.0] for rho in (4096.0, 4097.0)]
    assert np.isfinite(problem.fitness(rows)).tolist() == [True, False]


# What is excluded


@pytest.mark.parametrize("model", models())
def test_forces_outside_the_scored_part_do_not_matter(model: str) -> None:
    before = ramped()
    start, stop = before.scored
    force = force_of(before).copy()
    force[:start] += 1e3
    force[stop:] = -77.0
    after = Recording(before.time, before.displacement, force, velocity=before.velocity)
    after = after.exclude("start_transient", "stop_transient")
    assert after.scored == before.scored
    rows = candidates(Problem(before, model), 5)
    np.testing.assert_array_equal(Problem(after, model).fitness(rows), Problem(before, model).fitness(rows))
    np.testing.assert_array_equal(Problem(after, model).upper, Problem(before, model).upper)
    # One sample inside does matter.
    force[start] += 1.0
    within = Recording(before.time, before.displacement, force, velocity=before.velocity)
    within = within.exclude("start_transient", "stop_transient")
    assert (Problem(within, model).fitness(rows) != Problem(before, model).fitness(rows)).all()


def test_the_hysteretic_variable_sees_the_excluded_part() -> None:
    """A device that yielded in the ramp is remembered; a cut recording starts from rest."""
    whole = ramped()
    start, stop = whole.scored
    x = [0.1, 2.0, 5.0, 0.4, 0.9, 1.5, 0.0]
    truth = twin.bouc_wen(x, motion_of(whole))
    exact = Recording(whole.time, whole.displacement, truth, velocity=whole.velocity)
    excluded = exact.exclude("start_transient", "stop_transient")
    # Forces of 10 N agree to 1e-9 of themselves.
    assert Problem(excluded, "bouc_wen").fitness(x) < 1e-16
    cut = exact.cut(float(whole.time[start]), float(whole.time[stop - 1]))
    assert Problem(cut, "bouc_wen").fitness(x) > 1e-3


# Names, levels and boxes


def test_names_and_units_of_a_constant_current() -> None:
    problem = Problem(THREE)
    assert problem.model == "sinh"
    assert problem.names == ["c0", "k0", "alpha", "beta", "F0"]
    assert problem.units == ["N s/mm", "N/mm", "N", "1/mm", "N"]
    assert len(problem.recordings) == 3
    x = [0.1, 2.0, 3.0, 0.4, 5.0]
    assert problem.levels(x) == [(None, x)]
    assert problem.levels(x, 1.5) == [(1.5, x)]


@pytest.mark.parametrize(
    ("model", "doubled", "single"),
    [
        ("kelvin_voigt", ["c0", "k0"], ["F0"]),
        ("sinh", ["c0", "k0", "alpha"], ["beta", "F0"]),
        ("bouc_wen", ["c0", "kx", "kw"], ["rho", "sigma", "n", "F0"]),
    ],
)
def test_names_and_levels_where_the_current_changes(
    model: str, doubled: list[str], single: list[str]
) -> None:
    """The lowest and the highest current of all recordings are the levels, be they varying or not."""
    motion = motion_of(THREE[0])
    varying = measured(motion, current=np.linspace(0.5, 1.75, len(motion)))
    problem = Problem([varying, measured(motion, current=2.0)], model)
    assert problem.names == [f"{name}({at} A)" for name in doubled for at in ("0.5", "2")] + single
    assert len(problem.units) == len(problem.names) == len(problem.lower) == len(problem.upper)
    x = np.arange(1.0, len(problem.names) + 1.0)
    (low, first), (high, second) = problem.levels(x)
    n = len(doubled)
    assert (low, high) == (0.5, 2.0)
    assert first == [*x[0 : 2 * n : 2], *x[2 * n :]]
    assert second == [*x[1 : 2 * n : 2], *x[2 * n :]]
    bounds = {f"{doubled[1]}(2 A)": (1.0, 2.0)}
    box = Problem([varying, measured(motion, current=2.0)], model, bounds)
    assert (box.lower[3], box.upper[3]) == (1.0, 2.0)


def test_several_constant_currents_are_one_set_of_parameters() -> None:
    motion = motion_of(THREE[0])
    problem = Problem([measured(motion, current=0.0), measured(motion, current=3.0)])
    assert problem.names == ["c0", "k0", "alpha", "beta", "F0"]


def test_on_bound() -> None:
    problem = Problem(THREE, bounds={"c0": (0.0, 2.0)})
    middle = 0.5 * (problem.lower + problem.upper)
    assert problem.on_bound(middle) == [0] * 5
    assert problem.on_bound(problem.lower) == [-1] * 5
    assert problem.on_bound(problem.upper) == [1] * 5
    mixed = np.array([2.0, *middle[1:4], problem.lower[4]])
    assert problem.on_bound(mixed) == [1, 0, 0, 0, -1]
    # A thousandth of the box inside is no longer on the bound.
    assert problem.on_bound(problem.upper - 1e-3 * (problem.upper - problem.lower)) == [0] * 5


def test_bounds_replace_single_edges_of_the_default_box() -> None:
    default, problem = Problem(THREE), Problem(THREE, bounds={"k0": (1.0, 2.0), "F0": (-9.0, -8.0)})
    np.testing.assert_array_equal(problem.lower, [*default.lower[[0]], 1.0, *default.lower[2:4], -9.0])
    np.testing.assert_array_equal(problem.upper, [*default.upper[[0]], 2.0, *default.upper[2:4], -8.0])


@pytest.mark.parametrize("model", models())
def test_the_default_box_has_the_units_of_the_recordings(model: str) -> None:
    """Twice the force: twice the linear coefficients. Twice the displacement: stiffness and shape halved."""
    motion = motion_of(THREE[0])
    force = force_of(measured(motion))
    plain = Problem(Recording(motion.time, motion.displacement, force, velocity=motion.velocity), model)
    strong = Problem(
        Recording(motion.time, motion.displacement, 2.0 * force, velocity=motion.velocity), model
    )
    long = Problem(
        Recording(motion.time, 2.0 * motion.displacement, force, velocity=2.0 * motion.velocity), model
    )
    per_mm = np.array([unit in ("N s/mm", "N/mm", "1/mm") for unit in plain.units])
    assert (plain.lower < plain.upper).all()
    # Powers of two: exact.
    for edge in ("lower", "upper"):
        box = getattr(plain, edge)
        np.testing.assert_array_equal(getattr(strong, edge), np.where(LINEAR[model], 2.0 * box, box))
        np.testing.assert_array_equal(getattr(long, edge), np.where(per_mm, 0.5 * box, box))


# c0, k0, alpha at 0, 1, 2 and 3 A, each at 2, 4 and 8 mm: made to show the peaks of the paper's figures.
CAMPAIGN = [
    (2.0, 0.354, 3.572, 4.579),
    (4.0, 0.307, 3.501, 2.920),
    (8.0, 0.278, 3.479, 1.350),
    (2.0, 1.357, 10.892, 35.991),
    (4.0, 1.108, 13.702, 14.645),
    (8.0, 0.966, 13.660, 5.876),
    (2.0, 2.434, 14.122, 96.195),
    (4.0, 1.834, 23.638, 31.620),
    (8.0, 1.525, 23.559, 11.171),
    (2.0, 3.153, 8.823, 165.53),
    (4.0, 2.372, 30.116, 49.656),
    (8.0, 1.899, 30.441, 15.838),
]


@pytest.mark.parametrize("row", CAMPAIGN, ids=str)
def test_the_default_box_holds_the_devices_of_the_paper(row: tuple[float, float, float, float]) -> None:
    peak, c0, k0, alpha = row
    motion = sine(peak, 1.0, 256.0, 5.0)
    x = np.array([c0, k0, alpha, 0.302, 0.001])
    force = twin.sinh(x.tolist(), motion)
    random = np.random.default_rng(8)
    for noise in (0.0, 0.005):  # of the peak force; 5 um
        recording = Recording(
            motion.time,
            motion.displacement + noise * random.normal(size=len(motion)),
            force + noise * np.abs(force).max() * random.normal(size=len(motion)),
        )
        problem = Problem(recording)
        assert ((problem.lower < x) & (x < problem.upper)).all()


MIDDLES: dict[str, Callable[[Array], Array]] = {
    "about 10 mm": lambda x: x + 10.0,
    "one side": lambda x: x + 2.0,
    "one push": lambda x: np.linspace(0.0, 4.0, len(x)),
}


@pytest.mark.parametrize("middle", MIDDLES)
def test_the_default_box_holds_a_device_that_is_not_tested_about_its_middle(middle: str) -> None:
    """F0 is the force at x = 0, which is not the mean force where the mean displacement is not 0."""
    t = sine(2.0, 1.0, 256.0, 5.0).time
    x = MIDDLES[middle](sine(2.0, 1.0, 256.0, 5.0).displacement)
    problem = Problem(Recording(t, x, 5.0 * x), "kelvin_voigt")
    truth = np.array([0.0, 5.0, 0.0])
    assert ((problem.lower <= truth) & (truth <= problem.upper)).all()


# Bad input

GOOD = THREE[0]


def ask(
    recordings: Recording | Sequence[Recording] = GOOD,
    model: str = "sinh",
    bounds: Mapping[str, tuple[float, float]] | None = None,
    weights: str | ArrayLike | None = None,
) -> Problem:
    return Problem(recordings, model, bounds, weights=weights)


def silent(name: str = "") -> Recording:
    return Recording(GOOD.time, GOOD.displacement, None, name=name)


UNFORCED = Recording(GOOD.time, GOOD.displacement, np.zeros(len(GOOD)))
VARYING = measured(motion_of(GOOD), current=np.linspace(0.5, 2.0, len(GOOD)))
WORD: Any = "abcde"

BAD: dict[str, tuple[Callable[[], object], list[str]]] = {
    "no recording": (lambda: ask([]), ["recordings is an empty list", "at least one"]),
    "unknown model": (lambda: ask(model="dahl"), ["model is 'dahl'", "one of kelvin_voigt, sinh, bouc_wen"]),
    "no force": (lambda: ask(silent()), ["no force"]),
    "no force in a named recording": (lambda: ask([GOOD, silent("b")]), ["recording 'b'", "no force"]),
    "zero force": (lambda: ask(UNFORCED), ["force is zero throughout"]),
    "zero force and its weight": (lambda: ask(UNFORCED, weights="force"), ["force is zero throughout"]),
    "current in one recording only": (lambda: ask([VARYING, GOOD]), ["no current", "another recording"]),
    "unknown bound": (
        lambda: ask(bounds={"c9": (0.0, 1.0)}),
        ["'c9'", "one of c0, k0, alpha, beta, F0"],
    ),
    "bound of another model": (lambda: ask(bounds={"rho": (0.0, 1.0)}), ["'rho'", "one of c0"]),
    "bound of another level": (
        lambda: ask(VARYING, bounds={"c0(3 A)": (0.0, 1.0)}),
        ["'c0(3 A)'", "c0(0.5 A), c0(2 A)"],
    ),
    "bounds reversed": (lambda: ask(bounds={"c0": (1.0, 0.0)}), ["bound of c0 is 1:0", "below"]),
    "bounds equal": (lambda: ask(bounds={"c0": (1.0, 1.0)}), ["bound of c0 is 1:1", "below"]),
    "bound nan": (lambda: ask(bounds={"c0": (0.0, math.nan)}), ["bound of c0 is 0:NaN", "finite"]),
    "bound infinite": (lambda: ask(bounds={"c0": (0.0, math.inf)}), ["bound of c0 is 0:inf", "finite"]),
    "negative damping": (lambda: ask(bounds={"c0": (-1.0, 1.0)}), ["bound of c0 is -1:1", "within 0"]),
    "sigma below a half": (
        lambda: ask(model="bouc_wen", bounds={"sigma": (0.4, 1.0)}),
        ["bound of sigma is 0.4:1", "within 0.5"],
    ),
    "n below one": (
        lambda: ask(model="bouc_wen", bounds={"n": (0.5, 2.0)}),
        ["bound of n is 0.5:2", "within 1"],
    ),
    "negative rho": (
        lambda: ask(model="bouc_wen", bounds={"rho": (-1.0, 2.0)}),
        ["bound of rho is -1:2", "within 0"],
    ),
    "unknown weights": (lambda: ask(weights="none"), ["weights is 'none'", "'samples', 'force'"]),
    "too many weights": (lambda: ask(weights=[1.0, 2.0]), ["weights is 2 numbers", "1"]),
    "weight zero": (lambda: ask(weights=[0.0]), ["weight is 0", "positive"]),
    "weight negative": (lambda: ask(weights=[-2.0]), ["weight is -2", "positive"]),
    "weight nan": (lambda: ask(weights=[math.nan]), ["weight is NaN", "positive"]),
    "short candidate": (lambda: ask().fitness([1.0] * 4), ["x is", "(n, 5) or (5,)"]),
    "narrow rows": (lambda: ask().fitness(np.ones((3, 4))), ["shape (3, 4)", "(n, 5) or (5,)"]),
    "deep rows": (lambda: ask().fitness(np.ones((1, 1, 5))), ["shape (1, 1, 5)", "(n, 5)"]),
    "a word": (lambda: ask().fitness(WORD), ["x is str", "(n, 5)"]),
    "no threads": (lambda: ask().fitness([1.0] * 5, threads=0), ["threads is 0", "from 1 to 1024"]),
    "negative threads": (lambda: ask().fitness([1.0] * 5, threads=-1), ["threads is -1"]),
    "too many threads": (lambda: ask().fitness([1.0] * 5, threads=10**6), ["threads is 1000000"]),
    "levels of a short candidate": (lambda: ask().levels([1.0] * 4), ["x is", "5"]),
    "bounds of a short candidate": (lambda: ask().on_bound([1.0] * 6), ["x is", "5"]),
}


@pytest.mark.parametrize("case", BAD)
def test_bad_input_is_named_in_one_line(case: str) -> None:
    make, pieces = BAD[case]
    with pytest.raises(MreError) as caught:
        make()
    assert isinstance(caught.value, ValueError)
    for piece in pieces:
        assert piece in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_value_does_not_depend_on_the_others_at_any_shape() -> None:
    # Below n = 1 the hysteretic variable turns so sharply that the last bit of a velocity counts.
    draw = np.random.default_rng(0)
    for _ in range(500):
        n = int(draw.integers(12, 60))
        time = np.cumsum(np.exp(draw.normal(0, draw.choice([0, 1, 2]), n))) * 0.02
        problem = Problem(Recording(time, draw.normal(size=n), draw.normal(size=n)), "bouc_wen")
        shapes = [
            10.0 ** draw.uniform(-1, 2, 3),
            draw.uniform(0, 2, 3),
            draw.choice([0, 0.1, 0.7, 1, 2, 3.5], 3),
        ]
        rows = np.column_stack([np.ones(3), np.ones(3), np.full(3, 10.0), *shapes, np.ones(3)])
        assert [problem.fitness(row) for row in rows] == problem.fitness(rows).tolist()
