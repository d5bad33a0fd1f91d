"""The parts of a campaign: levels of the current, and recordings whose current changes."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from .factors import DirectFactor, Samples, SinhFactor, triangle
from .law import Dependence, Law
from .structure import Structure

Array = NDArray[np.float64]
_FIFTHS = 5
_STAY = 0.01
"""Share of the samples that more than passes through."""


class Part(Protocol):
    """Samples that enter a joint fit."""

    @property
    def currents(self) -> tuple[float, ...]:
        """Lowest and highest current in A."""
        ...

    @property
    def label(self) -> float | str:
        """The level, or the name of a recording."""
        ...

    def rows(self, laws: Sequence[Law], shapes: Sequence[Dependence]) -> tuple[Array, Array]:
        """Columns of all values of the coefficients' laws, and the force: (k, p) and (k,)."""
        ...


@dataclass(eq=False)
class Steady:
    """All recordings at one level."""

    members: list[float]
    """The level of each."""
    factor: SinhFactor | DirectFactor

    @property
    def currents(self) -> tuple[float, ...]:
        """The level."""
        return (self.label,)

    @property
    def label(self) -> float:
        """The level."""
        return float(np.mean(self.members))

    def rows(self, laws: Sequence[Law], shapes: Sequence[Dependence]) -> tuple[Array, Array]:
        """Columns at the level, each times the weights of its law."""
        (current,) = self.currents
        columns, right = self.factor.columns(tuple(float(shape.at(current)[0]) for shape in shapes))
        return np.hstack([columns[:, [j]] * _weights(law, current) for j, law in enumerate(laws)]), right


@lru_cache(maxsize=4096)
def _weights(law: Law, current: float) -> Array:
    """Keep the weights at levels: laws without a searched saturation ask for the same again and again."""
    return law.weights(current)


@dataclass(eq=False)
class Changing:
    """A recording whose current changes; kept in memory."""

    structure: Structure
    samples: Samples
    series: Array
    """What the laws run over, one value a sample."""
    label: str
    """Name of the recording, or what tells it from others of that name."""

    @property
    def currents(self) -> tuple[float, ...]:
        """Lowest and highest."""
        return (float(self.series.min()), float(self.series.max()))

    @property
    def visited(self) -> int:
        """In how many fifths of its span the current stays: five of a sweep, two of a switch."""
        counts, _ = np.histogram(self.series, bins=_FIFTHS)
        return int(np.sum(counts >= _STAY * len(self.series)))

    def rows(self, laws: Sequence[Law], shapes: Sequence[Dependence]) -> tuple[Array, Array]:
        """Columns sample by sample, turned to as many rows as columns."""
        for name, shape in zip(self.structure.shapes, shapes, strict=True):
            if shape.law.kind != "constant":
                problem = f"{name} follows what changes within '{self.samples.recording.name}'"
                raise InputError(problem, wanted=f"{name} constant")
        values = tuple(shape.values[0] for shape in shapes)
        samples = self.samples.at(values)
        current = self.series[slice(*self.samples.recording.scored)]
        weighted = [samples[:, [j]] * law.weights(current) for j, law in enumerate(laws)]
        factor = triangle(np.hstack([*weighted, samples[:, -1:]]))
        return factor[:, :-1], factor[:, -1]
