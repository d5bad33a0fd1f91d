"""Figures. Each function returns a Matplotlib figure, good to print and readable in grey, and shows nothing.

Save one with `save`, as PNG, SVG or PDF by the name of the file.
"""

from .before_after import plot_before_after
from .convergence import plot_convergence
from .determined import plot_correlations, plot_intervals
from .fit import plot_fit
from .harmonics import plot_harmonics
from .loops import plot_loops
from .residual_map import plot_residual_map
from .style import save

__all__ = [
    "plot_before_after",
    "plot_convergence",
    "plot_correlations",
    "plot_fit",
    "plot_harmonics",
    "plot_intervals",
    "plot_loops",
    "plot_residual_map",
    "save",
]
