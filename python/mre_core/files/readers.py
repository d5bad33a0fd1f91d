"""The table of readers. A new format is one module with ``read(path, options)``, and one line here.

``read`` takes the path of a file that is there and within the limits, and what the user has said about it,
which formats that say it themselves do not need. It gives a list of `Table`, at least one, whose numbers are
read on demand. It raises an `InputError` where the file cannot be read, and a `NoTableError` where it is
whole and holds no table.
"""

import importlib
import os
from collections.abc import Iterable
from pathlib import Path
from typing import Final

from ..checks import is_text
from ..errors import InputError
from .limits import check_file
from .options import ReadOptions
from .table import Table, chosen

READERS: Final = {
    ".csv": "text",
    ".txt": "text",
    ".tsv": "text",
    ".dat": "text",
    ".asc": "text",
    ".lvm": "text",
    ".xlsx": "excel",
    ".xlsm": "excel",
    ".xls": "excel",
    ".mat": "matlab",
    ".tdms": "tdms",
    ".parquet": "parquet",
    ".h5": "hdf5",
    ".hdf5": "hdf5",
    ".hdf": "hdf5",
}
"""Ending to the module that reads it; any other ending is taken for text."""


def open_tables(path: str | os.PathLike[str], options: ReadOptions = ReadOptions()) -> list[Table]:  # noqa: B008  # immutable
    """Open a file of any known format.

    Parameters
    ----------
    path : str or path-like
        The file.
    options : ReadOptions
        What the user has said about it.

    Returns
    -------
    list of Table
        At least one.

    Raises
    ------
    InputError
        The file cannot be read, holds no table, or its library is not installed.
    """
    path = Path(path)
    check_file(path)
    reader = importlib.import_module(f".{READERS.get(path.suffix.lower(), 'text')}", __package__)
    try:
        tables = reader.read(path, options)
    except MemoryError:
        raise InputError("unpacks to more than the memory holds", file=str(path)) from None
    return chosen(tables, options.table, str(path))


def find_files(paths: Iterable[str | os.PathLike[str]]) -> list[Path]:
    """Put the files of a folder in its place.

    Parameters
    ----------
    paths : iterable of str or path-like
        Files and folders. Of a folder the files with a known ending are taken, sorted by name; names that
        start with a dot are passed over, and so are folders in it.

    Returns
    -------
    list of Path
        Files.

    Raises
    ------
    InputError
        A folder has no such file, or a file is given twice.
    """
    found = []
    for path in map(Path, paths):
        if not os.path.isdir(path):  # False also for a name that no file can have
            found.append(path)
            continue
        files = [
            file
            for file in sorted(path.iterdir())
            if file.suffix.lower() in READERS and file.is_file() and not file.name.startswith(".")
        ]
        if not files:
            wanted = f"files that end in {', '.join(READERS)}"
            raise InputError("is a folder without recordings", file=str(path), wanted=wanted)
        found += files
    _check_once(found)
    return found


def _check_once(files: Iterable[Path]) -> None:
    """Refuse a file that is named twice: it would count as more than was measured."""
    seen: dict[str, Path] = {}
    for file in files:
        if not is_text(str(file)):  # which is refused when it is read
            continue
        place = os.path.realpath(file)  # which a link to itself has, too
        if other := seen.get(place):
            also = "" if other == file else f", also as {other}"
            raise InputError(f"the file is given twice{also}", file=str(file), wanted="each file once")
        seen[place] = file
