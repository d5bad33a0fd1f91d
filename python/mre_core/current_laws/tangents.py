"""The force's derivatives by the values of laws."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .._core import Recording
from .campaign import Campaign
from .factors import Samples
from .joint import Joint
from .law import Dependence, Law
from .variable import UNITS, series_of

Array = NDArray[np.float64]
_STEP = 1e-4
"""Of central differences, as a share of the value."""


@dataclass(frozen=True)
class Value:
    """A value of a law, or the saturation of a saturating one."""

    parameter: str
    law: str
    at: float | None
    """Where the law has this value, in A or what else it runs over; None for a constant and a saturation."""
    value: float
    unit: str


def values_of(laws: Mapping[str, Dependence], units: Mapping[str, str], over: str) -> tuple[Value, ...]:
    """List the values of all laws, parameter by parameter, a saturation behind the values of its law."""
    found = []
    for name, p in laws.items():
        single = len(p.values) == 1
        found += [
            Value(name, p.law.kind, None if single else node, value, units[name])
            for node, value in zip(p.law.nodes, p.values, strict=True)
        ]
        if p.law.saturation is not None:
            found.append(Value(f"saturation of {name}", p.law.kind, None, p.law.saturation, UNITS[over]))
    return tuple(found)


def slopes(p: Dependence, along: Array) -> Array:
    """Differentiate a parameter by the values of its law, then by its saturation: shape (n, values)."""
    weights = p.law.weights(along)
    if p.law.saturation is None:
        return weights

    def moved(step: float) -> Array:
        assert p.law.saturation is not None
        return Dependence(Law(p.law.kind, p.law.nodes, p.law.saturation * (1 + step)), p.values).at(along)

    bend = (moved(_STEP) - moved(-_STEP)) / (2 * _STEP * p.law.saturation)
    return np.column_stack([weights, bend])


def tangents(campaign: Campaign, joint: Joint, recording: Recording, over: str) -> tuple[Array, Array]:
    """Differentiate the force by all values over the scored samples, (n, p); and the residual, (n,)."""
    structure = campaign.structure
    series = series_of(recording, over)
    along = series if len(series) == 1 else series[slice(*recording.scored)]
    known = {name: p.at(along) for name, p in joint.parameters.items()}
    shapes = {name: float(known[name][0]) for name in structure.shapes}  # constant where the current changes
    samples = Samples(structure, recording, 1.0)
    here = samples.at(tuple(shapes.values()))
    by_parameter: dict[str, Array] = {name: here[:, j] for j, name in enumerate(structure.coefficients)}
    residual = here[:, -1] - sum(known[name] * by_parameter[name] for name in structure.coefficients)
    for name in structure.shapes:
        by_parameter[name] = known[structure.shaped or ""] * _shape_slope(campaign, samples, shapes, name)
    columns = [by_parameter[name][:, None] * slopes(p, along) for name, p in joint.parameters.items()]
    return np.hstack(columns), residual


def _shape_slope(campaign: Campaign, samples: Samples, shapes: Mapping[str, float], name: str) -> Array:
    """Differentiate the shaped column by one shape, on that side of a bound which there is."""
    place = campaign.structure.coefficients.index(campaign.structure.shaped or "")
    box, step = campaign.shape_boxes[name], _STEP * shapes[name]
    low, high = max(shapes[name] - step, box.low), min(shapes[name] + step, box.high)

    def moved(to: float) -> Array:
        return samples.at(tuple({**shapes, name: to}.values()))[:, place]

    return (moved(high) - moved(low)) / (high - low) if low < high else np.zeros_like(moved(low))
