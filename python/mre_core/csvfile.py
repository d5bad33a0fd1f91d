"""Columns of numbers out of a CSV file, and the line of whatever is wrong with it."""

import csv
import io
import math
import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from .errors import InputError, listed

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

_NUMBER: Final = re.compile(r"\s*[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?\s*", re.ASCII)
_EXAMPLE: Final = "time_s,displacement_mm,force_N"


class CsvFile(NamedTuple):
    """Lines of data of a CSV file, or of a part of it, and the names of their columns."""

    file: str
    headers: list[str]
    body: list[str]
    first: int
    """Line of the file on which the body starts, counted from 1."""


def open_csv(path: Path) -> CsvFile:
    """Read a CSV file and its header.

    Parameters
    ----------
    path : Path
        UTF-8 text, comma-separated, with one header row; ``#`` lines may precede it.

    Returns
    -------
    CsvFile
        All lines of data, and column names.

    Raises
    ------
    InputError
        The file cannot be read, is no such text, or its header is unusable.
    """
    file = str(path)
    lines = _decode(_bytes(path), file).replace("\r\n", "\n").replace("\r", "\n").split("\n")
    starts = (i for i, line in enumerate(lines, 1) if is_content(line))
    header_line = next(starts, None)
    if header_line is None:
        raise InputError("no header and no data", file=file, wanted=f"a header such as {_EXAMPLE}")
    headers = read_headers(lines[header_line - 1], file, header_line)
    if next(starts, None) is None:
        wanted = "rows of numbers below it"
        raise InputError("a header but no data", file=file, line=header_line, wanted=wanted)
    return CsvFile(file, headers, lines[header_line:], header_line + 1)


def is_content(line: str) -> bool:
    """Tell a header or data from a blank line or a comment."""
    return bool(line.strip()) and not line.lstrip().startswith("#")


def read_numbers(source: CsvFile, columns: Sequence[str]) -> dict[str, "NDArray[np.float64]"]:
    """Read columns as numbers.

    Parameters
    ----------
    source : CsvFile
        File as opened by `open_csv`, or a part of it.
    columns : sequence of str
        Names of the columns wanted; the others may hold anything.

    Returns
    -------
    dict of str to (n,) ndarray
        Finite values by column name.

    Raises
    ------
    InputError
        A cell is no finite number, or a row has more fields than the header.
    """
    body = source.body
    commas = len(source.headers) - 1
    plain = not any(line.count(",") > commas or '"' in line for line in body)
    values = _fast(source, columns, "\n".join(body)) if plain else None
    return _careful(source, columns) if values is None else values


def line_of(source: CsvFile, row: int) -> int:
    """Find the line on which a row of data starts.

    Parameters
    ----------
    source : CsvFile
        File as opened by `open_csv`.
    row : int
        Row of data, counted from 0.

    Returns
    -------
    int
        Line of the file, counted from 1.
    """
    return next(line for i, (line, _) in enumerate(_rows(source)) if i == row)


def _bytes(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except FileNotFoundError:
        raise InputError("there is no such file", file=str(path)) from None
    except OSError as error:
        # Windows answers a folder with a plain refusal.
        if path.is_dir():
            wanted = f"the files in it, such as {path / '*.csv'}"
            raise InputError("is a folder", file=str(path), wanted=wanted) from None
        problem = f"cannot be read: {error.strerror or error}"
        raise InputError(problem, file=str(path), wanted="a readable file") from None


def _decode(data: bytes, file: str) -> str:
    wanted = "comma-separated UTF-8 text"
    if not data.strip():
        raise InputError("the file is empty", file=file, wanted=f"a header such as {_EXAMPLE} and data")
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        raise InputError("is UTF-16 text", file=file, wanted=wanted)
    if b"\0" in data:
        raise InputError("is not a text file", file=file, wanted=wanted)
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        # The position counts from behind a byte-order mark.
        start = error.start + (3 if data.startswith(b"\xef\xbb\xbf") else 0)
        line = data.count(b"\n", 0, start) + 1
        found = f"byte 0x{data[start]:02x} is not UTF-8"
        raise InputError(found, file=file, line=line, wanted=wanted) from None


def read_headers(text: str, file: str, line: int) -> list[str]:
    """Read the names of the columns out of a header; what is no header is refused."""
    try:
        (names,) = csv.reader([text], skipinitialspace=True, strict=True)
    except csv.Error as error:
        raise InputError(f"header cannot be read: {error}", file=file, line=line, wanted=_EXAMPLE) from None
    names = [name.strip() for name in names]
    separator = next((name for mark, name in ((";", "semicolons"), ("\t", "tabs")) if mark in text), None)
    if len(names) == 1 and separator:
        raise InputError(f"found {separator} between the columns", file=file, line=line, wanted="commas")
    if all(_NUMBER.fullmatch(name) for name in names):
        raise InputError("found numbers only", file=file, line=line, wanted=f"a header such as {_EXAMPLE}")
    twice = [name for name in dict.fromkeys(names) if name and names.count(name) > 1]
    if twice:
        found = f"header has {listed(twice)} more than once"
        wanted = "a different name for each column"
        raise InputError(found, file=file, line=line, value=twice[0], wanted=wanted)
    return names


def _fast(source: CsvFile, columns: Sequence[str], body: str) -> dict[str, "NDArray[np.float64]"] | None:
    """Read with pandas; None where anything is wrong, for `_careful` to tell what."""
    import numpy as np
    import pandas as pd

    position = {name: source.headers.index(name) for name in columns}
    # Digits have to survive to the last bit; later versions do so without being told, and deprecate it.
    release = tuple(int(part) for part in pd.__version__.split(".")[:2])
    exact: dict[str, Any] = {"float_precision": "round_trip"} if release < (3, 1) else {}
    try:
        frame = pd.read_csv(
            io.StringIO(body),
            header=None,
            names=list(range(len(source.headers))),
            index_col=False,
            usecols=sorted(position.values()),
            dtype=np.float64,
            keep_default_na=False,
            **exact,
        )
    except ValueError:
        return None
    values = {name: frame[i].to_numpy() for name, i in position.items()}
    return values if all(np.isfinite(series).all() for series in values.values()) else None


def _careful(source: CsvFile, columns: Sequence[str]) -> dict[str, "NDArray[np.float64]"]:
    """Read cell by cell and stop at the first one that is wrong."""
    import numpy as np

    width = len(source.headers)
    position = {name: source.headers.index(name) for name in columns}
    values: dict[str, list[float]] = {name: [] for name in columns}
    for line, cells in _rows(source):
        if len(cells) > width:
            raise InputError(
                f"found {len(cells)} fields",
                file=source.file,
                line=line,
                value=len(cells),
                wanted=f"{width} as in the header (and decimal points, not commas)",
            )
        for name, i in position.items():
            cell = cells[i] if i < len(cells) else ""
            number = float(cell) if _NUMBER.fullmatch(cell) else math.nan
            if not math.isfinite(number):
                problem = "" if cell.strip() else "found an empty cell"
                not_finite = cell.strip().lstrip("+-").lower() in {"nan", "inf", "infinity"}
                wanted = "a finite number" if not_finite or _NUMBER.fullmatch(cell) else "a number"
                raise InputError(
                    problem, file=source.file, line=line, column=name, value=cell.strip(), wanted=wanted
                )
            values[name].append(number)
    return {name: np.array(series, dtype=np.float64) for name, series in values.items()}


def _rows(source: CsvFile) -> Iterator[tuple[int, list[str]]]:
    """Rows of data, each with the line on which it starts; blank lines are passed over."""
    reader = csv.reader(source.body, skipinitialspace=True, strict=True)
    line = source.first
    try:
        for cells in reader:
            if len(cells) > 1 or any(cell.strip() for cell in cells):
                yield line, cells
            line = source.first + reader.line_num
    except csv.Error as error:
        problem = f"row cannot be read: {error}"
        raise InputError(problem, file=source.file, line=line, wanted="quotes in pairs") from None
