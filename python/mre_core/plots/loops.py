"""Loops of several tests side by side."""

from collections.abc import Sequence
from itertools import groupby
from typing import TYPE_CHECKING, Literal

import numpy as np

from .._core import Recording
from ..errors import InputError
from ..grouping import each_of
from ..loops.cycles import find_cycles
from ..model import Model, simulate
from .style import MEASURED, MODEL, SEQUENCE, Look, new_figure, plain, styled, thin

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_COLUMNS = 3


@styled
def plot_loops(
    recordings: Recording | Sequence[Recording],
    model: Model | None = None,
    *,
    by: Literal["recording", "amplitude", "current"] = "recording",
) -> "Figure":
    """Force against displacement: a panel a recording, or the tests that share an amplitude or a current.

    Figures 8 to 10 of the paper are ``by="amplitude"``: one panel an amplitude, one loop a current.

    Parameters
    ----------
    recordings : Recording or sequence of them
        With force; what is excluded is left out.
    model : Model, optional
        Drawn over the measured loops.
    by : {"recording", "amplitude", "current"}
        What a panel holds. Amplitudes that differ by less than 5 % count as one.

    Returns
    -------
    matplotlib.figure.Figure
        The last closed cycle of every recording, or all of it where none closes.
    """
    everything = list(each_of(recordings))
    for recording in everything:
        if recording.force is None:
            raise InputError(f"recording '{recording.name}' has no force", wanted="a force to draw")
    panels = _panels(everything, by)
    columns = min(_COLUMNS, len(panels))
    rows = -(-len(panels) // columns)
    figure = new_figure(3.2 * columns + 0.6, 2.9 * rows + 0.4)
    axes = figure.subplots(rows, columns, squeeze=False).ravel()
    for axis, (title, members) in zip(axes, panels, strict=False):
        axis.set_title(plain(title), fontsize="medium")
        for i, recording in enumerate(members):
            _draw(axis, recording, model, "measured" if len(members) == 1 else _label(recording, by), i)
        axis.set_xlabel("displacement / mm")
        axis.set_ylabel("force / N")
        if len(members) > 1:
            axis.legend(fontsize="small")
    if len(panels[0][1]) == 1 and model is not None:
        axes[0].legend(fontsize="small")
    for axis in axes[len(panels) :]:
        axis.remove()
    return figure


def _panels(recordings: list[Recording], by: str) -> list[tuple[str, list[Recording]]]:
    if by == "recording":
        return [(r.name or f"recording {i}", [r]) for i, r in enumerate(recordings, 1)]
    if by == "current":
        ordered = sorted(recordings, key=lambda r: (r.current_level or 0.0, _amplitude(r)))
        return [
            (_current(level), list(group)) for level, group in groupby(ordered, lambda r: r.current_level)
        ]
    if by != "amplitude":
        raise InputError(f"by is {by!r}", wanted="recording, amplitude or current")
    panels: list[tuple[float, list[Recording]]] = []
    for recording in sorted(recordings, key=_amplitude):
        if not panels or _amplitude(recording) > 1.05 * panels[-1][0]:
            panels.append((_amplitude(recording), []))
        panels[-1][1].append(recording)
    return [
        (f"{amplitude:.2g} mm", sorted(members, key=lambda r: -(r.current_level or 0.0)))
        for amplitude, members in panels
    ]


def _amplitude(recording: Recording) -> float:
    return float(np.ptp(recording.displacement[slice(*recording.scored)])) / 2


def _current(level: float | None) -> str:
    return "current unknown" if level is None else f"{level:g} A"


def _label(recording: Recording, by: str) -> str:
    return _current(recording.current_level) if by == "amplitude" else f"{_amplitude(recording):.2g} mm"


def _draw(axis: "Axes", recording: Recording, model: Model | None, label: str, place: int) -> None:
    assert recording.force is not None  # checked before
    first, last = recording.scored
    cycles = find_cycles(recording.time[first:last], recording.displacement[first:last])
    if cycles:
        ends = np.searchsorted(recording.time, [cycles[-1].start, cycles[-1].stop])
        # A sample beyond either end, so that the loop closes.
        first, last = max(int(ends[0]) - 1, first), min(int(ends[1]) + 1, last)
    shown = thin(slice(first, last))
    x = recording.displacement[shown]
    style: Look = (
        MEASURED if label == "measured" else {**SEQUENCE[place % 4], "linewidth": 1.3, "label": label}
    )
    axis.plot(x, recording.force[shown], **style)
    if model is not None:
        simulated = simulate(model, recording)[shown]
        over: Look = MODEL if label == "measured" else {"color": "black", "linewidth": 0.6, "linestyle": ":"}
        axis.plot(x, simulated, **over)
