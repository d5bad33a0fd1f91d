"""A model against a recording."""

from typing import TYPE_CHECKING

import numpy as np

from .._core import Recording
from ..measure import measure_fit
from ..model import Model, simulate
from .style import MEASURED, MODEL, new_figure, plain, styled, thin

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@styled
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
        Four panels.
    """
    fit = measure_fit(model, recording)
    shown = thin(slice(*recording.scored))
    assert recording.force is not None  # measure_fit has checked
    measured, simulated = recording.force[shown], simulate(model, recording)[shown]
    time = recording.time[shown]
    figure = new_figure(9, 6.5)
    axes = figure.subplots(2, 2)
    panels = [
        (axes[0, 0], time, "time / s"),
        (axes[1, 0], recording.displacement[shown], "displacement / mm"),
        (axes[1, 1], recording.velocity[shown], "velocity / mm/s"),
    ]
    for axis, abscissa, label in panels:
        axis.plot(abscissa, measured, **MEASURED)
        axis.plot(abscissa, simulated, **MODEL)
        axis.set_xlabel(label)
        axis.set_ylabel("force / N")
    axes[0, 0].legend(loc="lower left", bbox_to_anchor=(0, 1), ncol=2)
    error = axes[0, 1]
    error.plot(time, 100 * (measured - simulated) / np.abs(measured).max(), color="black", linewidth=0.8)
    error.set_xlabel("time / s")
    error.set_ylabel("error / % of the largest force")
    current = "" if fit.current is None else f", {fit.current:g} A"
    figure.suptitle(
        f"{plain(recording.name or 'recording')}{current}: {model.name}, rms error {fit.rms:.3g} N"
        f" ({100 * fit.relative_rms:.3g} % of the force's)"
    )
    return figure
