"""Parameters of a batch against the conditions of the recordings."""

import re
from collections.abc import Sequence
from typing import TYPE_CHECKING

from .. import _core
from ..checks import choice
from ..errors import InputError

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

AGAINST = {"current": "current / A", "amplitude": "amplitude / mm", "time": "time of the recording"}
_COLUMN = re.compile(r"(?P<name>.+)_low(?:\((?P<current>[^()]*) A\))?")


def long_table(results: "pd.DataFrame") -> "pd.DataFrame":
    """One row a parameter and item: ``parameter, value, low, high``, and the item's conditions.

    Parameters
    ----------
    results : pandas.DataFrame
        As `read_results` gives it. Items that failed are left out.

    Returns
    -------
    pandas.DataFrame
        Where an item has several currents, each of them has its row.
    """
    import pandas as pd

    done = results[results["status"] == "done"]
    parts = []
    for column in done.columns:
        match = _COLUMN.fullmatch(column)
        if match is None or match["name"].endswith("_bootstrap"):
            continue
        at = "" if match["current"] is None else f"({match['current']} A)"
        part = pd.DataFrame(
            {
                "item": done["item"],
                "seed": done["seed"],
                "parameter": match["name"],
                "value": done[f"{match['name']}{at}"],
                "low": done[column],
                "high": done[f"{match['name']}_high{at}"],
                "current": float(match["current"]) if at else done["current"],
                "amplitude": done["amplitude"],
                "time": done["modified_time"],
            }
        )
        parts.append(part[part["value"].notna()])
    if not parts:
        raise InputError("the results have no parameters", wanted="at least one item that is done")
    return pd.concat(parts, ignore_index=True)


def plot_parameters(
    results: "pd.DataFrame", against: str = "current", parameters: Sequence[str] | None = None
) -> "Figure":
    """Parameters with their intervals against current, amplitude or time.

    Parameters
    ----------
    results : pandas.DataFrame
        As `read_results` gives it.
    against : {"current", "amplitude", "time"}
        The horizontal axis: A, the largest displacement in mm, or when the recording's file was written.
    parameters : sequence of str, optional
        Which ones; all by default.

    Returns
    -------
    matplotlib.figure.Figure
        One panel a parameter. A parameter without interval is a hollow mark.

    Raises
    ------
    InputError
        Another axis, an unknown parameter, or nothing to show.
    """
    from matplotlib.figure import Figure

    choice(against, "against", AGAINST)
    table = long_table(results)
    names = list(parameters) if parameters is not None else list(dict.fromkeys(table["parameter"]))
    if unknown := sorted(set(names) - set(table["parameter"])):
        wanted = ", ".join(dict.fromkeys(table["parameter"]))
        raise InputError(f"'{unknown[0]}' is no parameter of the results", wanted=wanted)
    table = table[table[against].notna()]
    if table.empty:
        raise InputError(f"no item has a {against}", wanted=f"items with a {against}")
    units = _units(results)
    columns = min(3, len(names))
    rows = -(-len(names) // columns)
    figure = Figure(figsize=(3.4 * columns, 2.6 * rows), layout="constrained")
    for axis, name in zip(figure.subplots(rows, columns, squeeze=False).flat, names, strict=False):
        part = table[table["parameter"] == name]
        sure = part["low"].notna() & part["high"].notna()
        x, y = part[against], part["value"]
        ends = [(y - part["low"])[sure].clip(lower=0), (part["high"] - y)[sure].clip(lower=0)]
        axis.errorbar(x[sure], y[sure], yerr=ends, fmt="o", markersize=3, color="black", linewidth=0.8)
        axis.plot(x[~sure], y[~sure], "o", markersize=3, color="0.5", fillstyle="none")
        axis.set_title(name, fontsize="medium")
        axis.set_ylabel(units.get(name, ""))
        axis.tick_params(axis="x", rotation=30 if against == "time" else 0)
        axis.set_xlabel(AGAINST[against])
    for axis in figure.axes[len(names) :]:
        axis.remove()
    return figure


def _units(results: "pd.DataFrame") -> dict[str, str]:
    """Units of the parameters of the models in the results, and of all effects."""
    names = set(results["model"]) & set(_core.models()) if "model" in results else set()
    found = dict(pair for name in sorted(names) for pair in _core.parameters(name))
    for effect in _core.catalogue():
        coefficients, shapes, _ = _core.effect_parameters(effect["id"], effect["law"])
        found |= {f"{effect['id']}.{name}": unit for name, unit in (*coefficients, *shapes)}
    return found
