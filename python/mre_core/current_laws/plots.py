"""Figure of laws over the current."""

from typing import TYPE_CHECKING

import numpy as np

from ..errors import InputError
from .variable import UNITS

if TYPE_CHECKING:
    from collections.abc import Iterator

    from matplotlib.figure import Figure

    from ..model import Model


def plot_laws(model: "Model") -> "Figure":
    """Every parameter against what its law runs over, with 95 % intervals at the tested levels.

    Hollow marks are the values of the law. Intervals are missing where the recordings do not determine them.

    Parameters
    ----------
    model : Model
        With laws.

    Returns
    -------
    matplotlib.figure.Figure
        One panel a parameter.

    Raises
    ------
    InputError
        The model has no laws.
    """
    from matplotlib.figure import Figure

    if not model.laws:
        raise InputError("the model has no laws", wanted="a model by fit_laws")
    nodes = sorted({node for p in model.laws.values() for node in p.law.nodes})
    along = np.linspace(nodes[0], nodes[-1], 201)
    columns = min(3, len(model.laws))
    rows = -(-len(model.laws) // columns)
    figure = Figure(figsize=(3.4 * columns, 2.6 * rows), layout="constrained")
    axes = list(figure.subplots(rows, columns, squeeze=False).flat)
    for axis, (name, law) in zip(axes, model.laws.items(), strict=False):
        axis.plot(along, law.at(along), color="black", linewidth=0.9)
        axis.plot(law.law.nodes, law.values, "o", markersize=3, color="black", fillstyle="none")
        for at, (low, high) in _intervals(model, name):
            axis.plot([at, at], [low, high], color="0.4", linewidth=0.9, marker="_", markersize=5)
        axis.set_title(f"{name}: {law.law.kind}", fontsize="medium")
        axis.set_xlabel(f"{model.over} / {UNITS[model.over]}")
        axis.set_ylabel(model.units[name])
    for axis in axes[len(model.laws) :]:
        axis.remove()
    return figure


def _intervals(model: "Model", name: str) -> "Iterator[tuple[float, tuple[float, float]]]":
    """Intervals of a parameter, each with its place."""
    for level in model.levels:
        at = level.current
        if model.over != "current":  # the one level is the middle of what was tested
            at = 0.5 * (model.tested[f"{model.over}_from"] + model.tested[f"{model.over}_to"])
        if at is not None and name in level.intervals:
            yield at, level.intervals[name]
