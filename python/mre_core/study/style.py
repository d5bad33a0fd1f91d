"""How the figures of the study look: readable in grey, no state shared between threads."""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.figure import Figure

LINES: tuple[str | tuple[int, tuple[int, ...]], ...] = ("-", "--", "-.", ":", (0, (6, 2, 1, 2, 1, 2)))
MARKERS = ("o", "s", "^", "D", "v", "P", "X")
MEASURED: dict[str, Any] = {"color": "0.65", "linewidth": 2.0}
MODEL: dict[str, Any] = {"color": "black", "linewidth": 0.9, "linestyle": "--"}


def figure(width: float, height: float) -> "Figure":
    """Make an empty figure of a size in inches, which shows nothing."""
    from matplotlib.figure import Figure

    return Figure(figsize=(width, height), layout="constrained")
