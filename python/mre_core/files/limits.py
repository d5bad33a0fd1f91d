"""Sizes that no recording of a rig has: a small file can unpack to more than the memory."""

from pathlib import Path
from stat import S_ISDIR, S_ISREG
from typing import Any, Final

from ..checks import check_name
from ..errors import InputError
from .pipes import is_open_pipe, read_pipe

MOST_BYTES: Final = 2 * 2**30
MOST_VALUES: Final = 2 * 10**8
MOST_UNPACKED: Final = 2**29
"""Bytes of a workbook: a sheet that is full of numbers has less."""
MOST_ROWS: Final = 2**20
MOST_COLUMNS: Final = 1000
MOST_CELLS: Final = 2 * 10**7


def read_bytes(path: Path) -> bytes:
    """Read a whole file.

    Parameters
    ----------
    path : Path
        The file.

    Returns
    -------
    bytes
        Its content.

    Raises
    ------
    InputError
        It is missing, not readable, too large, or neither a regular file nor a pipe that is open.
    """
    check_file(path)
    try:
        if not is_open_pipe(path, path.stat().st_mode):
            return path.read_bytes()
        content = read_pipe(path, MOST_BYTES)
    except OSError as error:
        raise _unreadable(path, error) from None
    _check_size(len(content), path)
    return content


def check_file(path: Path) -> None:
    """Refuse what is no readable file of a sensible size.

    Parameters
    ----------
    path : Path
        The file.

    Raises
    ------
    InputError
        It is missing, not readable, too large, or neither a regular file nor a pipe that is open.
    """
    check_name(path)
    try:
        status = path.stat()
        if S_ISDIR(status.st_mode):
            wanted = f"one of the files in it, such as {path / '*.csv'}"
            raise InputError("is a folder", file=str(path), wanted=wanted)
        if is_open_pipe(path, status.st_mode):
            return
        if not S_ISREG(status.st_mode):  # a pipe may wait for ever, and a device never end
            wanted = "a regular file: write it out first"
            raise InputError("is no regular file", file=str(path), wanted=wanted)
        with path.open("rb"):
            pass
    except FileNotFoundError:
        raise InputError(f"there is no such file{_nearest(path)}", file=str(path)) from None
    except OSError as error:
        raise _unreadable(path, error) from None
    _check_size(status.st_size, path)


def check_values(count: int, file: str) -> None:
    """Refuse a file that says it holds an absurd number of values.

    Parameters
    ----------
    count : int
        Values once unpacked.
    file : str
        The file.

    Raises
    ------
    InputError
        There are too many.
    """
    if count > MOST_VALUES:
        problem = f"unpacks to {count:.3g} values"
        raise InputError(problem, file=file, value=count, wanted=f"at most {MOST_VALUES:.0e}")


def check_own(dataset: Any, file: str) -> None:
    """Refuse a dataset of HDF5 whose values are read from other files.

    Parameters
    ----------
    dataset : h5py.Dataset
        The dataset.
    file : str
        The file that it is in.

    Raises
    ------
    InputError
        Its values lie elsewhere.
    """
    if dataset.external or dataset.is_virtual:
        problem = f"the values of '{dataset.name}' lie in another file"
        raise InputError(problem, file=file, wanted="a file that holds them itself")


def check_archive(path: Path) -> None:
    """Refuse a zip archive, such as an .xlsx, that unpacks to an absurd size.

    Parameters
    ----------
    path : Path
        The archive.

    Raises
    ------
    InputError
        It is no whole archive, or too large.
    """
    import zipfile

    try:
        with zipfile.ZipFile(path) as archive:
            size = sum(member.file_size for member in archive.infolist())
    except Exception as error:  # beside its own, zipfile lets pass what damaged names and numbers cause
        raise InputError(f"cannot be read: {error}", file=str(path), wanted="a whole file") from None
    if size > MOST_UNPACKED:
        wanted = f"at most {MOST_UNPACKED / 2**20:.0f} MiB"
        raise InputError(f"unpacks to {size / 2**20:.0f} MiB", file=str(path), value=size, wanted=wanted)


def check_sheet(rows: int, columns: int, cells: int, file: str) -> None:
    """Refuse a sheet that goes on and on.

    Parameters
    ----------
    rows : int
        Rows so far.
    columns : int
        Of the last one.
    cells : int
        Cells so far, empty ones included.
    file : str
        The file.

    Raises
    ------
    InputError
        There are too many.
    """
    for found, most, what in (
        (rows, MOST_ROWS, "rows"),
        (columns, MOST_COLUMNS, "columns"),
        (cells, MOST_CELLS, "cells"),
    ):
        if found > most:
            raise InputError(f"has a sheet of {found} {what}", file=file, wanted=f"at most {most} {what}")


def _check_size(size: int, path: Path) -> None:
    if size > MOST_BYTES:
        wanted = f"at most {MOST_BYTES / 2**30:.0f} GiB (mre_core.read_chunks reads CSV of any size)"
        raise InputError(f"has {size / 2**30:.1f} GiB", file=str(path), value=size, wanted=wanted)


def _nearest(path: Path) -> str:
    """Name the file beside it that is called nearly so."""
    from difflib import get_close_matches

    try:
        names = [other.name for other in path.parent.iterdir()]
    except OSError:
        return ""
    near = get_close_matches(path.name, names, n=1, cutoff=0.8)
    return f" (nearest: {near[0]})" if near else ""


def _unreadable(path: Path, error: OSError) -> InputError:
    return InputError(f"cannot be read: {error.strerror or error}", file=str(path), wanted="a readable file")
