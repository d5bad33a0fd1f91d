"""The range of motion and current that a model was tested in."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from . import _core
from ._core import Recording
from .current_laws.variable import UNITS, series_of

if TYPE_CHECKING:
    from .model import Model


MOTION = ("displacement_mm", "velocity_mm_s")
"""Sizes of the motion that a model was tested with."""


def largest_motion(recordings: Sequence[Recording]) -> dict[str, float]:
    """Largest absolute displacement in mm and velocity in mm/s in recordings."""
    return {
        "displacement_mm": max(float(np.abs(r.displacement).max()) for r in recordings),
        "velocity_mm_s": max(float(np.abs(r.velocity).max()) for r in recordings),
    }


def beyond_tested(model: "Model", recording: Recording) -> list[str]:
    """One sentence for every tested range that a recording leaves by more than 1 %."""
    found = []
    series = {"displacement_mm": recording.displacement, "velocity_mm_s": recording.velocity}
    for key, values in series.items():
        largest, tested = float(np.abs(values).max()), model.tested.get(key)
        if tested is not None and largest > 1.01 * tested:
            what, _, unit = key.partition("_")
            unit = unit.replace("_", "/")
            sentence = f"{what} goes to {largest:.4g} {unit}, tested up to {tested:.4g} {unit}"
            share = f": {100 * (largest / tested - 1):.3g} % beyond" if tested else ""
            found.append(sentence + share)
    known = [level.current for level in model.levels if level.current is not None]
    if known and recording.current is not None:
        current = np.asarray(recording.current)
        low, high = float(current.min()), float(current.max())
        margin = 0.02 + 0.02 * max(abs(value) for value in known)
        if low < min(known) - margin or high > max(known) + margin:
            span = f"goes from {low:.4g} A to {high:.4g} A" if low < high else f"is {low:.4g} A"
            beyond = max(min(known) - low, high - max(known))
            found.append(
                f"current {span}, tested from {min(known):.4g} A to {max(known):.4g} A, {beyond:.3g} A"
                " beyond: the force of the nearest tested current is taken"
            )
    if f"{model.over}_from" in model.tested:
        low, high = model.tested[f"{model.over}_from"], model.tested[f"{model.over}_to"]
        values = series_of(recording, model.over)
        beyond = max(low - float(values.min()), float(values.max()) - high)
        if beyond > 0.02 + 0.02 * max(abs(low), abs(high)):
            found.append(
                f"{model.over} goes {beyond:.3g} {UNITS[model.over]} beyond the tested {low:.4g} to"
                f" {high:.4g}: the parameters of the nearest are taken"
            )
    found += _beyond_tested_temperature(model, recording)
    name = f"recording '{recording.name}': " if recording.name else ""
    return [name + sentence for sentence in found]


def _beyond_tested_temperature(model: "Model", recording: Recording) -> list[str]:
    tested = model.sizes.get("temperature")
    if tested is None or recording.temperature is None or not _feels_temperature(model):
        return []
    low, high = tested
    values = np.asarray(recording.temperature)
    beyond = max(low - float(values.min()), float(values.max()) - high)
    if beyond <= 0.05 * (high - low):
        return []
    return [f"temperature goes {beyond:.3g} degC beyond the tested {low:.4g} to {high:.4g}: its law goes on"]


def _feels_temperature(model: "Model") -> bool:
    laws = {(row["id"], row["law"]) for row in _core.catalogue() if row["feels_temperature"]}
    return any((effect.id, effect.law) in laws for effect in model.effects)
