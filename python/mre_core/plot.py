"""Figures. Each function returns a Matplotlib figure and shows nothing."""

from typing import TYPE_CHECKING

import numpy as np

from ._core import Recording
from .measure import measure_fit
from .model import Model, simulate

if TYPE_CHECKING:
    from collections.abc import Mapping

    from matplotlib.figure import Figure

    from .diagnosis import History
    from .results import SwarmResult

_MEASURED = {"color": "0.6", "linewidth": 1.8, "label": "measured"}
_MODEL = {"color": "black", "linewidth": 0.9, "linestyle": "--", "label": "model"}
_MOST_POINTS = 20_000
_MOST_POINTS_A_PANEL = 1_500


def plot_fit(model: Model, recording: Recording) -> "Figure":
    """Force against time, displacement and velocity, and the error over time (Figures 4 to 7 of the paper).

    Parameters
    ----------
    model : Model
        An identified model.
    recording : Recording
        With force; what is excluded from the fitness is left out.

    Returns
    -------
    matplotlib.figure.Figure
        Readable in grey.
    """
    from matplotlib.figure import Figure

    fit = measure_fit(model, recording)
    scored = slice(*recording.scored)
    step = max(1, (scored.stop - scored.start) // _MOST_POINTS)
    shown = slice(scored.start, scored.stop, step)
    assert recording.force is not None  # measure_fit has checked
    measured, simulated = recording.force[shown], simulate(model, recording)[shown]
    time = recording.time[shown]
    figure = Figure(figsize=(9, 6.5), layout="constrained")
    axes = figure.subplots(2, 2)
    panels = [
        (axes[0, 0], time, "time / s"),
        (axes[1, 0], recording.displacement[shown], "displacement / mm"),
        (axes[1, 1], recording.velocity[shown], "velocity / mm/s"),
    ]
    for axis, abscissa, label in panels:
        axis.plot(abscissa, measured, **_MEASURED)
        axis.plot(abscissa, simulated, **_MODEL)
        axis.set_xlabel(label)
        axis.set_ylabel("force / N")
    axes[0, 0].legend(loc="upper right")
    error = axes[0, 1]
    error.plot(time, 100 * (measured - simulated) / np.abs(measured).max(), color="black", linewidth=0.8)
    error.set_xlabel("time / s")
    error.set_ylabel("error / % of the largest force")
    current = "" if fit.current is None else f", {fit.current:g} A"
    figure.suptitle(
        f"{recording.name or 'recording'}{current}: {model.name}, rms error {fit.rms:.3g} N"
        f" ({100 * fit.relative_rms:.3g} % of the force's)"
    )
    return figure


def plot_diagnosis(history: "History") -> "Figure":
    """Force against displacement, and what the models leave over time, before and after.

    Parameters
    ----------
    history : History
        Forces over one recording.

    Returns
    -------
    matplotlib.figure.Figure
        Readable in grey.
    """
    from matplotlib.figure import Figure

    figure = Figure(figsize=(9, 3.6), layout="constrained")
    loop, left = figure.subplots(1, 2)
    shown = slice(None, None, max(1, len(history.time) // _MOST_POINTS_A_PANEL))
    x = history.displacement[shown]
    loop.plot(x, history.measured[shown], **_MEASURED)
    loop.plot(x, history.base[shown], color="0.35", linewidth=0.9, linestyle=":", label="base model")
    loop.plot(x, history.final[shown], **_MODEL | {"label": "with effects"})
    loop.set_xlabel("displacement / mm")
    loop.set_ylabel("force / N")
    loop.legend(loc="upper left", fontsize="small")
    time = history.time[shown]
    left.plot(time, (history.measured - history.base)[shown], color="0.6", linewidth=0.9, label="before")
    left.plot(time, (history.measured - history.final)[shown], color="black", linewidth=0.6, label="after")
    left.set_xlabel("time / s")
    left.set_ylabel("measured - model / N")
    left.legend(loc="upper right", fontsize="small")
    return figure


def plot_convergence(runs: "Mapping[str, SwarmResult]", *, by: str = "iteration") -> "Figure":
    """Best fitness against iterations or evaluations (Figures 12 and 13 of the paper).

    Parameters
    ----------
    runs : mapping of label to SwarmResult
        Curves to draw.
    by : {"iteration", "evaluations"}
        What the horizontal axis counts.

    Returns
    -------
    matplotlib.figure.Figure
        One curve a run.
    """
    from matplotlib.figure import Figure

    figure = Figure(figsize=(6.5, 4.5), layout="constrained")
    axis = figure.subplots()
    styles = ["-", "--", "-.", ":"]
    for i, (label, run) in enumerate(runs.items()):
        x = run.history["evaluations"] if by == "evaluations" else np.arange(len(run.history))
        axis.plot(x, run.history["best"], color="black", linestyle=styles[i % 4], label=label)
    axis.set_xlabel("evaluations" if by == "evaluations" else "iteration")
    axis.set_ylabel(f"fitness / {next(iter(runs.values())).unit or '1'}")
    axis.set_yscale("log")
    axis.legend()
    return figure
