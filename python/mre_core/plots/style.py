"""What all figures share: lines that differ in grey, and how a figure is made and saved."""

import os
from collections.abc import Callable
from functools import wraps
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, TypeVar

import numpy as np

from ..errors import InputError, listed, shown

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

Look = dict[str, Any]
"""Keywords of Matplotlib that make a line or a bar."""

F = TypeVar("F", bound=Callable[..., Any])

MEASURED: Final[Look] = {"color": "0.62", "linewidth": 2.0, "label": "measured", "solid_capstyle": "round"}
MODEL: Final[Look] = {"color": "#10375c", "linewidth": 1.0, "linestyle": "--", "label": "model"}
BASE: Final[Look] = {"color": "#b5541c", "linewidth": 1.0, "linestyle": ":", "label": "base model"}

SEQUENCE: Final[tuple[Look, ...]] = (
    {"color": "#10375c", "linestyle": "-"},
    {"color": "#b5541c", "linestyle": "--"},
    {"color": "#4f8f5b", "linestyle": "-."},
    {"color": "#8a7fb8", "linestyle": ":"},
)
"""For several curves: they differ in colour, in grey value and in their dashes."""

SIGNED: Final = "cividis"
"""Colours of values of both signs: their lightness rises from the smallest to the largest."""

_FORMATS: Final = {".png": None, ".svg": "Date", ".pdf": "CreationDate"}
"""Endings of files, and where the format has a date, its name."""

_STYLE: Final[Any] = {
    "font.size": 9.0,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "0.92",
    "grid.linewidth": 0.6,
    "axes.axisbelow": True,
    "legend.frameon": False,
    "savefig.dpi": 160,
}
_MOST_POINTS = 20_000


def styled(function: F) -> F:
    """Draw a figure in the style of the package, whatever the user's own style is."""

    @wraps(function)
    def drawn(*arguments: Any, **options: Any) -> Any:
        import matplotlib

        with matplotlib.rc_context(_STYLE):
            return function(*arguments, **options)

    return drawn  # type: ignore[return-value]  # same parameters and result


def new_figure(width: float, height: float) -> "Figure":
    """Figure of a size in inches, without the state of pyplot."""
    from matplotlib.figure import Figure

    return Figure(figsize=(width, height), layout="constrained")


def thin(part: slice, most: int = _MOST_POINTS) -> slice:
    """Every n-th sample of a part, so that a drawing stays small."""
    return slice(part.start, part.stop, max(1, (part.stop - part.start) // most))


def plain(text: str) -> str:
    """Text from a user, which is not mathematics."""
    return text.replace("$", r"\$")


def rms(values: "NDArray[np.float64]") -> float:
    """Root mean square."""
    return float(np.sqrt(np.mean(values**2)))


def save(figure: "Figure", path: str | os.PathLike[str]) -> None:
    """Save a figure; figures of the same data give the same bytes.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
        What to save.
    path : str or path
        Its ending chooses the format: ``.png``, ``.svg`` or ``.pdf``.

    Raises
    ------
    MreError
        Another ending, or none (a ValueError).
    """
    import matplotlib

    ending = Path(path).suffix.lower()
    if ending not in _FORMATS:
        endings = listed(sorted(_FORMATS))
        raise InputError(f"the ending of {shown(str(path))} is {shown(ending)}", wanted=f"one of {endings}")
    dated = _FORMATS[ending]
    with matplotlib.rc_context(_STYLE | {"svg.hashsalt": "mre-core"}):
        figure.savefig(path, metadata={dated: None} if dated else None)
