"""The compiled swarms, batch by batch, against plain twins written from the paper."""

import math
from collections import Counter
from collections.abc import Callable
from dataclasses import asdict, replace
from functools import cache
from itertools import product

import numpy as np
import pytest
from mre_core._core import Swarm, inertia_weight, uniforms
from numpy.typing import NDArray
from reference.fish import FishSettings, FishSwarm
from reference.fish import inertia_weight as weight_of_paper
from reference.particles import ParticleSettings, ParticleSwarm

Array = NDArray[np.float64]

# Ends that are no round numbers in binary, and coordinates of different size.
LOWER = np.array([-1.0, -2.1, 0.5, -3.3, 0.01])
UPPER = np.array([2.0, 1.3, 4.0, 3.0, 0.07])


def bowl(rows: Array) -> Array:
    away: Array = ((rows - 0.3) ** 2).sum(axis=1)
    return away


def negative(rows: Array) -> Array:
    """Costs on both sides of zero, where the food changes its formula."""
    return bowl(rows) - 2.0


def holes(rows: Array) -> Array:
    """A bowl that cannot be evaluated on two sides."""
    cost = bowl(rows)
    cost[rows[:, 0] > 1.0] = np.nan
    cost[rows[:, 0] < -0.6] = np.inf
    return cost


def terraces(rows: Array) -> Array:
    """Many equal costs: the first of equals has to win on both sides."""
    cost: Array = np.floor(bowl(rows))
    return cost


def flat(rows: Array) -> Array:
    """All fish equally fed: nobody follows or swarms."""
    return np.zeros(len(rows))


COSTS: dict[str, Callable[[Array], Array]] = {f.__name__: f for f in (bowl, negative, holes, terraces, flat)}

# (seed, number of parameters, settings that do not decide between behaviours)
CASES = [
    (1, 2, FishSettings(n_fish=9, max_iterations=20, try_number=4, delta=0.1, step=0.3, p=5)),
    (7, 5, FishSettings(n_fish=12, max_iterations=15, try_number=3, delta=0.3, visual=0.6, p=2)),
    (2**64 - 1, 1, FishSettings(n_fish=4, max_iterations=25, try_number=2, delta=0.6, p=8)),
]

COMBINATIONS = list(
    product(
        ("start", "recursive", "constant"),
        ("swarm", "visual"),
        ("literal", "visual", "none"),
        ("best", "step"),
    )
)


def combined(settings: FishSettings, combination: tuple[str, str, str, str]) -> FishSettings:
    schedule, neighbourhood, crowd, search = combination
    return replace(settings, schedule=schedule, neighbourhood=neighbourhood, crowd=crowd, search=search)


@cache
def fish_twin(settings: FishSettings, seed: int, d: int, cost: str) -> FishSwarm:
    twin = FishSwarm(COSTS[cost], settings, seed, LOWER[:d], UPPER[:d])
    twin.run()
    return twin


def compiled(
    settings: FishSettings | ParticleSettings, seed: int, d: int, start: Array | None = None
) -> Swarm:
    kind = "mafsa" if isinstance(settings, FishSettings) else "pso"
    return Swarm(kind, asdict(settings), seed, lower=LOWER[:d], upper=UPPER[:d], start=start)


def assert_agree(swarm: Swarm, twin: FishSwarm | ParticleSwarm, cost: Callable[[Array], Array]) -> None:
    """Lead the compiled swarm through the batches of the twin."""
    board = twin.board
    # Places are compared in shares of the box, so that a coordinate near zero asks for no more digits.
    atol = 1e-12 * (board.upper - board.lower)
    for rows in board.batches:
        asked = swarm.ask()
        assert asked.shape == rows.shape
        off = np.abs(asked - rows) / (1e-12 * np.abs(rows) + atol)
        assert off.max() <= 1.0
        swarm.tell(cost(asked))
    assert swarm.finished
    assert swarm.ask().size == 0
    history = swarm.history
    for name in ("best", "mean", "range", "step"):
        np.testing.assert_allclose(
            history[name], twin.history.column(name), rtol=1e-9, atol=1e-12, err_msg=name
        )
    np.testing.assert_array_equal(history["evaluations"], twin.history.column("evaluations"))
    assert swarm.evaluations == (board.evaluations, board.failures)
    x, h = swarm.best
    np.testing.assert_allclose(x, board.best, rtol=1e-12, atol=float(atol.max()))
    assert h == pytest.approx(board.h, rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("cost", COSTS)
@pytest.mark.parametrize("combination", COMBINATIONS, ids="-".join)
def test_fish_swim_as_in_the_paper(combination: tuple[str, str, str, str], cost: str) -> None:
    for seed, d, settings in CASES:
        chosen = combined(settings, combination)
        swarm, twin = compiled(chosen, seed, d), fish_twin(chosen, seed, d, cost)
        assert_agree(swarm, twin, COSTS[cost])
        assert swarm.behaviours == twin.behaviours


@pytest.mark.parametrize("combination", COMBINATIONS, ids="-".join)
def test_the_cases_show_every_behaviour(combination: tuple[str, str, str, str]) -> None:
    """Otherwise the agreement above would say nothing about a behaviour that never happens."""
    seen: Counter[str] = Counter()
    for (seed, d, settings), cost in product(CASES, COSTS):
        seen.update(fish_twin(combined(settings, combination), seed, d, cost).behaviours)
    assert all(seen[name] > 0 for name in ("search", "swarm", "follow", "random")), seen


def test_the_cases_show_failures_and_walls() -> None:
    twins = [
        fish_twin(combined(settings, combination), seed, d, "holes")
        for (seed, d, settings), combination in product(CASES, COMBINATIONS)
    ]
    assert all(twin.board.failures > 0 for twin in twins)
    assert any(np.any(rows == twin.board.upper) for twin in twins for rows in twin.board.batches)
    assert any(np.any(rows == twin.board.lower) for twin in twins for rows in twin.board.batches)


def test_equally_fed_fish_only_search() -> None:
    for combination in COMBINATIONS:
        seed, d, settings = CASES[0]
        behaviours = fish_twin(combined(settings, combination), seed, d, "flat").behaviours
        assert behaviours == {"search": 0, "swarm": 0, "follow": 0, "random": 9 * 20}


@pytest.mark.parametrize("fails", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("search", ["best", "step"])
def test_fish_without_any_food(search: str, fails: float) -> None:
    def cost(rows: Array) -> Array:
        return np.full(len(rows), fails)

    settings = FishSettings(n_fish=5, max_iterations=15, search=search)
    twin = FishSwarm(cost, settings, 3, LOWER[:2], UPPER[:2])
    twin.run()
    swarm = compiled(settings, 3, 2)
    for rows in twin.board.batches:
        np.testing.assert_allclose(swarm.ask(), rows, rtol=1e-12, atol=1e-12)
        swarm.tell(cost(rows))
    assert swarm.finished
    assert swarm.behaviours == twin.behaviours == {"search": 0, "swarm": 0, "follow": 0, "random": 75}
    assert np.all(swarm.history["best"] == np.inf)


@pytest.mark.parametrize("search", ["best", "step"])
def test_a_lonely_fish_searches(search: str) -> None:
    settings = FishSettings(n_fish=1, max_iterations=25, search=search, crowd="none")
    twin = FishSwarm(bowl, settings, 11, LOWER[:3], UPPER[:3])
    twin.run()
    swarm = compiled(settings, 11, 3)
    assert_agree(swarm, twin, bowl)
    assert swarm.behaviours["swarm"] == swarm.behaviours["follow"] == 0


def test_the_first_fish_starts_where_it_is_told() -> None:
    settings = FishSettings(n_fish=6, crowd="none", search="step")
    start = np.array([0.2, -0.7])
    twin = FishSwarm(bowl, settings, 5, LOWER[:2], UPPER[:2], start)
    twin.run()
    assert_agree(compiled(settings, 5, 2, start), twin, bowl)
    told, free = compiled(settings, 5, 2, start).ask(), compiled(settings, 5, 2).ask()
    np.testing.assert_allclose(told[0], start, rtol=1e-14)
    np.testing.assert_array_equal(told[1:], free[1:])


def test_fish_that_meet_stay_and_draw_nothing() -> None:
    """A fish at its target: a distance of zero must neither divide nor cost a random number."""

    def ridge(rows: Array) -> Array:
        """Falls from the middle of the box to both ends, where fish gather in one place."""
        return -np.abs(rows[:, 0] - 0.4)

    settings = FishSettings(
        n_fish=6, step=0.5, visual=0.3, schedule="constant", neighbourhood="visual", delta=0.1
    )
    met = 0
    for seed, search in product(range(5), ("best", "step")):
        twin = FishSwarm(ridge, replace(settings, search=search), seed, LOWER[:1], UPPER[:1])
        twin.run()
        assert_agree(compiled(twin.s, seed, 1), twin, ridge)
        met += twin.met
    assert met > 10


def test_the_literal_crowd_test_never_lets_a_large_swarm_gather() -> None:
    """With 49 fellows the centre would need 29 times the food of the fish (delta 0.6)."""
    settings = FishSettings(n_fish=50, max_iterations=15, try_number=5)
    swarm = compiled(settings, 1, 2)
    swarm.run_function(bowl)
    assert swarm.behaviours["swarm"] == 0
    free = compiled(replace(settings, crowd="none"), 1, 2)
    free.run_function(bowl)
    assert free.behaviours["swarm"] > 0


PARTICLES = [
    (1, 2, ParticleSettings()),
    (7, 5, ParticleSettings(n_particles=12, max_iterations=25, speed=0.5, social=1.2, cognitive=2.5)),
    (2**64 - 1, 1, ParticleSettings(n_particles=3, max_iterations=15, inertia_start=0.4, inertia_end=1.1)),
    (6, 3, ParticleSettings(n_particles=1, max_iterations=15)),
    (5, 2, ParticleSettings(n_particles=6, max_iterations=1, inertia_start=0.8, inertia_end=0.1)),
]


@pytest.mark.parametrize("cost", COSTS)
@pytest.mark.parametrize(("seed", "d", "settings"), PARTICLES)
def test_particles_fly_as_their_twin(seed: int, d: int, settings: ParticleSettings, cost: str) -> None:
    twin = ParticleSwarm(COSTS[cost], settings, seed, LOWER[:d], UPPER[:d])
    twin.run()
    swarm = compiled(settings, seed, d)
    assert_agree(swarm, twin, COSTS[cost])
    assert swarm.evaluations[0] == settings.n_particles * (settings.max_iterations + 1)


def test_the_particles_reach_their_limits() -> None:
    """Some case of the above meets a wall, and some the largest speed."""
    twins = []
    for seed, d, settings in PARTICLES:
        twins.append(ParticleSwarm(bowl, settings, seed, LOWER[:d], UPPER[:d]))
        twins[-1].run()
    assert max(twin.walls for twin in twins) > 0
    assert max(twin.limits for twin in twins) > 0


def test_the_first_particle_starts_where_it_is_told() -> None:
    start = np.array([1.9, -2.0, 0.6])
    twin = ParticleSwarm(bowl, ParticleSettings(), 8, LOWER[:3], UPPER[:3], start)
    twin.run()
    assert_agree(compiled(ParticleSettings(), 8, 3, start), twin, bowl)


def test_particles_without_a_finite_cost() -> None:
    """The bulletin holds an evaluated point, the first of equals, also while all costs are infinite."""

    def hopeless(rows: Array) -> Array:
        return np.full(len(rows), np.inf)

    twin = ParticleSwarm(hopeless, ParticleSettings(), 2, LOWER[:2], UPPER[:2])
    twin.run()
    assert_agree(compiled(ParticleSettings(), 2, 2), twin, hopeless)


def test_the_weight_of_equation_8() -> None:
    for p in (1, 2, 5, 8, 30):
        for iteration in (0, 1, 37, 150, 299, 300):
            expected = math.exp(-20.0 * (iteration / 300) ** p)
            assert inertia_weight(iteration, 300, p) == pytest.approx(expected, rel=1e-12)
            assert weight_of_paper(iteration, 300, p) == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize(
    ("p", "share", "weight"),
    [
        *[(2, 0.2, 0.449), (2, 0.4, 0.041), (5, 0.4, 0.815), (5, 0.5, 0.535), (5, 0.6, 0.211)],
        *[(5, 0.7, 0.035), (8, 0.6, 0.715), (8, 0.7, 0.316), (8, 0.8, 0.035), (10, 0.7, 0.568)],
        (10, 0.8, 0.117),
    ],
)
def test_the_curves_of_figure_2(p: int, share: float, weight: float) -> None:
    assert inertia_weight(round(1000 * share), 1000, p) == pytest.approx(weight, abs=5.1e-4)


@pytest.mark.parametrize(
    ("schedule", "crossings"), [("start", (154, 195, 224)), ("recursive", (89, 109, 122))]
)
def test_when_the_schedule_falls(schedule: str, crossings: tuple[int, int, int]) -> None:
    """Iterations at which the factor falls below a half, a tenth, a hundredth (300 iterations, p = 5)."""
    settings = FishSettings(
        n_fish=1, max_iterations=300, try_number=1, visual_min=0.0, step_min=0.0, schedule=schedule
    )
    swarm = compiled(settings, 1, 1)
    assert swarm.run_function(bowl) == "max_iterations"
    for name, first in (("range", settings.visual), ("step", settings.step)):
        factor = swarm.history[name] / first
        assert tuple(int(np.argmax(factor < limit)) for limit in (0.5, 0.1, 0.01)) == crossings


def test_a_constant_schedule_stays() -> None:
    swarm = compiled(FishSettings(schedule="constant"), 1, 2)
    swarm.run_function(bowl)
    assert np.all(swarm.history["range"] == 0.4)
    assert np.all(swarm.history["step"] == 0.2)


def test_streams_are_uniform_and_their_own() -> None:
    drawn = np.array([uniforms(12, stream, 4000) for stream in range(8)])
    assert drawn.min() >= 0.0
    assert drawn.max() < 1.0
    assert np.all(np.abs(drawn.mean(axis=1) - 0.5) < 0.025)
    assert np.all(np.abs(drawn.var(axis=1) - 1 / 12) < 0.005)
    between = np.corrcoef(drawn) - np.eye(8)
    assert np.abs(between).max() < 0.08
    np.testing.assert_array_equal(uniforms(12, 3, 10), drawn[3, :10])
    assert not np.any(uniforms(13, 3, 10) == drawn[3, :10])
