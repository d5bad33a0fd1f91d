"""Columns of numbers out of lines of text, and the line of whatever is wrong with it."""

import csv
import io
import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from ..errors import InputError
from .clock import seconds_of_texts
from .dialect import Dialect

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


class Cells(NamedTuple):
    """Lines of data of a text file, or of a part of it, and the names of their columns."""

    file: str
    headers: list[str]
    body: list[str]
    first: int
    """Line of the file on which the body starts, counted from 1."""
    dialect: Dialect


def read_numbers(source: Cells, columns: Sequence[str]) -> dict[str, "NDArray[np.float64]"]:
    """Read columns as numbers.

    Parameters
    ----------
    source : Cells
        File or a part of it.
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
    most = len(source.headers)
    sign = source.dialect.separator
    if sign:
        plain = not any(line.count(sign) >= most or '"' in line for line in body)
    else:
        plain = not any(len(line.split()) > most for line in body)
    text = "\n".join(body) if plain else ""
    for read in (_fastest, _fast) if plain else ():
        if (values := read(source, columns, text)) is not None:
            return values
    return _careful(source, columns)


def read_clock(source: Cells, column: str) -> "NDArray[np.float64]":
    """Read a column of times of day.

    Parameters
    ----------
    source : Cells
        File or a part of it.
    column : str
        Name of the column.

    Returns
    -------
    (n,) ndarray
        Seconds from the first one.

    Raises
    ------
    InputError
        A cell is no time of day.
    """
    import numpy as np

    place = source.headers.index(column)
    rows = [(line, cells[place].strip() if place < len(cells) else "") for line, cells in _rows(source)]
    found = seconds_of_texts([text for _, text in rows])
    if (wrong := np.flatnonzero(np.isnan(found))).size:
        line, text = rows[int(wrong[0])]
        wanted = "a time of day, as in the first row"
        raise InputError(file=source.file, line=line, column=column, value=text, wanted=wanted)
    return found


def line_of(source: Cells, row: int) -> int:
    """Find the line on which a row of data starts.

    Parameters
    ----------
    source : Cells
        File or a part of it.
    row : int
        Row of data, counted from 0.

    Returns
    -------
    int
        Line of the file, counted from 1.
    """
    return next(line for i, (line, _) in enumerate(_rows(source)) if i == row)


def _fastest(source: Cells, columns: Sequence[str], body: str) -> dict[str, "NDArray[np.float64]"] | None:
    """Read with Arrow, which is strict; None where anything is not as it wants it."""
    import numpy as np
    from pyarrow import ArrowException, csv, float64

    if not source.dialect.separator:
        return None
    places = [str(i) for i in range(len(source.headers))]
    wanted = {name: str(source.headers.index(name)) for name in columns}
    try:
        table = csv.read_csv(
            io.BytesIO(body.encode()),
            read_options=csv.ReadOptions(use_threads=False, column_names=places),
            parse_options=csv.ParseOptions(delimiter=source.dialect.separator, quote_char=False),
            convert_options=csv.ConvertOptions(
                column_types=dict.fromkeys(wanted.values(), float64()),
                include_columns=list(dict.fromkeys(wanted.values())),
                null_values=[],
                decimal_point=source.dialect.decimal,
            ),
        )
    except (ArrowException, ValueError):
        return None
    values = {name: table[place].to_numpy() for name, place in wanted.items()}
    return values if all(np.isfinite(series).all() for series in values.values()) else None


def _fast(source: Cells, columns: Sequence[str], body: str) -> dict[str, "NDArray[np.float64]"] | None:
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
            sep=source.dialect.separator or r"\s+",
            decimal=source.dialect.decimal,
            **exact,
        )
    except ValueError:
        return None
    values = {name: frame[i].to_numpy() for name, i in position.items()}
    return values if all(np.isfinite(series).all() for series in values.values()) else None


def _careful(source: Cells, columns: Sequence[str]) -> dict[str, "NDArray[np.float64]"]:
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
                wanted=f"{width} as in the header ({source.dialect})",
            )
        for name, i in position.items():
            cell = cells[i] if i < len(cells) else ""
            is_number = source.dialect.is_number(cell)
            number = source.dialect.to_float(cell) if is_number else math.nan
            if not math.isfinite(number):
                problem = "" if cell.strip() else "found an empty cell"
                not_finite = cell.strip().lstrip("+-").lower() in {"nan", "inf", "infinity"}
                wanted = "a finite number" if not_finite or is_number else "a number"
                raise InputError(
                    problem, file=source.file, line=line, column=name, value=cell.strip(), wanted=wanted
                )
            values[name].append(number)
    return {name: np.array(series, dtype=np.float64) for name, series in values.items()}


def _rows(source: Cells) -> Iterator[tuple[int, list[str]]]:
    """Rows of data, each with the line on which it starts; blank lines are passed over."""
    sign = source.dialect.separator
    body = source.body if sign else [" ".join(line.split()) for line in source.body]
    reader = csv.reader(body, delimiter=sign or " ", skipinitialspace=True, strict=True)
    line = source.first
    try:
        for cells in reader:
            if len(cells) > 1 or any(cell.strip() for cell in cells):
                yield line, cells
            line = source.first + reader.line_num
    except csv.Error as error:
        problem = f"row cannot be read: {error}"
        raise InputError(problem, file=source.file, line=line, wanted="quotes in pairs") from None
