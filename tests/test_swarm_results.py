"""What the swarms promise whoever calls them: seeds, results, budgets, ask and tell."""

from collections.abc import Callable

import mre_core
import numpy as np
import pytest
from mre_core import AskTell, Problem, Recording, StopReason, SwarmResult
from numpy.typing import NDArray
from rig import BOUC_WEN, made_of, motion, record

Array = NDArray[np.float64]
SWARMS: dict[str, Callable[..., SwarmResult]] = {
    "mafsa": mre_core.mafsa,
    "afsa": mre_core.afsa,
    "pso": mre_core.pso,
}
BOX = [(-5.0, 5.0), (-3.0, 4.0), (0.0, 2.0)]


def bowl(points: Array) -> Array:
    """Smallest, 0.5, at (1, -2, 0.7)."""
    return np.asarray(0.5 + ((points - [1.0, -2.0, 0.7]) ** 2 * [1.0, 3.0, 10.0]).sum(axis=1))


def same(a: SwarmResult, b: SwarmResult) -> bool:
    return (
        a.parameters == b.parameters
        and a.fitness == b.fitness
        and a.history.tobytes() == b.history.tobytes()
        and a.behaviours == b.behaviours
    )


@pytest.mark.parametrize("model", ["sinh", "bouc_wen"])
@pytest.mark.parametrize("swarm", SWARMS)
def test_same_seed_same_bits_for_any_number_of_threads(swarm: str, model: str, sinh_4mm: Recording) -> None:
    problem = Problem([sinh_4mm, record(made_of("bouc_wen", BOUC_WEN), motion(2.0, rate=100))], model)
    one, two, eight = (SWARMS[swarm](problem, seed=4, max_iterations=4, threads=n) for n in (1, 2, 8))
    assert same(one, two)
    assert same(one, eight)
    assert not same(one, SWARMS[swarm](problem, seed=5, max_iterations=4))


@pytest.mark.parametrize("swarm", SWARMS)
def test_drawn_seed_can_be_used_again(swarm: str) -> None:
    first = SWARMS[swarm](bowl, BOX, max_iterations=5)
    assert same(first, SWARMS[swarm](bowl, BOX, seed=first.seed, max_iterations=5))
    assert first.seed != SWARMS[swarm](bowl, BOX, max_iterations=1).seed


@pytest.mark.parametrize("swarm", SWARMS)
def test_result_of_a_function(swarm: str) -> None:
    seen: list[Array] = []

    def function(points: Array) -> Array:
        seen.append(points.copy())
        return bowl(points)

    result = SWARMS[swarm](function, {"a": BOX[0], "b": BOX[1], "c": BOX[2]}, seed=1, max_iterations=40)
    points = np.concatenate(seen)
    assert list(result.values) == ["a", "b", "c"]
    assert result.nfev == len(points)
    # The best point ever evaluated is what is returned.
    assert result.fun == bowl(points).min()
    np.testing.assert_array_equal(result.x, points[bowl(points).argmin()])
    history = result.history
    assert (result.nit, len(history)) == (40, 41)
    # The first row is the initial swarm.
    assert history["evaluations"][0] == len(seen[0]) == 50
    assert history["best"][0] == bowl(seen[0]).min()
    assert history["mean"][0] == pytest.approx(bowl(seen[0]).mean(), rel=1e-12)
    assert (history["best"][-1], history["evaluations"][-1]) == (result.fun, result.nfev)
    assert (np.diff(history["best"]) <= 0).all()
    assert result.reason is StopReason.MAX_ITERATIONS
    assert len(str(result).splitlines()) <= 24


@pytest.mark.parametrize("swarm", SWARMS)
@pytest.mark.parametrize("start", [None, [0.9, -1.9, 0.6]])
def test_ask_and_tell_is_the_same_swarm(swarm: str, start: list[float] | None) -> None:
    settings = {"max_iterations": 12, "x0": start}
    whole = SWARMS[swarm](bowl, BOX, seed=9, **settings)
    parts = AskTell(swarm, BOX, seed=9, **settings)
    evaluations = 0
    while not parts.finished:
        points = parts.ask()
        evaluations += len(points)
        parts.tell(bowl(points))
    best, cost = parts.best
    np.testing.assert_array_equal(best, whole.x)
    assert (cost, evaluations, parts.seed) == (whole.fun, whole.nfev, 9)
    if start is not None:
        assert whole.history["best"][0] <= bowl(np.array([start]))[0]


def test_start_is_kept_only_by_whoever_asks() -> None:
    far = mre_core.pso(bowl, BOX, seed=1, max_iterations=1, n_particles=2)
    near = mre_core.pso(bowl, BOX, seed=1, max_iterations=1, n_particles=2, x0=[1.0, -2.0, 0.7])
    assert near.fun == 0.5 < far.fun
    # Outside the box: at the nearest bound.
    edge = mre_core.pso(bowl, BOX, seed=1, max_iterations=1, n_particles=2, x0=[1.0, -2.0, 99.0])
    assert edge.history["best"][0] <= bowl(np.array([[1.0, -2.0, 2.0]]))[0]


@pytest.mark.parametrize("swarm", SWARMS)
def test_budgets(swarm: str, sinh_4mm: Recording) -> None:
    problem = Problem(sinh_4mm, "sinh")
    whole = SWARMS[swarm](problem, seed=1, max_iterations=20)
    # Kept to the last evaluation, in the middle of a generation.
    for budget in (1, 49, 51, 333):
        part = SWARMS[swarm](problem, seed=1, max_iterations=20, max_evaluations=budget)
        assert (part.nfev, part.reason) == (budget, StopReason.MAX_EVALUATIONS)
        assert np.isfinite(part.fun)
    target = float(whole.history["best"][10])
    part = SWARMS[swarm](problem, seed=1, max_iterations=20, target=target)
    assert part.reason is StopReason.TARGET
    assert part.fun <= target
    assert part.nfev < whole.nfev
    part = SWARMS[swarm](problem, seed=1, max_iterations=10**6, time_limit=0.05)
    assert part.reason is StopReason.TIME_LIMIT


@pytest.mark.parametrize("swarm", SWARMS)
def test_failures_are_counted_and_never_nan(swarm: str) -> None:
    def holes(points: Array) -> Array:
        costs = bowl(points)
        costs[points[:, 0] < 0] = np.nan
        return costs

    result = SWARMS[swarm](holes, BOX, seed=1, max_iterations=10)
    assert 0 < result.n_failures < result.nfev
    assert np.isfinite(result.fun)
    assert result.x[0] >= 0
    assert not any(np.isnan(result.history[column]).any() for column in ("best", "mean"))


@pytest.mark.parametrize(
    ("give", "message"),
    [
        (lambda: mre_core.pso(lambda p: p.sum(), BOX, seed=1), "value of the function"),
        (lambda: mre_core.pso(lambda p: np.zeros(3), BOX, seed=1), "3"),
        (lambda: mre_core.pso(bowl, seed=1), "bounds are missing"),
        (lambda: mre_core.pso(bowl, [(1.0, 0.0)], seed=1), "1:0"),
        (lambda: mre_core.pso(bowl, [(0.0, 1.0, 2.0)], seed=1), "bounds cannot be read"),  # type: ignore[list-item]
        (lambda: mre_core.pso(bowl, BOX, seed=-1), "seed is -1"),
        (lambda: mre_core.mafsa(bowl, BOX, seed=1, schedule="x"), "'x'"),  # type: ignore[arg-type]
        (lambda: mre_core.mafsa(bowl, BOX, seed=1, delta=-1.0), "delta is -1"),
        (lambda: mre_core.mafsa(bowl, BOX, seed=1, p=31), "p is 31"),
        (lambda: mre_core.pso(bowl, BOX, seed=1, on_interrupt="x"), "on_interrupt"),  # type: ignore[arg-type]
        (lambda: AskTell("ga", BOX), "'ga'"),
        (lambda: mre_core.identify([], "sinh"), "empty list"),
    ],
)
def test_what_cannot_be_used_is_said(give: Callable[[], object], message: str) -> None:
    with pytest.raises(mre_core.MreError, match=message) as caught:
        give()
    assert "\n" not in str(caught.value)


def test_wrong_keyword_is_a_type_error() -> None:
    with pytest.raises(TypeError, match="n_fisch"):
        mre_core.mafsa(bowl, BOX, n_fisch=3)  # type: ignore[call-arg]
    with pytest.raises(TypeError, match="n_fisch"):
        AskTell("mafsa", BOX, n_fisch=3)
