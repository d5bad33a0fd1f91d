"""From named arrays of a container (HDF5, MATLAB) to tables: arrays of equal length side by side are one."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from .clock import seconds
from .table import MemoryTable, Table, with_unit

if TYPE_CHECKING:
    from numpy.typing import NDArray

_FEWEST_ROWS: Final = 2
_MOST_COLUMNS: Final = 64


class Series(NamedTuple):
    """One array of a container."""

    folder: str
    """Group or struct it lies in; empty at the top."""
    name: str
    values: "NDArray[Any]"
    unit: object = None


def tables_of(series: Sequence[Series], source: str, notes: Sequence[str] = ()) -> list[Table]:
    """Group arrays into tables.

    Parameters
    ----------
    series : sequence of Series
        Arrays of one or two dimensions.
    source : str
        The file.
    notes : sequence of str
        What was understood about the file.

    Returns
    -------
    list of Table
        One for each folder, or for each length of arrays in it, that has at least two columns.
    """
    groups: dict[tuple[str, int], dict[str, Any]] = {}
    for one in series:
        for header, values in _columns(one).items():
            groups.setdefault((one.folder, len(values)), {})[header] = values
    kept = {key: columns for key, columns in groups.items() if len(columns) > 1 and key[1] >= _FEWEST_ROWS}
    found: list[Table] = []
    for (folder, length), columns in kept.items():
        alike = sum(1 for other, _ in kept if other == folder) > 1
        name = (f"{folder}[{length}]" if alike else folder) if len(kept) > 1 else ""
        where = f"{source}: {folder}" if folder else source
        found.append(MemoryTable(where, columns, name=name, notes=notes))
    return found


def readable(header: str, values: Any) -> tuple[str, Any]:
    """Turn dates and times of day into seconds, and say so in the header.

    Parameters
    ----------
    header : str
        Name of the column.
    values : array_like
        Its values.

    Returns
    -------
    (header, values) : tuple
        The same, or seconds from the first value.
    """
    clock = seconds(values)
    return (header, values) if clock is None else (with_unit(header, "s"), clock)


def _columns(one: Series) -> Mapping[str, Any]:
    """Columns of an array: itself, fields of records, or the long side of a matrix."""
    import numpy as np

    values = one.values
    if values.dtype.names and values.ndim == 1:
        return dict(readable(name, values[name]) for name in values.dtype.names if values[name].ndim == 1)
    values = np.squeeze(values) if values.ndim == 2 else values
    if values.ndim == 1:
        return dict([readable(with_unit(one.name, one.unit), values)])
    if values.ndim != 2 or min(values.shape) > _MOST_COLUMNS:
        return {}
    wide = values.T if values.shape[0] < values.shape[1] else values
    return {with_unit(f"{one.name}({i + 1})", one.unit): wide[:, i] for i in range(wide.shape[1])}
