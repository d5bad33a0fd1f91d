"""Which values of laws lie on a bound of where they were searched."""

from collections.abc import Mapping, Sequence

import numpy as np

from .campaign import Campaign
from .law import Dependence
from .tangents import Value, values_of

_NEAR = 1e-6


def box_of(campaign: Campaign, value: Value) -> tuple[float, float]:
    """Where a value was searched; a saturation is bounded by none that means anything."""
    if value.parameter in campaign.limits:
        return campaign.limits[value.parameter]
    if value.parameter in campaign.shape_boxes:
        box = campaign.shape_boxes[value.parameter]
        return box.low, box.high
    return 0.0, np.inf


def is_at(value: Value, end: float) -> bool:
    """Tell whether a value lies on one end of its box."""
    return abs(value.value - end) <= _NEAR * max(abs(value.value), 1e-300)


def notes_of(campaign: Campaign, laws: Mapping[str, Dependence], over: str) -> tuple[str, ...]:
    """Say of every value in the order of `values_of` whether a bound holds it, in the words of `identify`."""
    units = dict(zip(campaign.structure.names, campaign.structure.units, strict=True))
    return tuple(_note(campaign, value) for value in values_of(laws, units, over))


def _note(campaign: Campaign, value: Value) -> str:
    low, high = box_of(campaign, value)
    if low == high or value.parameter.startswith("saturation of "):
        return ""  # held because somebody wants it, or without a bound
    physical = campaign.structure.limits(np.inf).get(value.parameter, (-np.inf, np.inf))
    if value.parameter in campaign.shape_boxes:
        physical = campaign.shape_boxes[value.parameter].limits
    for side, end, limit in zip(("lower", "upper"), (low, high), physical, strict=True):
        if is_at(value, end):
            return "at its physical limit" if end == limit else f"on its {side} bound: widen it"
    return ""


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
