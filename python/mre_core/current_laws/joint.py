"""The joint fit for given laws: values of the coefficients solved exactly, shapes searched."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .._core import Problem
from ..fits import hybrid
from .campaign import Campaign
from .factors import DirectFactor, triangle
from .law import Dependence, Law
from .parts import Steady

Array = NDArray[np.float64]
_GRID = 25
_STEP = 1e-7
"""Of the differences in the last descent, as a share of the box."""
_EVALUATIONS = 150
"""Most evaluations of the last descent, for every variable."""


@dataclass(frozen=True)
class Joint:
    """A campaign fitted under laws."""

    parameters: Mapping[str, Dependence]
    """By name, in the order of the equation."""
    squares: float
    """Weighted sum of the squared error."""

    def at(self, current: float) -> dict[str, float]:
        """Parameters at one current in A."""
        return {name: float(p.at(current)[0]) for name, p in self.parameters.items()}


def solve(campaign: Campaign, laws: Mapping[str, Law], shapes: Mapping[str, Dependence]) -> Joint:
    """Find the best coefficients in their limits for given laws and shapes."""
    from scipy.optimize import lsq_linear  # type: ignore[import-untyped]

    structure = campaign.structure
    named = {name: laws[name] for name in structure.coefficients}
    rows, right = campaign.rows(list(named.values()), [shapes[name] for name in structure.shapes])
    # Turned to as few rows as there are columns, all of like length.
    factor = triangle(np.column_stack([rows, right]))
    rows, right = factor[:, :-1], factor[:, -1]
    scale = np.linalg.norm(rows, axis=0)
    scale[scale == 0] = 1.0
    limits = np.array([campaign.limits[name] for name, law in named.items() for _ in law.nodes])
    low, high = limits[:, 0] * scale, limits[:, 1] * scale
    held = low == high  # the solver wants an interval
    high[held] += 1e-12 * np.maximum(1.0, np.abs(high[held]))
    found: Any = lsq_linear(rows / scale, right, bounds=(low, high), method="bvls", tol=1e-14)
    values = iter((found.x / scale).tolist())
    by_name = {
        name: Dependence(law, tuple(next(values) for _ in law.nodes)) for name, law in named.items()
    } | dict(shapes)
    return Joint({name: by_name[name] for name in structure.names}, 2 * float(found.cost))


def fit(
    campaign: Campaign,
    laws: Mapping[str, Law],
    start: Joint | None = None,
    held: Mapping[str, Dependence] | None = None,
    precision: float = 1e-13,
) -> Joint:
    """Search shapes and saturation currents, with the coefficients solved for each.

    A saturating law without saturation current is given one. Shapes are searched near those of `start`,
    or over the whole box without one; those in `held` are kept, and so are those whose bounds are equal.
    The last descent ends with a step that lowers the squares by less than the share `precision`.
    """
    from scipy.optimize import minimize

    variables = _Variables(campaign, laws, held or {})
    if not len(variables.low):
        return solve(campaign, laws, held or {})
    width = variables.high - variables.low
    free = width > 0
    if not free.any():
        return variables.joint(variables.low)
    best = variables.first(campaign, start)

    def joint(share: Array) -> Joint:
        point = variables.low.copy()
        point[free] += share * width[free]
        return variables.joint(point)

    found: Any = minimize(
        lambda share: joint(share).squares,
        (best - variables.low)[free] / width[free],
        method="L-BFGS-B",
        bounds=[(0, 1)] * int(free.sum()),
        options={"eps": _STEP, "ftol": precision, "gtol": 0.0, "maxfun": _EVALUATIONS * int(free.sum())},
    )
    last = joint(found.x)
    return min((last, variables.joint(best)), key=lambda joint: joint.squares)


class _Variables:
    """What is searched: the values of the shapes' laws on their scales, and logarithms of saturations."""

    def __init__(self, campaign: Campaign, laws: Mapping[str, Law], held: Mapping[str, Dependence]) -> None:
        self._campaign = campaign
        self._laws = laws
        self._held = held
        self._shapes = [name for name in campaign.structure.shapes if name not in held]
        self._bending = [name for name, law in laws.items() if law.kind == "saturating"]
        boxes = [campaign.shape_boxes[name].ends for name in self._shapes for _ in laws[name].nodes]
        width = campaign.levels[-1] - campaign.levels[0]
        boxes += [(np.log(0.05 * width), np.log(5 * width)) for _ in self._bending]
        self.low, self.high = np.array(boxes).reshape(-1, 2).T

    def joint(self, point: Array) -> Joint:
        """Solve at a point."""
        inside = iter(np.clip(point, self.low, self.high).tolist())
        places = {name: [next(inside) for _ in self._laws[name].nodes] for name in self._shapes}
        bent = {
            name: Law("saturating", self._laws[name].nodes, float(np.exp(next(inside))))
            for name in self._bending
        }
        laws = {**self._laws, **bent}
        shapes = dict(self._held)
        for name, along in places.items():
            box = self._campaign.shape_boxes[name]
            shapes[name] = Dependence(laws[name], tuple(box.value(place) for place in along))
        return solve(self._campaign, laws, shapes)

    def first(self, campaign: Campaign, start: Joint | None) -> Array:
        """Take what is known, or the best of a grid where the only shape is the same at all currents."""
        middle = 0.5 * (self.low + self.high)
        if start is None and len(self._shapes) == 1:
            return self._best_of_grid(middle, len(self._laws[self._shapes[0]].nodes))
        for i, name in enumerate(self._bending, start=len(middle) - len(self._bending)):
            known = None if start is None else start.parameters[name].law.saturation
            middle[i] = middle[i] if known is None else np.log(known)
        shapes = _alone(campaign) if start is None else start.at
        places = [
            campaign.shape_boxes[name].place(shapes(node)[name])
            for name in self._shapes
            for node in self._laws[name].nodes
        ]
        point: Array = np.clip([*places, *middle[len(places) :]], self.low, self.high)
        return point

    def _best_of_grid(self, middle: Array, count: int) -> Array:
        grid = []
        for share in np.linspace(0, 1, _GRID):
            point = middle.copy()
            point[:count] = (self.low + share * (self.high - self.low))[:count]
            grid.append(point)
        costs = [self.joint(point).squares for point in grid]
        return grid[int(np.argmin(costs))]


def _alone(campaign: Campaign) -> Callable[[float], Mapping[str, float]]:
    """Fit every level alone, and give the medians of their shapes for any current."""
    found = {}
    for part in campaign.parts:
        if isinstance(part, Steady) and isinstance(part.factor, DirectFactor):
            box = {name: (b.low, b.high) for name, b in campaign.shape_boxes.items()}
            problem = Problem(part.factor.recordings, campaign.structure.model, box)
            found[part.currents[0]] = hybrid(problem, seed=1, max_iterations=3).values
    if not found:
        middle = {name: b.value(sum(b.ends) / 2) for name, b in campaign.shape_boxes.items()}
        return lambda _: middle
    typical = {name: float(np.median([v[name] for v in found.values()])) for name in campaign.shape_boxes}
    return lambda _: typical
