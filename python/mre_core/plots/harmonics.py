"""Harmonics of the force in a cyclic test."""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .._core import Recording
from ..errors import InputError
from ..loops.cycles import find_cycles
from ..model import Model, simulate
from .style import MEASURED, MODEL, Look, new_figure, plain, styled

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@styled
def plot_harmonics(recording: Recording, model: Model | None = None, *, most: int = 9) -> "Figure":
    """Amplitude of the force at the frequency of a cyclic test and its multiples.

    Parameters
    ----------
    recording : Recording
        With force and closed cycles; what is excluded is left out.
    model : Model, optional
        Its force and its error are shown beside.
    most : int
        Number of harmonics.

    Returns
    -------
    matplotlib.figure.Figure
        Bars on a logarithmic scale.
    """
    if recording.force is None:
        raise InputError(f"recording '{recording.name}' has no force", wanted="a force to analyse")
    part = slice(*recording.scored)
    time = recording.time[part]
    cycles = find_cycles(time, recording.displacement[part])
    if not cycles:
        raise InputError(f"recording '{recording.name}' has no closed cycle", wanted="a cyclic test")
    series: list[tuple[str, NDArray[np.float64], Look]] = [
        ("measured", recording.force[part], {"color": str(MEASURED["color"])})
    ]
    if model is not None:
        force = simulate(model, recording)[part]
        series.append(("model", force, {"color": MODEL["color"]}))
        series.append(
            ("error", series[0][1] - force, {"color": "white", "edgecolor": "black", "hatch": "///"})
        )
    spans = [(cycle.start, cycle.stop) for cycle in cycles]
    figure = new_figure(6.5, 3.6)
    axis = figure.subplots()
    numbers, width = np.arange(1, most + 1), 0.8 / len(series)
    for i, (label, y, look) in enumerate(series):
        at = numbers + (i - (len(series) - 1) / 2) * width
        axis.bar(at, _amplitudes(time, y, spans, most), width, label=label, linewidth=0.6, **look)
    frequency = 1 / float(np.mean([stop - start for start, stop in spans]))
    axis.set_yscale("log")
    axis.set_xticks(numbers)
    axis.set_xlabel(f"multiple of {frequency:.4g} Hz")
    axis.set_ylabel("amplitude of the force / N")
    axis.set_title(plain(recording.name or "recording"), fontsize="medium")
    axis.legend()
    return figure


def _amplitudes(
    time: NDArray[np.float64], y: NDArray[np.float64], spans: list[tuple[float, float]], most: int
) -> NDArray[np.float64]:
    """Amplitudes of the mean cycle's harmonics, by the trapezoid rule over each cycle."""
    found = np.zeros(most, dtype=complex)
    for start, stop in spans:
        inside = (time > start) & (time < stop)
        t = np.concatenate([[start], time[inside], [stop]])
        f = np.concatenate([np.interp([start], time, y), y[inside], np.interp([stop], time, y)])
        phase = (t - start) / (stop - start)
        for n in range(1, most + 1):
            found[n - 1] += 2 * np.trapezoid(f * np.exp(-2j * np.pi * n * phase), phase)
    return np.abs(found) / len(spans)
