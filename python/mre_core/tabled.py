"""From a table of a file, or of memory, to a recording."""

import warnings
from collections.abc import Collection, Mapping
from typing import TYPE_CHECKING, Any

from ._core import MreError, Recording
from .columns import Column, assumption, find_columns
from .errors import InputError, UnitAssumedWarning
from .files.table import Table

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


def columns_of(
    table: Table, map: Mapping[str, str] | None, fixed: Collection[str], *, require_force: bool = True
) -> dict[str, Column]:
    """Find the columns of a recording.

    Parameters
    ----------
    table : Table
        Where they are.
    map : mapping of str to str or None
        Role to ``column`` or ``column[unit]``.
    fixed : collection of str
        Roles whose value is known.
    require_force : bool
        False leaves the force unread.

    Returns
    -------
    dict of str to Column
        Columns by role.

    Raises
    ------
    InputError
        A role is missing or ambiguous, or a unit is wrong.
    """
    known = set(fixed) | (set() if require_force else {"force"})
    return find_columns(table.headers, map, require_force=require_force, fixed=known, file=table.source)


def recording_of(
    table: Table, columns: Mapping[str, Column], fixed: Mapping[str, float], name: str, *, stacklevel: int
) -> Recording:
    """Make a recording.

    Parameters
    ----------
    table : Table
        Where the columns are.
    columns : mapping of str to Column
        As found by `columns_of`.
    fixed : mapping of str to float
        Conditions in A and degC, which win over columns.
    name : str
        Name of the recording.
    stacklevel : int
        Of the warning about assumed units, counted from the caller.

    Returns
    -------
    Recording
        In canonical units.

    Raises
    ------
    InputError
        A cell is no number, time does not increase, or the core refuses the recording.

    Warns
    -----
    UnitAssumedWarning
        A column states no unit.
    """
    source = table.source
    if message := assumption(columns.values(), source):
        warnings.warn(message, UnitAssumedWarning, stacklevel=stacklevel + 1)
    values = table.numbers([column.header for column in columns.values()])
    time = values[columns["time"].header]
    if row := standstill(time):
        raise _time_error(time, row, file=source, column=columns["time"].header, **table.place(row))
    return _recording(columns, values, fixed, name, source)


def standstill(time: "NDArray[np.float64]") -> int:
    """First row at which time does not increase; 0 where it always does."""
    import numpy as np

    stops = np.flatnonzero(np.diff(time) <= 0)
    return int(stops[0]) + 1 if stops.size else 0


def _time_error(time: "NDArray[np.float64]", at: int, **place: Any) -> InputError:
    before, after = float(time[at - 1]), float(time[at])
    what = "is repeated" if after == before else "goes backward"
    problem = f"time {what}: {after!r} after {before!r}"
    return InputError(problem, value=after, wanted="time to increase from row to row", **place)


def _recording(
    columns: Mapping[str, Column],
    values: Mapping[str, "NDArray[np.float64]"],
    fixed: Mapping[str, float],
    name: str,
    source: str | None,
) -> Recording:
    import numpy as np

    # What overflows becomes infinite, which the core refuses with the place.
    with np.errstate(over="ignore"):
        series = {role: column.conversion.apply(values[column.header]) for role, column in columns.items()}
    try:
        return Recording(
            series["time"],
            series["displacement"],
            series.get("force"),
            velocity=series.get("velocity"),
            current=fixed.get("current", series.get("current")),
            temperature=fixed.get("temperature", series.get("temperature")),
            simulated=series.get("simulated"),
            name=name,
        )
    except MreError as error:
        problem = str(error).removeprefix(f"recording '{name}': ")
        raise InputError(problem, file=source) from error
