"""A text file that does not fit into memory, chunk by chunk."""

import os
import warnings
from collections.abc import Iterator, Mapping
from itertools import chain, islice
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

from .checks import check_name
from .columns import assumption, find_columns
from .errors import InputError, UnitAssumedWarning
from .files.cells import Cells, read_numbers
from .files.text import find_table

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Chunk = tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]


_HEAD = 2000
"""Lines in which the header has to be."""


def read_chunks(
    path: str | os.PathLike[str], *, map: Mapping[str, str] | None = None, rows: int = 1_000_000
) -> "Iterator[Chunk]":
    """Read displacement, velocity and force out of a text file, for `Problem.streamed`.

    Only one chunk is in memory at a time. The velocity has to be recorded: deriving it needs the samples
    on both sides. Time is not looked at.

    Parameters
    ----------
    path : str or path-like
        UTF-8 text, as for `load`.
    map : mapping of str to str, optional
        Role to ``column`` or ``column[unit]``, as in `load`.
    rows : int
        Lines of a chunk, at least 1.

    Yields
    ------
    (displacement, velocity, force) : tuple of array, shape (n,)
        mm, mm/s and N.

    Raises
    ------
    InputError
        The file, its name, a column, a unit or a cell is not usable; at the first chunk, or at the one it is
        in.

    Warns
    -----
    UnitAssumedWarning
        A column states no unit, so the canonical one is taken.
    """
    if isinstance(rows, bool) or not isinstance(rows, int) or rows < 1:
        raise InputError(f"rows is {rows!r}", wanted="a whole number of at least 1")
    check_name(path)
    file = str(path)
    try:
        with Path(path).open(encoding="utf-8-sig") as text:
            yield from _chunks(text, file, map, rows)
    except OSError as error:
        raise InputError(f"cannot be read: {error.strerror or error}", file=file) from None
    except UnicodeDecodeError as error:
        found = f"byte 0x{error.object[error.start]:02x} is not UTF-8"
        raise InputError(found, file=file, wanted="UTF-8 text") from None


def _chunks(text: TextIO, file: str, map: Mapping[str, str] | None, rows: int) -> "Iterator[Chunk]":
    head = [line.rstrip("\n") for line in islice(text, _HEAD)]
    block, _, dialect = find_table(head, file)
    headers = block.headers
    columns = find_columns(headers, map, fixed={"current", "temperature", "simulated"}, file=file)
    if "velocity" not in columns:
        wanted = "a column for it: it cannot be derived chunk by chunk"
        raise InputError("no column for velocity", file=file, wanted=wanted)
    used = [columns[role] for role in ("displacement", "velocity", "force")]
    if message := assumption(used, file):
        warnings.warn(message, UnitAssumedWarning, stacklevel=3)
    first = block.first + 1
    lines = chain(head[block.first :], text)
    while body := [line.rstrip("\n") for line in islice(lines, rows)]:
        values = read_numbers(Cells(file, headers, body, first, dialect), [column.header for column in used])
        displacement, velocity, force = (c.conversion.apply(values[c.header]) for c in used)
        yield displacement, velocity, force
        first += len(body)
