"""Noise of a force channel, each kind of unit root mean square."""

from collections.abc import Callable

import numpy as np
from scipy.signal import lfilter  # type: ignore[import-untyped]

from .kinematics import TURN, Array

Kind = Callable[[np.random.Generator, int, float], Array]
"""Generator, samples, rate (Hz)."""


def _white(rng: np.random.Generator, n: int, rate: float) -> Array:
    return rng.normal(size=n)


def _student(rng: np.random.Generator, n: int, rate: float) -> Array:
    out: Array = rng.standard_t(3, size=n) / np.sqrt(3)
    return out


def _correlated(pole: float) -> Kind:
    def make(rng: np.random.Generator, n: int, rate: float) -> Array:
        """The given correlation of neighbours holds at 200 Hz."""
        here = pole ** (200.0 / rate)
        settle = int(12 / (1 - here))
        y: Array = lfilter([np.sqrt(1 - here**2)], [1.0, -here], rng.normal(size=n + settle))
        return y[settle:]

    return make


def _pink(rng: np.random.Generator, n: int, rate: float) -> Array:
    """Power falls as 1/f, cut from a longer record."""
    size = 4 * n
    spectrum = np.fft.rfft(rng.normal(size=size))
    gain = 1 / np.sqrt(np.maximum(np.arange(len(spectrum)), 1.0))
    gain[0] = 0
    wave = np.fft.irfft(spectrum * gain, size)
    out: Array = wave[n : 2 * n] / np.std(wave)
    return out


def _narrow(rng: np.random.Generator, n: int, rate: float) -> Array:
    """White noise with a line about a hertz wide between 8 and 20 Hz."""
    radius, angle = np.exp(-np.pi / rate), TURN * rng.uniform(8, 20) / rate
    settle = int(5 * rate)
    line = lfilter([1.0], [1.0, -2 * radius * np.cos(angle), radius**2], rng.normal(size=n + settle))[settle:]
    out: Array = np.sqrt(0.7) * line / np.std(line) + np.sqrt(0.3) * rng.normal(size=n)
    return out


def _mains(rng: np.random.Generator, n: int, rate: float) -> Array:
    """Half of the power is a 50 Hz line."""
    line = np.sin(TURN * 50.0 * np.arange(n) / rate + rng.uniform(0, TURN))
    out: Array = line + np.sqrt(0.5) * rng.normal(size=n)
    return out


KINDS: dict[str, Kind] = {
    "white": _white,
    "ar60": _correlated(0.6),
    "ar97": _correlated(0.97),
    "ar995": _correlated(0.995),
    "pink": _pink,
    "narrow": _narrow,
    "mains": _mains,
    "student": _student,
}


def noisy(kind: str, force: Array, size: float, rate: float, rng: np.random.Generator) -> Array:
    """The force with noise of `size` (N, root mean square); `quantised` rounds to steps of three sizes."""
    if kind == "none":
        return force.copy()
    if kind == "quantised":
        out: Array = 3 * size * np.round((force + 0.5 * size * rng.normal(size=len(force))) / (3 * size))
        return out
    if kind not in KINDS:
        raise ValueError(f"noise is {kind!r}, wanted one of none, quantised, {', '.join(KINDS)}")
    return force + size * KINDS[kind](rng, len(force), rate)
