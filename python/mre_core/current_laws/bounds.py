"""Which values of laws lie on a bound of where they were searched."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from .campaign import Campaign
from .law import Dependence
from .tangents import Value, values_of

_NEAR = 1e-6


class Bound(NamedTuple):
    """An end of the box that a value was searched in."""

    side: str
    """Lower or upper."""
    physical: bool
    """Whether nothing beyond it is physically admissible."""


def box_of(campaign: Campaign, value: Value) -> tuple[float, float]:
    """Where a value was searched; a saturation is bounded by none that means anything."""
    if value.parameter in campaign.limits:
        return campaign.limits[value.parameter]
    if value.parameter in campaign.shape_boxes:
        box = campaign.shape_boxes[value.parameter]
        return box.low, box.high
    return 0.0, np.inf


def physical_of(campaign: Campaign, parameter: str) -> tuple[float, float]:
    """Give what is physically admissible for a parameter."""
    if parameter in campaign.shape_boxes:
        return campaign.shape_boxes[parameter].limits
    return campaign.structure.limits(np.inf).get(parameter, (-np.inf, np.inf))


def is_fixed(campaign: Campaign, value: Value) -> bool:
    """Tell whether somebody wants this value and no other."""
    low, high = box_of(campaign, value)
    return low == high


def bound_of(campaign: Campaign, value: Value) -> Bound | None:
    """On which bound a value lies, if on one that says something: it was searched, and there is one."""
    if is_fixed(campaign, value) or value.parameter.startswith("saturation of "):
        return None
    ends = zip(box_of(campaign, value), physical_of(campaign, value.parameter), strict=True)
    for side, (end, limit) in zip(("lower", "upper"), ends, strict=True):
        if abs(value.value - end) <= _NEAR * max(abs(value.value), 1e-300):
            return Bound(side, end == limit)
    return None


def notes_of(campaign: Campaign, laws: Mapping[str, Dependence], over: str) -> tuple[str, ...]:
    """Say of every value in the order of `values_of` whether a bound holds it, in the words of `identify`."""
    units = dict(zip(campaign.structure.names, campaign.structure.units, strict=True))
    return tuple(_note(bound_of(campaign, value)) for value in values_of(laws, units, over))


def _note(bound: Bound | None) -> str:
    if bound is None:
        return ""
    return "at its physical limit" if bound.physical else f"on its {bound.side} bound: widen it"


def words_of(rows: Sequence[Mapping[str, object]], unit: str) -> list[str]:
    """One sentence a parameter that a bound holds although physics would not."""
    found: dict[tuple[object, object], list[str]] = {}
    for row in rows:
        if "widen" in str(row["note"]):
            at = [] if row["at"] is None else [f"{row['at']:g} {unit}"]
            found.setdefault((row["parameter"], row["note"]), []).extend(at)
    return [
        f"{name}{' at ' + ', '.join(places) if places else ''} is {note}"
        for (name, note), places in found.items()
    ]
