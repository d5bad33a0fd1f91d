"""Linear memory on the fine grid: lags, oscillators and convolution quadrature."""

from collections.abc import Callable
from functools import lru_cache

import numpy as np
from scipy.linalg import expm  # type: ignore[import-untyped]
from scipy.signal import fftconvolve, lfilter, ss2tf  # type: ignore[import-untyped]

from .kinematics import Array


def _unsmeared(u: Array) -> Array:
    """Input for a first-order hold with its interpolation error removed up to the fourth order."""
    bend = np.zeros_like(u)
    bend[1:-1] = u[2:] - 2 * u[1:-1] + u[:-2]
    return u - bend / 12


def lag(u: Array, h: float, tau: float, start: float = 0.0) -> Array:
    """The solution of y' = u - y / tau with y = start at the first sample."""
    r = h / tau
    decay = np.exp(-r)
    mean = -np.expm1(-r) / r
    new, old = tau * (1 - mean), tau * (mean - decay)
    u = _unsmeared(u)
    y: Array
    y, _ = lfilter([new, old], [1.0, -decay], u, zi=[start - new * u[0]])
    return y


def second_order(u: Array, h: float, frequency: float, damping: float) -> Array:
    """The solution of y'' / w^2 + 2 d y' / w + y = u at rest at the first u, w = 2 pi frequency."""
    w = 2 * np.pi * frequency
    a = np.array([[0.0, 1.0], [-(w**2), -2 * damping * w]])
    block = np.zeros((4, 4))
    block[:2, :2], block[:2, 2], block[2, 3] = a * h, np.array([0.0, w**2]) * h, 1.0
    hold = expm(block)
    phi, ahead = hold[:2, :2], hold[:2, 3]
    now = hold[:2, 2] - ahead
    numerator, denominator = ss2tf(phi, (now + phi @ ahead)[:, None], [[1.0, 0.0]], [[ahead[0]]])
    y: Array = lfilter(numerator[0], denominator, _unsmeared(u - u[0])) + u[0]
    return y


def convolved(u: Array, h: float, transfer: Callable[[Array], Array]) -> Array:
    """Response of an operator with the Laplace transform `transfer` to u, at rest before the first sample."""
    weights = quadrature(len(u), h, transfer)
    y: Array = fftconvolve(u, weights)[: len(u)]
    return y


@lru_cache(maxsize=8)
def quadrature(n: int, h: float, transfer: Callable[[Array], Array]) -> Array:
    """Lubich's convolution quadrature on the third-order backward difference formula."""
    size = 2 ** int(np.ceil(np.log2(2 * n)))
    radius = 1e-14 ** (1 / (2 * size))
    circle = radius * np.exp(-2j * np.pi * np.arange(size) / size)
    step = 1 - circle
    symbol = transfer((step + step**2 / 2 + step**3 / 3) / h)
    weights: Array = np.real(np.fft.ifft(symbol))[:n] * radius ** -np.arange(n)
    return weights
