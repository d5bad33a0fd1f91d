"""Rivals that choose among columns: sparse regression (PySINDy), lasso, and BIC without whitening.

Each gets the base model refitted beside the columns and a dictionary of the whole catalogue.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from base import fitted, left_over
from dictionary import Option, options
from methods import Answer, said
from problem import Array, Problem

Choice = Callable[[Array, Array, list[str]], Array]
"""Columns of unit size (samples, k), what is left of unit size, effect of each column: coefficients (k,)."""

_LEAST = 1e-3
"""Coefficient below which a column counts as not chosen: 0.1 % of what the base leaves."""


@dataclass(frozen=True)
class Prepared:
    """Columns and rest with the base projected out, and what predicts the test from coefficients."""

    columns: Array
    rest: Array
    names: list[str]
    groups: list[list[int]]
    predict: Callable[[Array], Array]


def prepare(problem: Problem) -> Prepared:
    """Fit the base, and make the columns of training and test."""
    base = fitted(problem.train, problem.case.base)
    count = len(problem.train) + 1
    middle = count // 2
    places = [i for i in range(count) if i != middle]
    forces, test_forces = base.force(problem.train), base.force([problem.test])
    peak = float(np.max(np.abs(forces)))
    learnt = options(problem.train, forces, places, count, peak)
    shown = options([problem.test], test_forces, [middle], count, peak)
    rest, jacobian = left_over(problem.train, base)
    scale = np.linalg.norm(jacobian, axis=0)
    scale[scale == 0] = 1.0  # a shape whose coefficient the fit put to nothing
    q, r = np.linalg.qr(jacobian / scale)
    stacked, names, groups = _stack(learnt)
    columns = stacked - q @ (q.T @ stacked)
    sizes = np.sqrt(np.mean(columns**2, axis=0))
    alive = sizes > 1e-6 * np.sqrt(np.mean(stacked**2, axis=0)) + 1e-300
    sizes = np.where(alive, sizes, np.inf)
    left = rest - q @ (q.T @ rest)
    size = float(np.sqrt(np.mean(left**2)))
    test_jacobian = base.jacobian([problem.test])
    test_columns = _stack(shown)[0]

    def predict(coefficients: Array) -> Array:
        """Undo the scales, and refit the base beside the columns."""
        own = size * coefficients / sizes
        bent = np.linalg.lstsq(r, q.T @ (rest - stacked @ own), rcond=None)[0] / scale
        out: Array = test_forces + test_jacobian @ bent + test_columns @ own
        return out

    return Prepared(columns / sizes, left / size, names, groups, predict)


def _stack(all_options: list[Option]) -> tuple[Array, list[str], list[list[int]]]:
    names: list[str] = []
    groups = []
    for option in all_options:
        width = option.columns.shape[1]
        groups.append(list(range(len(names), len(names) + width)))
        names += [option.effect] * width
    return np.column_stack([option.columns for option in all_options]), names, groups


def answered(problem: Problem, choose: Choice | None = None) -> Answer:
    """Let a method choose columns; without one, by BIC."""
    ready = prepare(problem)
    coefficients = choose(ready.columns, ready.rest, ready.names) if choose else by_bic(ready)
    names = {name for name, c in zip(ready.names, coefficients, strict=True) if abs(c) > _LEAST}
    return Answer(names, said(names), ready.predict(coefficients))


def by_bic(ready: Prepared) -> Array:
    """Forward selection of effects by BIC, the noise taken as white."""
    n = len(ready.rest)
    chosen: list[int] = []
    best = n * np.log(np.mean(ready.rest**2))
    while True:
        offers = []
        for group in ready.groups:
            if not set(group) & set(chosen):
                trial = chosen + group
                left = ready.rest - ready.columns[:, trial] @ _solved(ready, trial)
                cost = n * np.log(np.mean(left**2)) + len(trial) * np.log(n)
                offers.append((float(cost), group))
        cost, group = min(offers)
        if cost >= best or len(chosen) > 40:
            break
        best, chosen = cost, chosen + group
    out = np.zeros(ready.columns.shape[1])
    if chosen:
        out[chosen] = _solved(ready, chosen)
    return out


def _solved(ready: Prepared, chosen: list[int]) -> Array:
    part = ready.columns[:, chosen]
    out: Array = np.linalg.lstsq(part.T @ part, part.T @ ready.rest, rcond=1e-10)[0]
    return out


def by_lasso(columns: Array, rest: Array, _: list[str]) -> Array:
    """Lasso, its penalty by cross-validation over blocks, the largest within one standard error."""
    from sklearn.linear_model import Lasso, LassoCV
    from sklearn.model_selection import GroupKFold

    blocks = np.arange(len(rest)) * 20 // len(rest)
    folds = list(GroupKFold(5).split(columns, groups=blocks))
    found = LassoCV(cv=folds, fit_intercept=False, alphas=30, max_iter=3000, tol=1e-3).fit(columns, rest)
    errors = found.mse_path_.mean(axis=1)
    spread = found.mse_path_.std(axis=1) / np.sqrt(5)
    at = int(np.argmin(errors))
    within = found.alphas_[errors <= errors[at] + spread[at]]
    model = Lasso(alpha=float(within.max()), fit_intercept=False, max_iter=3000, tol=1e-3)
    out: Array = model.fit(columns, rest).coef_
    return out


def by_sindy(columns: Array, rest: Array, _: list[str], *, ensemble: bool) -> Array:
    """PySINDy's sequentially thresholded least squares; the threshold by the last fifth of the samples."""
    import pysindy

    cut = len(rest) * 4 // 5

    def fit(threshold: float, rows: slice, *, bagged: bool = False) -> Array:
        optimizer = pysindy.STLSQ(threshold=threshold, alpha=1e-3)
        if bagged:
            optimizer = pysindy.EnsembleOptimizer(opt=optimizer, bagging=True, n_models=20)
        optimizer.fit(columns[rows], rest[rows, None])
        coefficients: Array = np.ravel(optimizer.coef_)
        return coefficients

    thresholds = (0.02, 0.05, 0.1, 0.2, 0.4, 0.8)
    errors = [np.mean((rest[cut:] - columns[cut:] @ fit(t, slice(cut))) ** 2) for t in thresholds]
    nothing = float(np.mean(rest[cut:] ** 2))
    if min(errors) >= nothing:
        return np.zeros(columns.shape[1])
    return fit(thresholds[int(np.argmin(errors))], slice(None), bagged=ensemble)
