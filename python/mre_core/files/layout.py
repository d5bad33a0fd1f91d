"""Where in rows of cells the header, the units and the data stand."""

from collections.abc import Callable, Iterator, Sequence
from typing import Final, NamedTuple

from ..columns import recognise
from ..units import measured_by
from .table import with_unit

_FARTHEST_HEADER: Final = 2000
_LONGEST_UNIT: Final = 12
_MOST_LABELS: Final = 3


class Rows(NamedTuple):
    """Rows of cells of a text file or a sheet."""

    length: int
    cells: Callable[[int], list[str]]
    is_number: Callable[[str], bool]
    names: Callable[[int, int], list[str]]
    """Cells of a header, given the number of columns below it."""

    def is_data(self, i: int) -> bool:
        """At least two numbers, and they are half of what is there."""
        cells = [cell for cell in self.cells(i) if cell]
        numbers = sum(map(self.is_number, cells))
        return numbers >= 2 and 2 * numbers >= len(cells)

    def has_numbers(self, i: int) -> bool:
        """At least one number."""
        return any(map(self.is_number, self.cells(i)))

    def begins_with_number(self, i: int) -> bool:
        """Tell a row of data, even a broken one, from a line of text."""
        return self.is_data(i) or self.is_number(next(iter(self.cells(i)), ""))

    def is_content(self, i: int) -> bool:
        """Neither blank nor a comment."""
        cells = self.cells(i)
        return any(cells) and not cells[0].startswith("#")

    def content(self, start: int, stop: int) -> Iterator[int]:
        """Rows that are neither blank nor a comment."""
        return (i for i in range(start, min(stop, self.length)) if self.is_content(i))


class Block(NamedTuple):
    """One table: its header, and its rows of data."""

    headers: list[str]
    header: int | None
    """Row of the header; None where there is none."""
    units: int | None
    first: int
    stop: int


def find_block(rows: Rows, given: int | None = None) -> Block | None:
    """Find the first table.

    The header is the row that the user names; else the first one in which two columns are recognised;
    else the row above the first numbers. Below it there may be a row of units.

    Parameters
    ----------
    rows : Rows
        Rows of the file.
    given : int, optional
        Row of the header, counted from 0.

    Returns
    -------
    Block or None
        The table, to the end of the rows; None where there is neither a header that is recognised nor a
        row of numbers: notes, or nothing at all.
    """
    if given is not None:
        return _below(rows, given)
    near = range(min(rows.length, _FARTHEST_HEADER))
    seen = next((i for i in near if rows.is_content(i) and rows.is_data(i) and _goes_on(rows, i)), None)
    header = _header(rows, seen)
    if header is not None:
        return _below(rows, header)
    if seen is None:
        return None
    headers = [f"column {i + 1}" for i in range(len(rows.cells(seen)))]
    return Block(headers, None, None, seen, rows.length)


def _below(rows: Rows, header: int) -> Block:
    """Read the header, the row of units and other labels between it and the data."""
    labels: list[int] = []
    for i in rows.content(header + 1, rows.length):
        if rows.has_numbers(i) or len(labels) == _MOST_LABELS:
            break
        labels.append(i)
    after = next(rows.content(labels[-1] + 1 if labels else header + 1, rows.length), rows.length)
    width = len(rows.cells(after)) if after < rows.length and rows.is_data(after) else 0
    names = rows.names(header, width)
    units = next((i for i in labels if _are_units(rows.names(i, len(names)))), None)
    if width > len(names) and not any(rows.cells(after)[len(names) :]):
        names += [""] * (width - len(names))  # a separator at the end of every row of data
    first = header + 1
    if units is not None and after < rows.length and rows.is_data(after):
        texts = rows.names(units, len(names))
        texts += [""] * (len(names) - len(texts))
        pairs = zip(names, texts[: len(names)], strict=True)
        names = [with_unit(name, text) if name else name for name, text in pairs]
        first = after
    else:
        units = None
    return Block(names, header, units, first, rows.length)


def _header(rows: Rows, seen: int | None) -> int | None:
    """Find the row of names above the first numbers, or None where they have none."""
    above = None
    for i in rows.content(0, _FARTHEST_HEADER if seen is None else seen + 1):
        roles = {match[0] for cell in rows.names(i, 0) if (match := recognise(cell))}
        if len(roles) > 1:
            return i
        above = i if i != seen else above
    if seen is None:
        return None
    width = len(rows.cells(seen))
    if above is not None and _fits(rows, above, width):
        higher = [i for i in rows.content(0, above) if _fits(rows, i, width)]
        if _are_units(rows.names(above, width)) and higher:
            return higher[-1]
        return above
    # numpy.savetxt and others write the names as a comment.
    comments = [i for i in range(seen) if any(rows.cells(i)) and not rows.is_content(i)]
    if comments and _fits(rows, comments[-1], width):
        return comments[-1]
    return None


def _goes_on(rows: Rows, i: int) -> bool:
    """Tell the first row of data from a line of numbers in a preamble."""
    following = [j for j, _ in zip(rows.content(i + 1, rows.length), range(2), strict=False)]
    return all(rows.is_data(j) and len(rows.cells(j)) == len(rows.cells(i)) for j in following)


def _fits(rows: Rows, i: int, width: int) -> bool:
    """Tell whether a row can hold the names of so many columns."""
    names = [name for name in rows.names(i, width) if name]
    return 1 < len(names) <= width and len(names) >= width - 1 and not any(map(rows.is_number, names))


def _are_units(cells: Sequence[str]) -> bool:
    """At least one unit of a role, and nothing but short texts. A lone C may be anything."""
    bare = [cell.strip().strip("[]()").strip() for cell in cells]
    return max(map(len, bare), default=0) <= _LONGEST_UNIT and any(
        measured_by(text) not in (None, "temperature") for text in bare if text
    )
