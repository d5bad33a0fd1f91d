"""The covariance of a fit by dense matrices: slow, and by the book."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import block_diag, solve_toeplitz, toeplitz  # type: ignore[import-untyped]

Array = NDArray[np.float64]
FLOOR = 1 + 1e-6


def tangents(model: str, x: Array, v: Array, parameters: Sequence[float] | Array) -> Array:
    """Derivative of the force by the parameters, shape (n, d)."""
    one = np.ones_like(x)
    if model == "kelvin_voigt":
        return np.column_stack([v, x, one])
    _, _, alpha, beta, _ = parameters
    return np.column_stack([v, x, np.sinh(beta * x), alpha * x * np.cosh(beta * x), one])


def products(e: Array, last: int) -> Array:
    return np.array([e[: len(e) - lag] @ e[lag:] for lag in range(last + 1)])


def yule_walker(gamma: Array) -> tuple[Array, float]:
    """Coefficients and innovation variance of the autoregression with these autocovariances."""
    if len(gamma) == 1:
        return np.zeros(0), float(gamma[0])
    phi = solve_toeplitz(gamma[:-1], gamma[1:])
    return phi, float(gamma[0] - phi @ gamma[1:])


def order_of(e: Array, most: int) -> int:
    gamma = products(e, most) / len(e)
    gamma[0] *= FLOOR
    n = len(e)
    bic = [n * np.log(yule_walker(gamma[: p + 1])[1]) + p * np.log(n) for p in range(most + 1)]
    return int(np.argmin(bic))


def matrix(gamma: Array, n: int) -> Array:
    """Covariance matrix of n samples of the autoregression."""
    phi, _ = yule_walker(gamma)
    row = list(gamma)
    while len(row) < n:
        row.append(float(phi @ np.array(row[::-1][: len(phi)])) if len(phi) else 0.0)
    return np.asarray(toeplitz(row[:n]))


def covariance(
    jacobians: Sequence[Array], residuals: Sequence[Array], weights: Sequence[float], rate: float
) -> Array:
    """Sandwich covariance of weighted least squares; the noise of each recording is an autoregression."""
    jacobian = np.vstack(jacobians)
    sizes = [len(e) for e in residuals]
    weight = np.repeat(weights, sizes)
    pull = np.linalg.solve(jacobian.T @ (weight[:, None] * jacobian), (weight[:, None] * jacobian).T)
    left = np.eye(len(weight)) - jacobian @ pull
    orders = [order_of(e, min(int(0.3 * rate), len(e) // 10)) for e in residuals]
    found = [products(e, p) for e, p in zip(residuals, orders, strict=True)]
    gammas = [c / n * np.r_[FLOOR, np.ones(len(c) - 1)] for c, n in zip(found, sizes, strict=True)]
    starts = np.cumsum([0, *sizes])
    for _ in range(30):
        noise = block_diag(*[matrix(g, n) for g, n in zip(gammas, sizes, strict=True)])
        remains = left @ noise @ left.T
        for r, (first, last) in enumerate(pairwise(starts)):
            block = remains[first:last, first:last]
            lags = np.arange(orders[r] + 1)
            expected = np.array([np.trace(block, lag) for lag in lags])
            m = sizes[r] - lags
            gammas[r] = (found[r] + m * gammas[r] - expected) / m
            gammas[r][0] *= FLOOR
    noise = block_diag(*[matrix(g, n) for g, n in zip(gammas, sizes, strict=True)])
    return np.asarray(pull @ noise @ pull.T)
