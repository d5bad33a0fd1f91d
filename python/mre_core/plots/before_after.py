"""A diagnosis in one figure."""

from typing import TYPE_CHECKING, Final

from .style import BASE, MEASURED, MODEL, new_figure, plain, rms, styled, thin

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from ..diagnosis import History

_ABOVE: Final = {"loc": "lower left", "bbox_to_anchor": (0, 1), "fontsize": "small"}


@styled
def plot_before_after(history: "History") -> "Figure":
    """Force against displacement, and what the models leave over time, before and after.

    Parameters
    ----------
    history : History
        Forces over one recording, from the `histories` of a diagnosis.

    Returns
    -------
    matplotlib.figure.Figure
        Two panels.
    """
    figure = new_figure(9, 3.6)
    loop, left = figure.subplots(1, 2)
    shown = thin(slice(0, len(history.time)))
    x, time = history.displacement[shown], history.time[shown]
    loop.plot(x, history.measured[shown], **MEASURED)
    loop.plot(x, history.base[shown], **BASE)
    loop.plot(x, history.final[shown], **MODEL | {"label": "with effects"})
    loop.set_xlabel("displacement / mm")
    loop.set_ylabel("force / N")
    loop.legend(**_ABOVE, ncol=3)
    before, after = history.measured - history.base, history.measured - history.final
    left.plot(
        time, before[shown], color=BASE["color"], linewidth=0.9, label=f"before (rms {rms(before):.3g} N)"
    )
    left.plot(
        time, after[shown], color=MODEL["color"], linewidth=0.7, label=f"after (rms {rms(after):.3g} N)"
    )
    left.set_xlabel("time / s")
    left.set_ylabel("measured - model / N")
    left.legend(**_ABOVE, ncol=2)
    figure.suptitle(plain(history.recording))
    return figure
