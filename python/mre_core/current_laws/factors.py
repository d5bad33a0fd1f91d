"""Recordings of one level of the current as a small triangular factor, read once and not kept.

For the sinh model the columns are v, 1 and odd Chebyshev polynomials of x, through which sinh(beta x)
is exact to rounding for beta times the largest displacement up to `LARGEST`. What is added later may move
farther: the factor is then taken over to the wider interval, on which polynomials stay polynomials.
"""

from collections.abc import Callable
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .._core import Recording, simulate
from .structure import Structure

Array = NDArray[np.float64]

TERMS = 24
"""Odd polynomials: of degree 1 to 47."""
LARGEST = 25.0
_ROWS = 20_000
"""Samples that are worked in together: bounds the memory to `_ROWS` times `TERMS` numbers."""


def triangle(rows: Array) -> Array:
    """Turn rows to as few as there are columns, at most; lengths and products of columns stay."""
    return np.asarray(np.linalg.qr(rows, mode="r"), dtype=np.float64)


class SinhFactor:
    """Samples of a sinh or Kelvin-Voigt model at one current, for any coefficients and any beta."""

    def __init__(self, structure: Structure) -> None:
        self._structure = structure
        self._farthest = 0.0
        self._factor = np.zeros((0, TERMS + 3))

    def add(self, recording: Recording, weight: float) -> None:
        """Work in the samples of a recording that are scored, each with the square root of its weight."""
        from numpy.polynomial import chebyshev

        x, v, force = _scored(recording)
        farthest = float(np.abs(x).max())
        if farthest > self._farthest:
            if self._farthest > 0:
                self._factor = self._factor @ _widened(self._farthest / farthest)
            self._farthest = farthest
        for first in range(0, len(x), _ROWS):
            part = slice(first, first + _ROWS)
            rows = np.empty((len(x[part]), TERMS + 3))
            rows[:, 0], rows[:, 1], rows[:, -1] = v[part], 1.0, force[part]
            rows[:, 2:-1] = chebyshev.chebvander(x[part] / self._farthest, 2 * TERMS - 1)[:, 1::2]
            rows *= np.sqrt(weight)
            self._factor = triangle(np.vstack([self._factor, rows]))

    def columns(self, shapes: tuple[float, ...]) -> tuple[Array, Array]:
        """Columns of the coefficients and the force, all turned alike: (k, m) and (k,)."""
        factor, far = self._factor, self._farthest
        by_name = {"c0": factor[:, 0], "F0": factor[:, 1], "k0": factor[:, 2] * far}
        if shapes:
            by_name["alpha"] = factor[:, 2:-1] @ _sinh_series(shapes[0] * far)
        return np.stack([by_name[name] for name in self._structure.coefficients], axis=1), factor[:, -1]


class DirectFactor:
    """Recordings of any model at one current, kept in memory and simulated for every new shape."""

    def __init__(self, structure: Structure) -> None:
        self._structure = structure
        self._samples: list[Samples] = []
        self._known: dict[tuple[float, ...], tuple[Array, Array]] = {}

    def add(self, recording: Recording, weight: float) -> None:
        """Keep a recording."""
        self._samples.append(Samples(self._structure, recording, weight))
        self._known.clear()

    @property
    def recordings(self) -> list[Recording]:
        """What was added."""
        return [samples.recording for samples in self._samples]

    def columns(self, shapes: tuple[float, ...]) -> tuple[Array, Array]:
        """Columns of the coefficients and the force, all turned alike: (k, m) and (k,)."""
        if shapes not in self._known:
            factor = np.zeros((0, len(self._structure.coefficients) + 1))
            for samples in self._samples:
                factor = triangle(np.vstack([factor, samples.at(shapes)]))
            if len(self._known) > 1000:
                self._known.clear()
            self._known[shapes] = (factor[:, :-1], factor[:, -1])
        return self._known[shapes]


class Samples:
    """Columns of one recording in memory, of which those that do not follow the shapes are made once."""

    def __init__(self, structure: Structure, recording: Recording, weight: float) -> None:
        self._structure = structure
        self.recording = recording
        self._root = np.sqrt(weight)
        _, _, force = _scored(recording)
        first = tuple(1.0 for _ in structure.shapes)
        columns = [self._column(name, first) for name in structure.coefficients]
        self._columns = self._root * np.stack([*columns, force], axis=1)

    def at(self, shapes: tuple[float, ...]) -> Array:
        """Columns of the coefficients, then the force, at the samples that are scored."""
        found: Array = self._columns.copy()
        if self._structure.shaped is not None:
            place = self._structure.coefficients.index(self._structure.shaped)
            found[:, place] = self._root * self._column(self._structure.shaped, shapes)
        return found

    def _column(self, name: str, shapes: tuple[float, ...]) -> Array:
        given = dict(zip(self._structure.shapes, shapes, strict=True))
        one = [given.get(other, float(other == name)) for other in self._structure.names]
        force: Array = simulate(self._structure.model, [(None, one)], self.recording)
        return force[slice(*self.recording.scored)]


def _scored(recording: Recording) -> tuple[Array, Array, Array]:
    part = slice(*recording.scored)
    force = recording.force
    assert force is not None  # seen to before
    return recording.displacement[part], recording.velocity[part], force[part]


@lru_cache(maxsize=4096)
def _sinh_series(largest: float) -> Array:
    """Coefficients of sinh(largest u) in the odd Chebyshev polynomials of u."""
    # By interpolation in more points than terms, which leaves nothing above rounding.
    return _interpolated(lambda u: np.sinh(largest * u), 2 * TERMS + 15)[1 : 2 * TERMS : 2]


def _widened(ratio: float) -> Array:
    """From columns in x / a to columns in x / b, with a / b the ratio, at most 1."""
    from numpy.polynomial import chebyshev

    change = np.eye(TERMS + 3)
    for j in range(TERMS):
        degree = 2 * j + 1
        series = np.zeros(degree + 1)
        series[degree] = 1.0

        def wider(u: Array, series: Array = series) -> Array:
            return np.asarray(chebyshev.chebval(ratio * u, series), dtype=np.float64)

        change[2 : 2 + j + 1, 2 + j] = _interpolated(wider, degree)[1::2]
    return change


def _interpolated(function: Callable[[Array], Array], degree: int) -> Array:
    """Chebyshev series of a function on -1 to 1."""
    from numpy.polynomial import chebyshev

    series: Any = chebyshev.chebinterpolate(function, degree)
    return np.asarray(series, dtype=np.float64)
