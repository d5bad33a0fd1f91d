"""Where the shapes of a model are searched, and on which scale."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from .._core import Problem, Recording
from ..errors import InputError
from .factors import LARGEST
from .structure import Structure

_LOGARITHMIC = {"rho", "n"}


@dataclass(frozen=True)
class ShapeBox:
    """An interval, and a scale on which it is even."""

    low: float
    high: float
    logarithmic: bool
    limits: tuple[float, float] = (-np.inf, np.inf)
    """What is physically admissible."""

    @property
    def ends(self) -> tuple[float, float]:
        """The interval on the scale."""
        return self.place(self.low), self.place(self.high)

    def place(self, value: float) -> float:
        """From a value to its place on the scale."""
        return float(np.log(value)) if self.logarithmic else value

    def value(self, place: float) -> float:
        """From a place on the scale to the value."""
        found = float(np.exp(place)) if self.logarithmic else place
        return min(max(found, self.low), self.high)


def shape_boxes(
    structure: Structure,
    farthest: float,
    kept: Sequence[Recording],
    bounds: Mapping[str, tuple[float, float]],
) -> dict[str, ShapeBox]:
    """Boxes of the shapes: the given bounds, else the default ones of `Problem`.

    `kept` are recordings in memory, which a model other than sinh takes its default box from.

    Raises
    ------
    InputError
        A beta for which sinh cannot be told from the samples that were read.
    """
    if structure.model == "sinh":
        low, high = bounds.get("beta", (0.05 / farthest, 3 / farthest))
        if not 0 < low or high > LARGEST / farthest:
            wanted = f"above 0 and at most {LARGEST / farthest:.4g} 1/mm"
            raise InputError(f"bounds of beta are {low:.4g} to {high:.4g}", wanted=wanted)
        return {"beta": ShapeBox(low, high, False)}
    if not structure.shapes:
        return {}
    given = {name: bounds[name] for name in structure.shapes if name in bounds}
    problem = Problem(list(kept), structure.model, given)
    box = dict(zip(problem.names, zip(problem.lower, problem.upper, strict=True), strict=True))
    limits = dict(zip(problem.names, problem.limits, strict=True))
    return {
        name: ShapeBox(float(box[name][0]), float(box[name][1]), name in _LOGARITHMIC, limits[name])
        for name in structure.shapes
    }
