"""What holds for every swarm, whatever its settings, seed, box and costs."""

from collections.abc import Callable
from dataclasses import asdict, replace
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from mre_core._core import Swarm
from numpy.typing import NDArray
from reference.fish import FishSettings, FishSwarm
from reference.particles import ParticleSettings, ParticleSwarm

Array = NDArray[np.float64]
AnySettings = FishSettings | ParticleSettings
Box = tuple[Array, Array]

# The same examples every time: a test that fails once in a hundred runs helps nobody.
steady = settings(
    derandomize=True, deadline=None, max_examples=150, suppress_health_check=[HealthCheck.too_slow]
)

seeds = st.integers(0, 2**64 - 1)


def shares(least: float) -> st.SearchStrategy[float]:
    return st.floats(least, 1.0)


fish = st.builds(
    FishSettings,
    n_fish=st.integers(1, 8),
    max_iterations=st.integers(1, 8),
    try_number=st.integers(1, 4),
    delta=shares(0.0),
    visual=shares(1e-3),
    step=shares(1e-3),
    visual_min=st.floats(0.0, 0.1),
    step_min=st.floats(0.0, 0.1),
    p=st.integers(1, 30),
    schedule=st.sampled_from(["start", "recursive", "constant"]),
    neighbourhood=st.sampled_from(["swarm", "visual"]),
    crowd=st.sampled_from(["literal", "visual", "none"]),
    search=st.sampled_from(["best", "step"]),
)
particles = st.builds(
    ParticleSettings,
    n_particles=st.integers(1, 8),
    max_iterations=st.integers(1, 12),
    inertia_start=st.floats(0.0, 1.2),
    inertia_end=st.floats(0.0, 1.2),
    cognitive=st.floats(0.0, 3.0),
    social=st.floats(0.0, 3.0),
    speed=shares(1e-3),
)
swarms = st.one_of(fish, particles)


@st.composite
def boxes(draw: st.DrawFn) -> Box:
    d = draw(st.integers(1, 4))
    lower = np.array(draw(st.lists(st.floats(-1e6, 1e6), min_size=d, max_size=d)))
    width = np.array(draw(st.lists(st.floats(1e-3, 1e6), min_size=d, max_size=d)))
    return lower, lower + width


def compiled(chosen: AnySettings, seed: int, box: Box) -> Swarm:
    kind = "mafsa" if isinstance(chosen, FishSettings) else "pso"
    return Swarm(kind, asdict(chosen), seed, lower=box[0], upper=box[1])


def bowl(rows: Array) -> Array:
    """Best inside the boxes of the tests that use it."""
    away: Array = ((rows - 0.3) ** 2).sum(axis=1)
    return away


def scripted(seed: int) -> Callable[[Array], Array]:
    """Costs of any sign and size that have nothing to do with the place; some fail."""
    rng = np.random.default_rng(seed)

    def cost(rows: Array) -> Array:
        told = rng.normal(size=len(rows)) * 10.0 ** rng.integers(-6, 6, size=len(rows))
        fails = rng.random(len(rows))
        told[fails < 0.2] = np.inf
        told[fails < 0.1] = np.nan
        return told

    return cost


def lead(swarm: Swarm, cost: Callable[[Array], Array]) -> tuple[list[Array], list[Array]]:
    """Ask and tell to the end; what was asked and what was told."""
    asked, told = [], []
    while not swarm.finished:
        rows = swarm.ask()
        asked.append(rows)
        told.append(cost(rows))
        swarm.tell(told[-1])
    return asked, told


UNIT: Box = (np.array([-1.0, -2.1]), np.array([2.0, 1.3]))
BOTH: list[AnySettings] = [FishSettings(n_fish=6, crowd="none"), ParticleSettings(n_particles=6)]
both = pytest.mark.parametrize("chosen", BOTH, ids=["fish", "particles"])


# Paths


@steady
@given(swarms, seeds, boxes(), seeds)
def test_rows_stay_in_the_box_and_the_best_is_the_least(
    chosen: AnySettings, seed: int, box: Box, script: int
) -> None:
    swarm = compiled(chosen, seed, box)
    asked, told = lead(swarm, scripted(script))
    rows, costs = np.concatenate(asked), np.concatenate(told)
    assert np.all(rows >= box[0])
    assert np.all(rows <= box[1])
    finite = np.where(np.isfinite(costs), costs, np.inf)
    x, cost = swarm.best
    assert cost == finite.min()
    if np.isfinite(cost):
        np.testing.assert_array_equal(x, rows[int(np.argmin(finite))])
    assert swarm.evaluations == (len(rows), int(np.isinf(finite).sum()))
    history = swarm.history
    assert len(history["best"]) == chosen.max_iterations + 1
    assert np.all(history["best"][1:] <= history["best"][:-1])
    assert history["best"][-1] == cost
    ends = history["evaluations"].astype(int)
    assert ends[-1] == len(rows)
    np.testing.assert_array_equal(history["best"], [finite[:end].min() for end in ends])
    if isinstance(chosen, FishSettings):
        assert sum(swarm.behaviours.values()) == chosen.n_fish * chosen.max_iterations


@steady
@given(swarms, seeds, st.sampled_from([2.0, 0.7]))
def test_any_settings_agree_with_the_twin(chosen: AnySettings, seed: int, shift: float) -> None:
    def cost(rows: Array) -> Array:
        return bowl(rows) - shift

    twin: FishSwarm | ParticleSwarm
    if isinstance(chosen, FishSettings):
        twin = FishSwarm(cost, chosen, seed, *UNIT)
    else:
        twin = ParticleSwarm(cost, chosen, seed, *UNIT)
    twin.run()
    asked, _ = lead(compiled(chosen, seed, UNIT), cost)
    assert [rows.shape for rows in asked] == [rows.shape for rows in twin.board.batches]
    for mine, theirs in zip(twin.board.batches, asked, strict=True):
        np.testing.assert_allclose(theirs, mine, rtol=1e-10, atol=1e-10)


@steady
@given(swarms, seeds, boxes())
def test_equal_seeds_give_equal_bits_and_others_differ(chosen: AnySettings, seed: int, box: Box) -> None:
    first, second = (compiled(chosen, seed, box) for _ in range(2))
    for one, two in zip(lead(first, bowl)[0], lead(second, bowl)[0], strict=True):
        np.testing.assert_array_equal(one, two)
    for name, column in first.history.items():
        np.testing.assert_array_equal(column, second.history[name])
    other = compiled(chosen, (seed + 1) % 2**64, box).ask()
    assert not np.any(other == compiled(chosen, seed, box).ask())


@steady
@given(swarms, seeds, boxes(), st.integers(1, 4))
def test_asking_again_changes_nothing(chosen: AnySettings, seed: int, box: Box, times: int) -> None:
    swarm, patient = compiled(chosen, seed, box), compiled(chosen, seed, box)
    while not swarm.finished:
        rows = swarm.ask()
        for _ in range(times):
            again = patient.ask()
            np.testing.assert_array_equal(again, rows)
            # What the caller does with the rows is not the swarm's business.
            again[:] = 0.0
        swarm.tell(bowl(rows))
        patient.tell(bowl(rows))
    assert patient.finished
    assert patient.ask().shape == (0, len(box[0]))


@steady
@given(fish, seeds, st.randoms(use_true_random=False))
def test_the_order_of_the_fish_does_not_matter(chosen: FishSettings, seed: int, random: Any) -> None:
    """Fish act at the same time, so fish with exchanged streams swim exchanged paths.

    Only the twin can be asked: the compiled swarm gives stream number i to fish number i, and the twin
    is held to it by the other tests.
    """
    order = list(range(chosen.n_fish))
    random.shuffle(order)
    straight = FishSwarm(bowl, chosen, seed, *UNIT)
    permuted = FishSwarm(bowl, chosen, seed, *UNIT, streams=order)
    straight.run()
    permuted.run()
    np.testing.assert_allclose(permuted.X, straight.X[order], rtol=1e-9, atol=1e-9)
    assert permuted.behaviours == straight.behaviours
    assert permuted.board.h == pytest.approx(straight.board.h, rel=1e-9, abs=1e-12)


@steady
@given(swarms, seeds, st.lists(st.tuples(st.floats(1e-6, 1e6), st.floats(-4.0, 4.0)), min_size=1, max_size=4))
def test_the_units_of_the_box_do_not_matter(
    chosen: AnySettings, seed: int, sizes: list[tuple[float, float]]
) -> None:
    # A share of the box keeps its digits only in boxes not far from zero in terms of their width, and
    # fish that look around by less than those digits would decide by rounding.
    if isinstance(chosen, FishSettings):
        chosen = replace(chosen, visual_min=max(chosen.visual_min, 1e-3))
    lower = np.array([width * offset for width, offset in sizes])
    box: Box = (lower, lower + np.array([width for width, _ in sizes]))
    plain: Box = (np.zeros(len(lower)), np.ones(len(lower)))

    def share(rows: Array) -> Array:
        unit: Array = (rows - box[0]) / (box[1] - box[0])
        return unit

    asked, _ = lead(compiled(chosen, seed, plain), bowl)
    scaled, _ = lead(compiled(chosen, seed, box), lambda rows: bowl(share(rows)))
    assert [rows.shape for rows in asked] == [rows.shape for rows in scaled]
    for one, two in zip(asked, scaled, strict=True):
        np.testing.assert_allclose(share(two), one, rtol=0.0, atol=1e-9)


@steady
@given(swarms, seeds, st.sampled_from([np.nan, np.inf, -np.inf]))
def test_a_cost_that_always_fails_gives_no_nan(chosen: AnySettings, seed: int, fails: float) -> None:
    swarm = compiled(chosen, seed, UNIT)
    asked, _ = lead(swarm, lambda rows: np.full(len(rows), fails))
    x, cost = swarm.best
    assert cost == np.inf
    assert np.all(np.isfinite(x))
    assert not any(np.isnan(column).any() for column in swarm.history.values())
    assert np.all(np.isfinite(np.concatenate(asked)))
    n = sum(len(rows) for rows in asked)
    assert swarm.evaluations == (n, n)


# Stopping


@steady
@given(swarms, seeds, st.floats(0.0, 1.2))
def test_the_budget_of_evaluations_is_kept(chosen: AnySettings, seed: int, share: float) -> None:
    everything = np.concatenate(lead(compiled(chosen, seed, UNIT), bowl)[0])
    most = max(1, round(share * len(everything)))
    seen: list[Array] = []

    def cost(rows: Array) -> Array:
        seen.append(rows)
        return bowl(rows)

    swarm = compiled(chosen, seed, UNIT)
    reason = swarm.run_function(cost, max_evaluations=most)
    rows = np.concatenate(seen)
    # Not only as many: the very rows an unlimited run begins with.
    np.testing.assert_array_equal(rows, everything[:most])
    assert swarm.evaluations == (min(most, len(everything)), 0)
    assert swarm.best[1] == bowl(rows).min()
    if most < len(everything):
        assert reason == "max_evaluations"
    elif most > len(everything):
        assert reason == "max_iterations"


@both
def test_the_function_is_never_called_without_rows(chosen: AnySettings) -> None:
    """A budget that ends with a generation leaves nothing to evaluate."""
    sizes: list[int] = []

    def cost(rows: Array) -> Array:
        sizes.append(len(rows))
        return bowl(rows)

    assert compiled(chosen, 1, UNIT).run_function(cost, max_evaluations=6) == "max_evaluations"
    assert sizes == [6]


@both
def test_a_budget_that_is_already_spent_stops_at_once(chosen: AnySettings) -> None:
    swarm = compiled(chosen, 1, UNIT)
    swarm.tell(bowl(swarm.ask()))
    assert swarm.run_function(bowl, max_evaluations=5) == "max_evaluations"
    assert swarm.evaluations == (6, 0)


@steady
@given(swarms, seeds, st.floats(0.0, 1.0))
def test_the_target_stops_with_its_generation(chosen: AnySettings, seed: int, share: float) -> None:
    asked, told = lead(compiled(chosen, seed, UNIT), bowl)
    bests = np.minimum.accumulate([costs.min() for costs in told])
    target = float(bests[-1] + share * (bests[0] - bests[-1]))
    swarm = compiled(chosen, seed, UNIT)
    assert swarm.run_function(bowl, target=target) == "target"
    batches = int(np.argmax(bests <= target)) + 1
    assert swarm.best[1] == bests[batches - 1]
    assert swarm.evaluations == (sum(len(rows) for rows in asked[:batches]), 0)


@both
def test_a_target_out_of_reach_stops_nothing(chosen: AnySettings) -> None:
    swarm = compiled(chosen, 1, UNIT)
    assert swarm.run_function(bowl, target=-1e-300) == "max_iterations"
    assert swarm.finished


@both
def test_running_equals_asking_and_telling(chosen: AnySettings) -> None:
    led, run = compiled(chosen, 9, UNIT), compiled(chosen, 9, UNIT)
    lead(led, bowl)
    assert run.run_function(bowl) == "max_iterations"
    for name, column in led.history.items():
        np.testing.assert_array_equal(run.history[name], column)
    np.testing.assert_array_equal(run.best[0], led.best[0])


@both
def test_a_stopped_run_goes_on_where_it_stood(chosen: AnySettings) -> None:
    whole, parts = compiled(chosen, 9, UNIT), compiled(chosen, 9, UNIT)
    whole.run_function(bowl)
    assert parts.run_function(bowl, callback=lambda i, n, best: i >= 3) == "callback"
    assert not parts.finished
    assert parts.run_function(bowl) == "max_iterations"
    np.testing.assert_array_equal(parts.history["best"], whole.history["best"])


@both
def test_time_that_is_up_stops(chosen: AnySettings) -> None:
    """No clock is that fast: a nanosecond is over after the first generation."""
    swarm = compiled(chosen, 1, UNIT)
    assert swarm.run_function(bowl, time_limit=1e-9) == "time_limit"
    assert swarm.evaluations == (6, 0)


@both
def test_the_callback_follows_and_stops(chosen: AnySettings) -> None:
    reports: list[tuple[int, int, float]] = []

    def callback(iteration: int, evaluations: int, best: float) -> bool:
        reports.append((iteration, evaluations, best))
        return len(reports) == 5

    swarm = compiled(chosen, 1, UNIT)
    assert swarm.run_function(bowl, callback=callback) == "callback"
    assert len(reports) == 5
    iterations, evaluations, bests = (np.array(column) for column in zip(*reports, strict=True))
    assert np.all(np.diff(iterations) >= 0)
    assert np.all(np.diff(evaluations) >= 0)
    assert np.all(bests[1:] <= bests[:-1])
    assert swarm.evaluations[0] >= evaluations[-1] > 0
    assert swarm.best[1] <= bests[-1]


@both
@pytest.mark.parametrize("answer", [None, False, 0])
def test_a_callback_that_wants_nothing_stops_nothing(chosen: AnySettings, answer: object) -> None:
    reports: list[int] = []

    def callback(iteration: int, evaluations: int, best: float) -> Any:
        reports.append(iteration)
        return answer

    assert compiled(chosen, 1, UNIT).run_function(bowl, callback=callback) == "max_iterations"
    assert reports[-1] == chosen.max_iterations


# Exceptions


class OwnError(Exception):
    pass


def after(calls: int, error: BaseException) -> Callable[[Array], Array]:
    """A bowl that raises after so many calls."""
    left = [calls]

    def cost(rows: Array) -> Array:
        if left[0] == 0:
            raise error
        left[0] -= 1
        return bowl(rows)

    return cost


@both
@pytest.mark.parametrize("calls", [0, 1, 4])
@pytest.mark.parametrize("on_interrupt", ["raise", "return"])
def test_an_exception_of_the_function_arrives(chosen: AnySettings, calls: int, on_interrupt: str) -> None:
    swarm = compiled(chosen, 1, UNIT)
    error = OwnError("out of rubber")
    with pytest.raises(OwnError) as caught:
        swarm.run_function(after(calls, error), on_interrupt=on_interrupt)
    assert caught.value is error
    # Nothing of the lost generation is counted; what was told before is kept.
    asked, told = lead(compiled(chosen, 1, UNIT), bowl)
    assert swarm.evaluations == (sum(len(rows) for rows in asked[:calls]), 0)
    assert swarm.best[1] == min([np.inf, *(float(costs.min()) for costs in told[:calls])])


@both
def test_an_exception_of_the_callback_arrives(chosen: AnySettings) -> None:
    error = OwnError("seen enough")

    def callback(iteration: int, evaluations: int, best: float) -> bool:
        if iteration >= 2:
            raise error
        return False

    swarm = compiled(chosen, 1, UNIT)
    with pytest.raises(OwnError) as caught:
        swarm.run_function(bowl, callback=callback)
    assert caught.value is error
    assert np.isfinite(swarm.best[1])


@both
@pytest.mark.parametrize("calls", [0, 3])
def test_an_interrupt_is_raised(chosen: AnySettings, calls: int) -> None:
    swarm = compiled(chosen, 1, UNIT)
    with pytest.raises(KeyboardInterrupt):
        swarm.run_function(after(calls, KeyboardInterrupt()))


@both
@pytest.mark.parametrize("calls", [1, 4])
def test_an_interrupt_can_keep_the_best(chosen: AnySettings, calls: int) -> None:
    swarm = compiled(chosen, 1, UNIT)
    assert swarm.run_function(after(calls, KeyboardInterrupt()), on_interrupt="return") == "interrupted"
    asked, told = lead(compiled(chosen, 1, UNIT), bowl)
    rows, costs = np.concatenate(asked[:calls]), np.concatenate(told[:calls])
    assert swarm.best[1] == costs.min()
    np.testing.assert_array_equal(swarm.best[0], rows[int(np.argmin(costs))])
    assert swarm.evaluations == (len(rows), 0)


def one_line(caught: pytest.ExceptionInfo[ValueError], *parts: str) -> None:
    message = str(caught.value)
    assert "\n" not in message
    for part in parts:
        assert part in message, message


@both
@pytest.mark.parametrize("count", [0, 1, 5, 7])
def test_a_wrong_number_of_costs_is_refused(chosen: AnySettings, count: int) -> None:
    swarm = compiled(chosen, 1, UNIT)
    rows = swarm.ask()
    with pytest.raises(ValueError) as caught:
        swarm.tell(np.zeros(count))
    one_line(caught, "costs", str(count), "6")
    with pytest.raises(ValueError) as caught:
        swarm.run_function(lambda rows: np.zeros(count))
    one_line(caught, "costs", str(count), "6")
    # The refusal changed nothing.
    np.testing.assert_array_equal(swarm.ask(), rows)
    assert swarm.evaluations == (0, 0)


BAD_FISH: list[tuple[str, float | str]] = [
    *[(name, value) for name in ("n_fish", "max_iterations", "try_number") for value in (0, -1)],
    *[("delta", value) for value in (2.0, -0.1, np.nan)],
    *[("p", value) for value in (0, 31, -2)],
    *[(name, value) for name in ("visual", "step") for value in (0.0, -0.5, 1.5, np.nan, np.inf)],
    *[(name, value) for name in ("visual_min", "step_min") for value in (-0.5, 1.5, np.nan)],
    *[(name, "sideways") for name in ("schedule", "neighbourhood", "crowd", "search")],
]
BAD_PARTICLES: list[tuple[str, float | str]] = [
    *[(name, value) for name in ("n_particles", "max_iterations") for value in (0, -1)],
    *[("speed", value) for value in (0.0, -0.5, 1.5, np.nan)],
    *[
        (n, v)
        for n in ("inertia_start", "inertia_end", "cognitive", "social")
        for v in (-1.0, np.nan, np.inf)
    ],
]


@pytest.mark.parametrize(
    ("kind", "name", "value"),
    [*(("mafsa", *bad) for bad in BAD_FISH), *(("pso", *bad) for bad in BAD_PARTICLES)],
)
def test_a_bad_setting_is_named(kind: str, name: str, value: float | str) -> None:
    good = asdict(FishSettings() if kind == "mafsa" else ParticleSettings())
    Swarm(kind, good, 1, lower=UNIT[0], upper=UNIT[1])
    with pytest.raises(ValueError) as caught:
        Swarm(kind, {**good, name: value}, 1, lower=UNIT[0], upper=UNIT[1])
    shown = value if isinstance(value, str) else f"{value:g}".replace("nan", "NaN")
    one_line(caught, name, shown)


@pytest.mark.parametrize(
    ("lower", "upper", "shown"),
    [
        ([0.0, 1.0], [1.0, 1.0], "1:1"),
        ([0.0, 2.0], [1.0, 1.0], "2:1"),
        ([0.0, np.nan], [1.0, 1.0], "NaN"),
        ([0.0, 0.0], [1.0, np.inf], "inf"),
    ],
)
def test_a_bad_box_is_refused(lower: list[float], upper: list[float], shown: str) -> None:
    with pytest.raises(ValueError) as caught:
        Swarm("mafsa", asdict(FishSettings()), 1, lower=lower, upper=upper, names=["k0", "c0"])
    one_line(caught, "c0", shown)


@pytest.mark.parametrize(
    "limits", [{"max_evaluations": 0}, {"max_evaluations": -1}, {"time_limit": -1.0}, {"target": np.nan}]
)
def test_a_bad_limit_is_refused(limits: dict[str, Any]) -> None:
    swarm = compiled(FishSettings(), 1, UNIT)
    with pytest.raises(ValueError) as caught:
        swarm.run_function(bowl, **limits)
    one_line(caught, *limits)
    assert swarm.evaluations == (0, 0)


def test_a_larger_swarm_of_both_kinds_finds_the_bottom() -> None:
    """Not a matter of luck: the bowl has one bottom, inside the box."""
    larger: list[AnySettings] = [
        FishSettings(n_fish=20, max_iterations=60, try_number=10),
        ParticleSettings(n_particles=20, max_iterations=100),
    ]
    for chosen in larger:
        for seed in range(5):
            swarm = compiled(chosen, seed, UNIT)
            swarm.run_function(bowl)
            np.testing.assert_allclose(swarm.best[0], 0.3, atol=0.05)
