"""Recordings out of CSV files and data frames."""

import os
import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ._core import MreError, Recording
from .columns import Column, assumption, find_columns
from .conditions import conditions_in_name, read_conditions
from .csvfile import line_of, open_csv, read_numbers
from .errors import InputError, UnitAssumedWarning
from .frame import frame_headers, frame_numbers

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


def load(
    path: str | os.PathLike[str],
    *,
    map: Mapping[str, str] | None = None,
    name_pattern: str | None = None,
    require_force: bool = True,
    **conditions: float | str | None,
) -> Recording:
    """Load a recording from a CSV file.

    The file is comma-separated UTF-8 text with a decimal point and one header row; ``#`` lines may
    precede it. A column is recognised by a header such as ``force_N`` or ``Force [kN]``, and its values
    are converted to the canonical unit: s, mm, mm/s, N, A, degC.

    Parameters
    ----------
    path : str or path-like
        The file. Its name without ending becomes the name of the recording.
    map : mapping of str to str, optional
        Role (time, displacement, velocity, force, current, temperature, simulated) to ``column`` or
        ``column[unit]``, for columns that are not recognised. Without a unit there the one in the header
        counts.
    name_pattern : str, optional
        Form of the file name, such as ``{amplitude}mm{frequency}Hz{current}A``. A field stands for a
        number, where ``0x5`` is 0.5; ``current`` and ``temperature`` become conditions, in the unit
        written behind the field (else A, degC).
    require_force : bool
        False leaves the force unread, for a simulation.
    **conditions : float or str
        ``current`` (A) or ``temperature`` (degC) of the whole recording; a text may carry a unit, as
        ``'500[mA]'``. They win over the file name, and both win over a column.

    Returns
    -------
    Recording
        The recording, in canonical units.

    Raises
    ------
    InputError
        The file, its name, a column, a unit, a cell or a condition is not usable. The text is one line
        with the file and, where there is one, the line and column.

    Warns
    -----
    UnitAssumedWarning
        A column states no unit, so the canonical one is taken.
    """
    path = Path(path)
    file = str(path)
    fixed = conditions_in_name(path.stem, name_pattern, file=file) if name_pattern is not None else {}
    fixed |= read_conditions(conditions, file=file)
    source = open_csv(path)
    known = _known(fixed, require_force)
    columns = find_columns(source.headers, map, require_force=require_force, fixed=known, file=file)
    if message := assumption(columns.values(), file):
        warnings.warn(message, UnitAssumedWarning, stacklevel=2)
    values = read_numbers(source, [column.header for column in columns.values()])
    time = values[columns["time"].header]
    if row := _standstill(time):
        raise _time_error(time, row, file=file, line=line_of(source, row), column=columns["time"].header)
    return _recording(columns, values, fixed, path.stem, file)


def from_dataframe(
    df: Any,
    map: Mapping[str, str] | None = None,
    *,
    name: str = "",
    require_force: bool = True,
    **conditions: float | str | None,
) -> Recording:
    """Make a recording from a data frame.

    Parameters
    ----------
    df : pandas.DataFrame or alike
        Anything with ``columns`` and ``df[column]``, where a column converts to a NumPy array of n
        numbers. Columns are recognised and converted as by `load`.
    map : mapping of str to str, optional
        Role to ``column`` or ``column[unit]``, as in `load`.
    name : str
        Name of the recording.
    require_force : bool
        False leaves the force unread, for a simulation.
    **conditions : float or str
        ``current`` (A) or ``temperature`` (degC) of the whole recording, as in `load`.

    Returns
    -------
    Recording
        The recording, in canonical units.

    Raises
    ------
    InputError
        A column, a unit, a value or a condition is not usable. Rows are counted from 0.

    Warns
    -----
    UnitAssumedWarning
        A column states no unit, so the canonical one is taken.
    """
    source = f"recording '{name}'" if name else None
    fixed = read_conditions(conditions, file=source)
    headers = frame_headers(df, source)
    known = _known(fixed, require_force)
    columns = find_columns(list(headers), map, require_force=require_force, fixed=known, file=source)
    if message := assumption(columns.values(), source):
        warnings.warn(message, UnitAssumedWarning, stacklevel=2)
    values = {
        column.header: frame_numbers(df[headers[column.header]], column.header, source)
        for column in columns.values()
    }
    time = values[columns["time"].header]
    if row := _standstill(time):
        raise _time_error(time, row, file=source, row=row, column=columns["time"].header)
    return _recording(columns, values, fixed, name, source)


def _known(fixed: Mapping[str, float], require_force: bool) -> set[str]:
    """Roles for which no column is read."""
    return set(fixed) | (set() if require_force else {"force"})


def _standstill(time: "NDArray[np.float64]") -> int:
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
