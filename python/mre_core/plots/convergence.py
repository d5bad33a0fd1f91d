"""How swarms come down."""

from typing import TYPE_CHECKING, Literal

import numpy as np

from .style import SEQUENCE, new_figure, styled

if TYPE_CHECKING:
    from collections.abc import Mapping

    from matplotlib.figure import Figure

    from ..results import SwarmResult


@styled
def plot_convergence(
    runs: "Mapping[str, SwarmResult]", *, by: Literal["iteration", "evaluations"] = "iteration"
) -> "Figure":
    """Best fitness against iterations or evaluations (Figures 12 and 13 of the paper).

    Parameters
    ----------
    runs : mapping of label to SwarmResult
        Curves to draw: numbers of fish as in Figure 12, or algorithms as in Figure 13.
    by : {"iteration", "evaluations"}
        What the horizontal axis counts.

    Returns
    -------
    matplotlib.figure.Figure
        One curve a run; the best known optimum, where there is one, as a line across.
    """
    figure = new_figure(6.5, 4.5)
    axis = figure.subplots()
    for i, (label, run) in enumerate(runs.items()):
        x = run.history["evaluations"] if by == "evaluations" else np.arange(len(run.history))
        axis.plot(x, run.history["best"], **SEQUENCE[i % 4], linewidth=1.0 + 0.6 * (i // 4), label=label)
    optima = [run.optimum for run in runs.values() if run.optimum]
    if optima:
        axis.axhline(min(optima), color="0.5", linewidth=0.8, label="best known optimum")
    axis.set_xlabel("evaluations" if by == "evaluations" else "iteration")
    axis.set_ylabel(f"fitness / {next(iter(runs.values())).unit or '1'}")
    axis.set_yscale("log")
    axis.legend()
    return figure
