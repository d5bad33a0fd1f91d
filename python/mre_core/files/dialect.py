"""What separates the cells of a text file, and what its decimal mark is."""

import csv
import re
from collections import defaultdict
from collections.abc import Sequence
from typing import Final, NamedTuple

from .options import SEPARATORS, ReadOptions

# Marks between thousands count only with decimals behind them: 1,234 may be a decimal comma.
_EXPONENT: Final = r"(?:[eE][+-]?\d+)?\s*"
_POINT: Final = re.compile(r"\s*[+-]?(?:\d+(?:\.\d*)?|\.\d+|\d{1,3}(?:,\d{3})+\.\d+)" + _EXPONENT, re.ASCII)
_COMMA: Final = re.compile(r"\s*[+-]?(?:\d+(?:,\d*)?|,\d+|\d{1,3}(?:\.\d{3})+,\d+)" + _EXPONENT, re.ASCII)
_PIECE: Final = 100
_ROUNDING: Final = 1e-6
"""More than what sums of some hundred shares differ by."""
_BLANK: Final = 0.9
"""Blanks cut nearly everything: any other separator goes before them."""
# A header of words apart by single blanks: a bracket belongs to the word before it.
_BLANKS: Final = re.compile(r"\s+(?![\[(])")
_WIDE_BLANKS: Final = re.compile(r"\t+|\s{2,}")


class Dialect(NamedTuple):
    """How a line is cut into cells, and how a number is written."""

    separator: str
    """Empty for runs of blanks."""
    decimal: str

    def is_number(self, cell: str) -> bool:
        """Tell a number from any other text."""
        return (_POINT if self.decimal == "." else _COMMA).fullmatch(cell) is not None

    def to_float(self, cell: str) -> float:
        """Convert a cell that is a number."""
        if self.decimal == ",":
            return float(cell.replace(".", "").replace(",", "."))
        return float(cell.replace(",", ""))

    def cells(self, line: str) -> list[str]:
        """Cut a line; blanks around a cell are dropped.

        Parameters
        ----------
        line : str
            Line of the file.

        Returns
        -------
        list of str
            Cells. A line with a quotation mark that is not closed is cut as if there was none.
        """
        if not self.separator:
            return line.split()
        if '"' in line:
            try:
                (cells,) = csv.reader([line], delimiter=self.separator, skipinitialspace=True, strict=True)
                return [cell.strip() for cell in cells]
            except (csv.Error, ValueError):
                pass
        return [cell.strip() for cell in line.split(self.separator)]

    def names(self, line: str, width: int) -> list[str]:
        """Cut a header; where blanks separate, so that it has `width` cells if that can be."""
        if self.separator:
            return self.cells(line)
        cut = (_WIDE_BLANKS.split(line.strip()), _BLANKS.split(line.strip()), line.split())
        return next((names for names in cut if len(names) == width), cut[1])

    def __str__(self) -> str:
        name = next(name for name, sign in SEPARATORS.items() if sign == self.separator)
        return f"{name} between columns, decimal {'point' if self.decimal == '.' else 'comma'}"


_KNOWN: Final = [
    Dialect(separator, decimal)
    for separator, decimal in (
        *(("\t", "."), (";", "."), (",", "."), ("\t", ","), (";", ",")),
        *((",", ","), ("|", "."), ("|", ","), ("", "."), ("", ",")),
    )
]


def find_dialect(lines: Sequence[str], options: ReadOptions) -> Dialect:
    """Find the dialect under which most lines are rows of numbers.

    Parameters
    ----------
    lines : sequence of str
        Lines of the file.
    options : ReadOptions
        What the user has said.

    Returns
    -------
    Dialect
        The best one; where there are no numbers, the one that cuts the first line into most cells.
    """
    known = [
        dialect
        for dialect in _KNOWN
        if options.separator in (None, dialect.separator) and options.decimal in (None, dialect.decimal)
    ]
    sample = [line for line in _sample(lines) if line.strip()]
    best, most = known[0], 0.0
    for dialect in known:  # of equal ones the first
        if (score := _score(dialect, sample, most)) > most:
            best, most = dialect, score
    if most > 0:
        return best
    head = next((line for line in sample if not line.lstrip().startswith("#")), "")
    order = {",": 3, ";": 2, "\t": 1}
    return max(known, key=lambda d: (len(d.cells(head)) if d.separator else 0, order.get(d.separator, 0)))


def _sample(lines: Sequence[str]) -> list[str]:
    """Lines from the beginning, the middle and the end."""
    n = len(lines)
    places = [
        range(0, min(n, 3 * _PIECE)),
        range(n // 2, min(n, n // 2 + _PIECE)),
        range(max(0, n - _PIECE), n),
    ]
    return [lines[i] for i in sorted(set().union(*places))]


def _score(dialect: Dialect, sample: Sequence[str], most: float) -> float:
    """Add up the share of numbers in the rows that hold at least two, over the rows of one width.

    Ends early, with less than `most`, where that cannot be reached any more.
    """
    weight = 1.0 if dialect.separator else _BLANK
    scores: defaultdict[int, float] = defaultdict(float)
    best = 0.0
    for left, line in zip(range(len(sample), 0, -1), sample, strict=True):
        if weight * (best + left) < most - _ROUNDING:
            return 0.0
        if dialect.separator not in line:
            continue  # one cell
        cells = dialect.cells(line)
        filled = [cell for cell in cells if cell]
        numbers = sum(map(dialect.is_number, filled))
        if numbers >= 2 and 2 * numbers >= len(filled):
            scores[len(cells)] += numbers / len(filled)
            best = max(best, scores[len(cells)])
    return weight * best
