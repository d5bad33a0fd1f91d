"""Whatever is recorded and whatever is asked for: a finite result, or one line that says why not."""

from typing import Any

import mre_core
import numpy as np
import pytest
from fuzz.drawn import numbers, recordings, scales
from fuzz.effort import effort, ended_soon
from hypothesis import given
from hypothesis import strategies as st
from mre_core import Level, Model, MreError, Problem, Recording, _core
from rig import force_of

MODELS = ("kelvin_voigt", "sinh", "bouc_wen")
SWARMS: dict[str, Any] = {"mafsa": mre_core.mafsa, "afsa": mre_core.afsa, "pso": mre_core.pso}


def one_line(error: MreError) -> None:
    assert len(str(error).splitlines()) == 1
    assert str(error)


@effort(40)
@given(recordings(), st.sampled_from(MODELS), st.sampled_from(["exact", "hybrid", *SWARMS]))
def test_identify(recording: Recording | None, model: str, optimizer: Any) -> None:
    if recording is None:
        return
    few: dict[str, Any] = {} if optimizer == "exact" else {"max_iterations": 2}
    few |= {"n_fish": 4} if optimizer in {"mafsa", "afsa", "hybrid"} else {}
    with ended_soon():
        try:
            found = mre_core.identify(recording, model, optimizer=optimizer, seed=1, **few)
        except MreError as error:
            return one_line(error)
        for run in found.runs:
            assert np.isfinite(run.x).all()
            assert np.isfinite(run.fitness) or not run.success
            assert run.fitness >= 0
        for fit in found.fits:
            known = [fit.rms, fit.peak_error] + (
                [fit.relative_rms] if np.ptp(force_of(recording)) > 0 else []
            )
            assert np.isfinite(known).all() or not found.runs[0].success
        if found.runs[0].success:
            assert np.isfinite(mre_core.simulate(found.model, recording)).all()
        str(found)


@effort(60)
@given(recordings(), st.sampled_from(MODELS), st.data())
def test_fitness(recording: Recording | None, model: str, data: st.DataObject) -> None:
    if recording is None:
        return
    with ended_soon():
        try:
            problem = Problem(recording, model)
        except MreError as error:
            return one_line(error)
        assert np.isfinite([problem.lower, problem.upper]).all()
        rows = data.draw(st.lists(st.tuples(*[numbers] * len(problem.names)), min_size=1, max_size=9))
        costs = problem.fitness(np.array(rows))
        assert not np.isnan(costs).any()
        assert (costs >= 0).all()
        # Alone, together and on one thread the same bits.
        assert [problem.fitness(np.array(row)) for row in rows] == costs.tolist()
        assert problem.fitness(np.array(rows), threads=1).tolist() == costs.tolist()


@effort(60)
@given(recordings(force=False), st.sampled_from(MODELS), st.data())
def test_simulate(recording: Recording | None, model: str, data: st.DataObject) -> None:
    if recording is None:
        return
    names = [name for name, _ in _core.parameters(model)]
    currents = data.draw(st.lists(scales(2), min_size=1, max_size=3))
    with ended_soon():
        try:
            levels = [Level(i, {name: data.draw(numbers) for name in names}) for i in currents]
            force = mre_core.simulate(Model(model, tuple(levels)), recording)
        except MreError as error:
            return one_line(error)
    assert np.isfinite(force).all()


@effort(30)
@given(recordings(), st.sampled_from(MODELS[:2]), st.integers(0, 2**64 - 1))
def test_uncertainty(recording: Recording | None, model: str, seed: int) -> None:
    if recording is None:
        return
    with ended_soon():
        try:
            problem = Problem(recording, model)
            found = mre_core.exact(problem)
            told = mre_core.uncertainty(problem, found.x)
            boot = mre_core.bootstrap(problem, found.x, 3, seed=seed)
            proof = mre_core.certificate(problem, found)
        except MreError as error:
            return one_line(error)
        for estimate in told.parameters:
            assert estimate.low is None or estimate.low <= estimate.value <= (estimate.high or estimate.value)
        str(told), str(boot), str(proof)


@effort(20)
@given(
    st.sampled_from(sorted(SWARMS)),
    st.lists(st.tuples(numbers, numbers), min_size=1, max_size=4),
    st.dictionaries(
        st.sampled_from(
            ["n_fish", "n_particles", "try_number", "delta", "visual", "step", "p", "speed", "inertia_start"]
        ),
        st.one_of(numbers, st.integers(-2, 8)),
        max_size=3,
    ),
)
def test_swarms(swarm: str, bounds: list[tuple[float, float]], options: dict[str, Any]) -> None:
    with ended_soon():
        try:
            found = SWARMS[swarm](
                lambda x: np.where(x[:, 0] > 0, (x**2).sum(axis=1), np.nan),
                bounds,
                **({"max_iterations": 2, "seed": 1} | options),
            )
        except (MreError, TypeError) as error:
            assert len(str(error).splitlines()) == 1
            return
    lower, upper = np.array(bounds).T
    assert ((found.x >= lower) & (found.x <= upper)).all()
    assert not np.isnan(found.fitness)
    assert np.isfinite(found.fitness) or not found.success


def test_a_hanging_example_is_seen() -> None:
    import faulthandler

    with ended_soon(), pytest.raises(ZeroDivisionError):
        1 / 0  # noqa: B018
    assert faulthandler.is_enabled()
