"""The fitness kernels in Numba: loops over samples, one candidate after the other."""

import math
from collections.abc import Callable
from typing import Any

import numba
import numpy as np
from problems import Array, Case, Kernel, stiffness

FAST = {False: "", True: ", fastmath"}


def _sinh(x: Array, v: Array, f: Array, rows: Array) -> Array:
    out = np.empty(len(rows))
    for c in range(len(rows)):
        c0, k0, alpha, beta, f0 = rows[c]
        total = 0.0
        for i in range(len(x)):
            error = f[i] - (c0 * v[i] + k0 * x[i] + alpha * math.sinh(beta * x[i]) + f0)
            total += error * error
        out[c] = total / len(x)
    return out


def _sinh_by_exp(x: Array, v: Array, f: Array, rows: Array) -> Array:
    out = np.empty(len(rows))
    for c in range(len(rows)):
        c0, k0, alpha, beta, f0 = rows[c]
        total = 0.0
        for i in range(len(x)):
            e = math.exp(beta * x[i])
            error = f[i] - (c0 * v[i] + k0 * x[i] + 0.5 * alpha * (e - 1 / e) + f0)
            total += error * error
        out[c] = total / len(x)
    return out


@numba.njit(inline="always")
def _rate(w: float, v: float, rho: float, sigma: float, n: float) -> float:
    share = abs(w) ** n
    turn = abs(v) if w >= 0 else -abs(v)
    return rho * (v - share * (sigma * (turn - v) + v))


@numba.njit(inline="always")
def _step(
    w: float, v0: float, middle: float, v1: float, h: float, rho: float, sigma: float, n: float
) -> float:
    a = _rate(w, v0, rho, sigma, n)
    b = _rate(w + 0.5 * h * a, middle, rho, sigma, n)
    c = _rate(w + 0.5 * h * b, middle, rho, sigma, n)
    d = _rate(w + h * c, v1, rho, sigma, n)
    return w + h / 6 * (a + 2 * (b + c) + d)


def _bouc_wen(
    x: Array,
    v: Array,
    f: Array,
    first: Any,
    velocity: Array,
    step: Array,
    demand: Array,
    rows: Array,
    stiff: Array,
) -> Array:
    out = np.empty(len(rows))
    for c in range(len(rows)):
        c0, kx, kw, rho, sigma, n, f0 = rows[c]
        w = total = 0.0
        for i in range(len(x)):
            error = f[i] - (c0 * v[i] + kx * x[i] + kw * w + f0)
            total += error * error
            for j in range(first[i], first[i + 1]):
                start, dv = velocity[j, 0], velocity[j, 2] - velocity[j, 0]
                count = max(math.ceil(stiff[c] * demand[j]), 1)
                if count == 1:
                    w = _step(w, start, velocity[j, 1], velocity[j, 2], step[j], rho, sigma, n)
                    continue
                bend = 4 * velocity[j, 1] - 2 * (start + velocity[j, 2])
                for s in range(count):
                    begin, half, end = s / count, (s + 0.5) / count, (s + 1) / count
                    at_begin = start + begin * (dv + bend * (1 - begin))
                    at_half = start + half * (dv + bend * (1 - half))
                    at_end = start + end * (dv + bend * (1 - end))
                    w = _step(w, at_begin, at_half, at_end, step[j] / count, rho, sigma, n)
        out[c] = total / len(x)
    return out


def sinh(case: Case) -> dict[str, Kernel]:
    """All forms of the loop over samples, by name."""

    def form(function: Callable[..., Array], fast: bool) -> Kernel:
        kernel = numba.njit(fastmath=fast)(function)
        return lambda rows: kernel(case.x, case.v, case.f, rows)

    functions = {"math.sinh": _sinh, "math.exp": _sinh_by_exp}
    return {name + FAST[fast]: form(f, fast) for name, f in functions.items() for fast in FAST}


def bouc_wen(case: Case) -> dict[str, Kernel]:
    """RK4 of one candidate after the other, by name."""

    def form(fast: bool) -> Kernel:
        kernel = numba.njit(fastmath=fast)(_bouc_wen)
        series = (case.x, case.v, case.f, *case.intervals)
        return lambda rows: kernel(*series, rows, stiffness(rows))

    return {"scalar" + FAST[fast]: form(fast) for fast in FAST}
