"""Many recordings or campaigns, each identified or diagnosed on its own: one table of results."""

from .columns import read_results
from .plots import plot_parameters
from .run import batch

__all__ = ["batch", "plot_parameters", "read_results"]
