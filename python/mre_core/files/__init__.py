"""Tables of numbers out of the files of a rig: one module a format, and one table of them in `readers`."""

from .options import ReadOptions
from .readers import find_files, open_tables
from .table import Table

__all__ = ["ReadOptions", "Table", "find_files", "open_tables"]
