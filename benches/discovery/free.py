"""Rivals that choose no columns: NARX (SysIdentPy) and symbolic regression (gplearn)."""

import numpy as np
from base import fitted, left_over
from choosing import prepare
from methods import Answer, said
from mre_core import Recording
from problem import Array, Problem, force_of

_LARGEST = 6000
"""Samples that these methods can take in reasonable time; more are thinned."""


def narx(problem: Problem) -> Answer:
    """Polynomial NARX by forward regression, run free on the test; it names no physics."""
    from sysidentpy.basis_function import Polynomial
    from sysidentpy.model_structure_selection import FROLS

    step = max(1, sum(len(r) for r in problem.train) // _LARGEST)
    scale = np.array([np.std(r) for r in _inputs(problem.train, 1).T])
    size = float(np.std(force_of(problem.train)))
    u, y = _inputs(problem.train, step) / scale, _forces(problem.train, step) / size
    model = FROLS(
        n_info_values=12,
        xlag=[[1, 2], [1, 2]],
        ylag=2,
        basis_function=Polynomial(degree=3),
        info_criteria="bic",
    )
    model.fit(X=u, y=y)
    start = _forces([problem.test], step) / size
    found = np.ravel(model.predict(X=_inputs([problem.test], step) / scale, y=start[: model.max_lag]))
    t = problem.test.time
    return Answer(None, "", size * np.interp(t, t[::step], found))


def _inputs(recordings: list[Recording], step: int) -> Array:
    return np.concatenate(
        [np.column_stack([r.displacement[::step], np.asarray(r.velocity)[::step]]) for r in recordings]
    )


def _forces(recordings: list[Recording], step: int) -> Array:
    return np.concatenate([np.asarray(r.force)[::step, None] for r in recordings])


def symbolic(problem: Problem) -> Answer:
    """Genetic programming on what the base leaves; an expression is named by the column that it resembles."""
    from gplearn.genetic import SymbolicRegressor

    base = fitted(problem.train, problem.case.base)
    rest, _ = left_over(problem.train, base)
    x, scale = _features(problem.train, None)
    step = max(1, len(rest) // _LARGEST)
    size = float(np.std(rest))
    model = SymbolicRegressor(
        population_size=500, generations=12, function_set=("add", "sub", "mul", "div", "abs", "sin"),
        parsimony_coefficient=0.003, random_state=1,
    )  # fmt: skip
    model.fit(x[::step], rest[::step] / size)
    shown = size * model.predict(x)
    test = base.force([problem.test]) + size * model.predict(_features([problem.test], scale)[0])
    n = len(rest)
    if n * np.log(np.mean((rest - shown) ** 2) / np.mean(rest**2)) + np.log(n) * 5 > 0:
        return Answer(set(), said(set()), test)
    ready = prepare(problem)
    wave = shown - np.mean(shown)
    near = np.abs(ready.columns.T @ wave) / (
        np.linalg.norm(ready.columns, axis=0) * np.linalg.norm(wave) + 1e-30
    )
    named = {ready.names[int(np.argmax(near))]}
    return Answer(named, said(named), test)


def _features(recordings: list[Recording], scale: Array | None) -> tuple[Array, Array]:
    parts = []
    for r in recordings:
        v = np.asarray(r.velocity)
        parts.append(np.column_stack([r.displacement, v, np.gradient(v, r.time)]))
    x = np.concatenate(parts)
    scale = np.std(x, axis=0) if scale is None else scale
    return x / scale, scale
