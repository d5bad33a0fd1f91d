"""Rate-independent laws solved exactly from one turning point of the displacement to the next."""

from bisect import bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.interpolate import CubicHermiteSpline  # type: ignore[import-untyped]

from .kinematics import Array


def turning_point(x0: float, v0: float, x1: float, v1: float, h: float) -> float:
    """Extreme of the cubic through two samples with their slopes."""
    d, m0, m1 = x1 - x0, v0 * h, v1 * h
    a, b, c = 3 * (m0 + m1 - 2 * d), 2 * (3 * d - 2 * m0 - m1), m0
    root = np.sqrt(max(b * b - 4 * a * c, 0.0))
    q = -(b + np.copysign(root, b)) / 2
    roots = [r for r in (q / a if a else np.nan, c / q if q else np.nan) if -1e-9 <= r <= 1 + 1e-9]
    s = min(roots, key=lambda r: abs(r - 0.5)) if roots else m0 / (m0 - m1)
    return float(x0 + s * (c + s * (b / 2 + s * a / 3)))


@dataclass(frozen=True)
class Stretch:
    """Samples `first` to `last` (exclusive) moved in one direction (+1, -1) from `start` to `end`."""

    first: int
    last: int
    direction: float
    start: float
    end: float


def _stretches(x: Array, v: Array, h: float) -> Iterator[Stretch]:
    sign = np.sign(v)
    moving = np.flatnonzero(sign)
    if len(moving) == 0:
        yield Stretch(0, len(x), 1.0, float(x[0]), float(x[-1]))
        return
    held = np.maximum.accumulate(np.where(sign != 0, np.arange(len(x)), -1))
    sign = np.where(held >= 0, sign[np.maximum(held, 0)], sign[moving[0]])
    last = np.flatnonzero(sign[1:] != sign[:-1])
    first, start = 0, float(x[0])
    for i in last:
        end = turning_point(x[i], v[i], x[i + 1], v[i + 1], h)
        yield Stretch(first, int(i) + 1, float(sign[first]), start, end)
        first, start = int(i) + 1, end
    yield Stretch(first, len(x), float(sign[first]), start, float(x[-1]))


@dataclass(frozen=True)
class Path:
    """Positions and velocities at equal steps h (s), cut at the turning points."""

    x: Array
    v: Array
    h: float

    @cached_property
    def stretches(self) -> list[Stretch]:
        """Parts of one direction; samples at rest belong to the part before."""
        return list(_stretches(self.x, self.v, self.h))

    def spread(self, values: Sequence[float]) -> Array:
        """One value for each stretch, at every sample."""
        return np.repeat(np.array(values), [part.last - part.first for part in self.stretches])

    @cached_property
    def direction(self) -> Array:
        return self.spread([part.direction for part in self.stretches])

    @cached_property
    def lengths(self) -> list[float]:
        """Of each stretch, up to its turning point."""
        return [abs(part.end - part.start) for part in self.stretches]

    @cached_property
    def since(self) -> Array:
        """Distance from the last turning point."""
        return np.abs(self.x - self.spread([part.start for part in self.stretches]))

    @cached_property
    def travelled(self) -> Array:
        """Length of the whole path so far."""
        before = np.concatenate([[0.0], np.cumsum(self.lengths)[:-1]])
        return self.spread(before.tolist()) + self.since


class Flow:
    """Solution of du/ds = g(u), u(0) = 0, on -1 <= u < 1, by quadrature of ds = du / g."""

    def __init__(self, nodes: Array, slope: Array, cells: Array) -> None:
        """`slope` holds g at the nodes, `cells` the integral of du / g over each interval."""
        s = np.concatenate([[0.0], np.cumsum(cells)])
        s -= s[np.searchsorted(nodes, 0.0)]
        self.u: list[float]
        self.u, self.s, self.g, self.pace = nodes.tolist(), s.tolist(), slope.tolist(), (1 / slope).tolist()
        self.spline = CubicHermiteSpline(s, nodes, slope)
        self.top = float(s[-1])

    def at(self, s: Array) -> Array:
        u: Array = self.spline(np.minimum(s, self.top))
        return u

    def one(self, s: float) -> float:
        """The same at one place."""
        if s >= self.top:
            return self.u[-1]
        return _hermite(self.s, self.u, self.g, s)

    def inverse(self, u: float) -> float:
        """The s at which the solution passes u."""
        return _hermite(self.u, self.s, self.pace, u)


def _hermite(x: list[float], y: list[float], slope: list[float], at: float) -> float:
    i = min(max(bisect_right(x, at) - 1, 0), len(x) - 2)
    width = x[i + 1] - x[i]
    r = (at - x[i]) / width
    d, m0, m1 = y[i + 1] - y[i], slope[i] * width, slope[i + 1] * width
    return y[i] + r * (m0 + r * (3 * d - 2 * m0 - m1 + r * (m0 + m1 - 2 * d)))


def followed(flow: Flow, path: Path, rho: float) -> Array:
    """State w = u sgn(v) of dw/dx = rho g(w sgn v) that starts at rest."""
    begins = [0.0]
    for length in path.lengths[:-1]:
        begins.append(flow.inverse(-flow.one(begins[-1] + rho * length)))
    return path.direction * flow.at(path.spread(begins) + rho * path.since)


def played(path: Path, radius: Array) -> Array:
    """Play operators of the given radii, shape (samples, radii), that were brought to the start from zero."""
    out = np.empty((len(path.x), len(radius)))
    p = np.clip(0.0, path.x[0] - radius, path.x[0] + radius)
    for part in path.stretches:
        here, r = slice(part.first, part.last), -part.direction * radius
        limit = np.maximum if part.direction > 0 else np.minimum
        out[here] = limit(p, path.x[here, None] + r)
        p = limit(p, part.end + r)
    return out
