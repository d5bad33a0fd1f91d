"""Where in the state plane a model is off."""

from typing import TYPE_CHECKING

import numpy as np

from .._core import Recording
from ..errors import InputError
from ..model import Model, simulate
from .style import SIGNED, new_figure, plain, styled

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@styled
def plot_residual_map(model: Model, recording: Recording, *, cells: int = 40) -> "Figure":
    """Mean error of the force over displacement and velocity.

    Parameters
    ----------
    model : Model
        What to compare with.
    recording : Recording
        With force; what is excluded is left out.
    cells : int
        Cells along each axis.

    Returns
    -------
    matplotlib.figure.Figure
        Light where the measured force is above the model's, dark where it is below; empty cells are white.
    """
    if recording.force is None:
        raise InputError(f"recording '{recording.name}' has no force", wanted="a force to compare with")
    part = slice(*recording.scored)
    x, v = recording.displacement[part], recording.velocity[part]
    error = (recording.force - simulate(model, recording))[part]
    count, x_edges, v_edges = np.histogram2d(x, v, bins=cells)
    total, _, _ = np.histogram2d(x, v, bins=(x_edges, v_edges), weights=error)
    mean = np.ma.masked_where(count == 0, total / np.maximum(count, 1))
    largest = float(np.abs(mean).max()) or 1.0
    figure = new_figure(5.6, 4.4)
    axis = figure.subplots()
    axis.grid(visible=False)
    drawn = axis.pcolormesh(
        x_edges, v_edges, mean.T, cmap=SIGNED, vmin=-largest, vmax=largest, rasterized=True
    )
    figure.colorbar(drawn, ax=axis, label="measured - model / N")
    axis.set_xlabel("displacement / mm")
    axis.set_ylabel("velocity / mm/s")
    axis.set_title(f"{plain(recording.name or 'recording')}: {model.name}", fontsize="medium")
    return figure
