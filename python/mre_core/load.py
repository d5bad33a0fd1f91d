"""Recordings out of files of any known format."""

import os
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from ._core import Recording
from .checks import flag
from .conditions import conditions_in_name, read_conditions
from .errors import InputError, SkippedWarning, listed, one_line
from .files import ReadOptions, Table, find_files, open_tables
from .files.blocks import joined
from .files.table import EvenTable, NoTableError
from .tabled import columns_of, recording_of


def load(
    path: str | os.PathLike[str],
    *,
    map: Mapping[str, str] | None = None,
    name_pattern: str | None = None,
    read: Mapping[str, object] | None = None,
    require_force: bool = True,
    **conditions: float | str | None,
) -> Recording:
    """Load the recording in a file.

    The format follows from the ending: text (.csv, .txt and others), Excel, MATLAB, LabVIEW .tdms, Parquet,
    HDF5. In text the encoding, the separator, the decimal mark, the header and a row of units are found
    out; `mre_core.inspect` shows what was understood. A column is recognised by a header such as ``force_N``
    or ``Force [kN]``, and its values are converted to the canonical unit: s, mm, mm/s, N, A, degC.

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
    read : mapping of str to object, optional
        How to read the file, where that is not found out: ``encoding``, ``separator``, ``decimal``,
        ``header`` (line from 1), ``table`` (sheet, group, block), ``rate`` (Hz, without a column for time).
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
    options = ReadOptions.of(read)
    require_force = flag(require_force, "require_force")
    found = _load_file(Path(path), map, name_pattern, options, conditions, require_force=require_force)
    if len(found) > 1:
        names = listed([recording.name for recording in found])
        wanted = "load_all, or one of them by read={'table': ...}"
        raise InputError(f"holds {len(found)} recordings: {names}", file=str(path), wanted=wanted)
    return found[0]


def load_all(
    paths: str | os.PathLike[str] | Sequence[str | os.PathLike[str]],
    *,
    map: Mapping[str, str] | None = None,
    name_pattern: str | None = None,
    read: Mapping[str, object] | None = None,
    require_force: bool = True,
    **conditions: float | str | None,
) -> list[Recording]:
    """Load all recordings of a campaign.

    Parameters
    ----------
    paths : str, path-like, or sequence of them
        Files and folders. A folder stands for the files in it, sorted by name. A file may hold several
        recordings: sheets, groups, structs, or blocks in which time starts anew.
    map, name_pattern, read, require_force, **conditions
        As for `load`, for every recording. The pattern may match the sheet or group instead of the file.

    Returns
    -------
    list of Recording
        In the order of the files; named by the file, and behind ``#`` by the sheet or block.

    Raises
    ------
    InputError
        A file cannot be read, as for `load`, or is given twice.

    Warns
    -----
    SkippedWarning
        A file of a folder, or a table of a file, holds no recording.
    """
    files = load_each(
        paths,
        map=map,
        name_pattern=name_pattern,
        read=read,
        require_force=require_force,
        on_file=None,
        **conditions,
    )
    return [recording for found in files for recording in found]


def load_each(
    paths: str | os.PathLike[str] | Sequence[str | os.PathLike[str]],
    *,
    map: Mapping[str, str] | None = None,
    name_pattern: str | None = None,
    read: Mapping[str, object] | None = None,
    require_force: bool = True,
    on_file: Callable[[int, int], object] | None = None,
    **conditions: float | str | None,
) -> Iterator[list[Recording]]:
    """Load as `load_all` does, one file after the other: the recordings of each.

    `on_file` is called with (files read, files) as it goes.
    """
    given = [paths] if isinstance(paths, str | os.PathLike) else list(paths)
    options = ReadOptions.of(read)
    require_force = flag(require_force, "require_force")
    named = {Path(path) for path in given}
    files = find_files(given)
    none = True
    for place, file in enumerate(files):
        if on_file is not None:
            on_file(place, len(files))
        try:
            found = _load_file(file, map, name_pattern, options, conditions, require_force=require_force)
        except NoTableError as error:
            if file in named:
                raise
            warnings.warn(f"passed over: {error}", SkippedWarning, stacklevel=3)
            continue
        none = none and not found
        yield found
    if given and none:
        raise InputError("no file holds a recording", file=str(given[0]), wanted="at least one recording")


def _load_file(
    path: Path,
    map: Mapping[str, str] | None,
    name_pattern: str | None,
    options: ReadOptions,
    given: Mapping[str, float | str | None],
    *,
    require_force: bool,
) -> list[Recording]:
    tables = joined(open_tables(path, options), map)
    if options.rate is not None:
        tables = [EvenTable(table, options.rate) for table in tables]
    stated = read_conditions(given, file=str(path))
    by_name = [_conditions(table, path, name_pattern) for table in tables]
    usable = list(_usable(tables, [fixed | stated for fixed in by_name], map, require_force))
    found = []
    for table, columns, fixed in usable:
        name = path.stem if len(usable) == 1 or not table.name else f"{path.stem}#{table.name}"
        found.append(recording_of(table, columns, fixed, one_line(name), stacklevel=3))
    return found


def _conditions(table: Table, path: Path, pattern: str | None) -> dict[str, float]:
    """Conditions in the name of the table, if that has the form, or else of the file."""
    if pattern is None:
        return {}
    if table.name:
        try:
            return conditions_in_name(table.name, pattern)
        except InputError:
            pass
    return conditions_in_name(path.stem, pattern, file=str(path))


def _usable(
    tables: Sequence[Table],
    conditions: Sequence[Mapping[str, float]],
    map: Mapping[str, str] | None,
    require_force: bool,
) -> Iterator[tuple[Table, Any, Mapping[str, float]]]:
    """Pass over the tables that are no recordings, unless none is one."""
    failures: list[InputError] = []
    for table, fixed in zip(tables, conditions, strict=True):
        try:
            columns = columns_of(table, map, fixed, require_force=require_force)
        except InputError as error:
            failures.append(error)
        else:
            yield table, columns, fixed
    if len(failures) == len(tables):
        raise failures[0]
    for failure in failures:
        warnings.warn(f"passed over: {failure}", SkippedWarning, stacklevel=4)
