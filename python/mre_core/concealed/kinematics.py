"""Motions with their exact derivatives."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
TURN = 2 * np.pi


@dataclass(frozen=True)
class Jet:
    """A function of time with its first and second derivative, so that products need no differences."""

    x: Array
    v: Array
    a: Array

    def __add__(self, other: "Jet") -> "Jet":
        return Jet(self.x + other.x, self.v + other.v, self.a + other.a)

    def __mul__(self, other: "Jet") -> "Jet":
        return Jet(
            self.x * other.x,
            self.v * other.x + self.x * other.v,
            self.a * other.x + 2 * self.v * other.v + self.x * other.a,
        )

    def times(self, factor: float) -> "Jet":
        return Jet(factor * self.x, factor * self.v, factor * self.a)


Motion = Callable[[Array], Jet]
Course = Callable[[Array], Array]


def constant(t: Array, value: float = 1.0) -> Jet:
    zero = np.zeros_like(t)
    return Jet(zero + value, zero, zero)


def sine(t: Array, frequency: float, phase: float = 0.0) -> Jet:
    w = TURN * frequency
    return waved(w * t + phase, np.full_like(t, w), np.zeros_like(t))


def waved(phase: Array, rate: Array, change: Array) -> Jet:
    """The sine of a phase with the phase's first and second derivative."""
    s, c = np.sin(phase), np.cos(phase)
    return Jet(s, rate * c, change * c - rate**2 * s)


def rise(t: Array, start: float, end: float) -> Jet:
    """From 0 to 1 with three continuous derivatives."""
    span = end - start
    s = np.clip((t - start) / span, 0.0, 1.0)
    value = s**4 * (35 - 84 * s + 70 * s**2 - 20 * s**3)
    slope = 140 * s**3 * (1 - s) ** 3
    bend = 420 * s**2 * (1 - s) ** 2 * (1 - 2 * s)
    return Jet(value, slope / span, bend / span**2)
