"""How well parameters are determined."""

from typing import TYPE_CHECKING

import numpy as np

from .style import MODEL, SIGNED, new_figure, styled

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from ..uncertainty import Uncertainty


@styled
def plot_intervals(found: "Uncertainty") -> "Figure":
    """Intervals of the parameters and of what follows from them, as shares of their values.

    Parameters
    ----------
    found : Uncertainty
        Of a run of `identify`, or by `uncertainty`.

    Returns
    -------
    matplotlib.figure.Figure
        One row a parameter; what is not determined is said in words.
    """
    rows = [*found.parameters, *found.derived]
    figure = new_figure(7, 0.8 + 0.32 * len(rows))
    axis = figure.subplots()
    largest = 1.0
    for i, e in enumerate(rows):
        if e.low is None or e.high is None or e.value == 0:
            axis.text(0, i, e.interval or "on a bound", va="center", ha="center", style="italic")
            continue
        below, above = (100 * abs(end - e.value) / abs(e.value) for end in (e.low, e.high))
        largest = max(largest, below, above)
        axis.errorbar(0, i, xerr=[[below], [above]], fmt="o", color=MODEL["color"], capsize=3, markersize=4)
    axis.set_yticks(range(len(rows)), [f"{e.name} = {e.value:.4g} {e.unit}".rstrip() for e in rows])
    axis.set_ylim(len(rows) - 0.5, -0.5)
    axis.set_xscale("symlog", linthresh=1)  # an offset near zero has a wide one as a share of itself
    axis.set_xlim(-1.3 * largest, 1.3 * largest)
    axis.set_xlabel(f"{100 * found.level:g} % interval / % of the value")
    return figure


@styled
def plot_correlations(found: "Uncertainty") -> "Figure":
    """Correlations of the estimated parameters.

    Parameters
    ----------
    found : Uncertainty
        Of a run of `identify`, or by `uncertainty`.

    Returns
    -------
    matplotlib.figure.Figure
        A square a pair, with its number.
    """
    names = [e.name for e in found.parameters]
    size = 1.6 + 0.55 * len(names)
    figure = new_figure(size + 0.8, size)
    axis = figure.subplots()
    axis.grid(visible=False)
    drawn = axis.imshow(found.correlation, cmap=SIGNED, vmin=-1, vmax=1)
    for i, j in np.ndindex(found.correlation.shape):
        r = float(found.correlation[i, j])
        if np.isfinite(r):
            axis.text(
                j,
                i,
                f"{round(r, 2) + 0.0:.2f}",
                ha="center",
                va="center",
                fontsize="small",
                color="white" if r < 0.2 else "black",
            )
    axis.set_xticks(range(len(names)), names, rotation=45, ha="right", rotation_mode="anchor")
    axis.set_yticks(range(len(names)), names)
    figure.colorbar(drawn, ax=axis, label="correlation")
    return figure
