"""CSV, TXT and other text: preamble, header, units, numbers; one block or several."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Final

from ..columns import split_unit
from ..errors import InputError, listed
from .cells import Cells, line_of, read_clock, read_numbers
from .clock import is_clock
from .dialect import Dialect, find_dialect
from .encoding import decode
from .layout import Block, Rows, find_block
from .limits import MOST_COLUMNS, read_bytes
from .options import ReadOptions
from .table import NoTableError, NotesError, Table

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

_LONGEST_FOOTER: Final = 50
_EXAMPLE: Final = "time_s,displacement_mm,force_N"


class TextTable(Table):
    """A block of a text file."""

    def __init__(self, cells: Cells, *, name: str = "", notes: Sequence[str] = ()) -> None:
        first = next((line for line in cells.body if line.strip()), "")
        clocks = [
            header
            for header, cell in zip(cells.headers, cells.dialect.cells(first), strict=False)
            if is_clock(cell)
        ]
        self._clocks = {f"{split_unit(header)[0]} [s]": header for header in clocks if header}
        named = {header: shown for shown, header in self._clocks.items()}
        told = [f"'{header}' holds times of day: seconds from the first" for header in named]
        headers = [named.get(header, header) for header in cells.headers]
        super().__init__(cells.file, headers, name=name, notes=[*notes, *told])
        self._cells = cells._replace(headers=headers)

    def numbers(self, columns: Sequence[str]) -> dict[str, "NDArray[np.float64]"]:
        """Finite values by column."""
        plain = [name for name in columns if name not in self._clocks]
        clocks = [name for name in columns if name in self._clocks]
        found = read_numbers(self._cells, plain) if plain else {}
        return found | {name: read_clock(self._cells, name) for name in clocks}

    def place(self, row: int) -> dict[str, int]:
        """Line of the file."""
        return {"line": line_of(self._cells, row)}


def read(path: Path, options: ReadOptions) -> list[Table]:
    """Read a text file: one table for each block. See `readers` for what all readers share.

    Text is in any of the usual encodings, with columns between commas, semicolons, tabs, bars or blanks.
    Lines before the header are passed over, ``#`` lines too; below it there may be a row of units. The
    header may come again, with another block of data.
    """
    file = str(path)
    data = read_bytes(path)
    if not data.strip():
        raise NoTableError("the file is empty", file=file, wanted=f"a header such as {_EXAMPLE} and data")
    text, encoding = decode(data, file, options.encoding)
    lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
    block, rows, dialect = find_table(lines, file, options)
    blocks = _split(lines, rows, block)
    notes = [f"text in {encoding}", str(dialect), *_notes(block)]
    tables: list[Table] = []
    for i, one in enumerate(blocks, 1):
        _check(one, rows, lines, file)
        cells = Cells(file, one.headers, lines[one.first : one.stop], one.first + 1, dialect)
        tables.append(TextTable(cells, name=str(i) if len(blocks) > 1 else "", notes=notes))
    return tables


def find_table(
    lines: list[str],
    file: str,
    options: ReadOptions = ReadOptions(),  # noqa: B008  # immutable
) -> tuple[Block, Rows, Dialect]:
    """Find the first table in lines of text.

    Parameters
    ----------
    lines : list of str
        The file, or its beginning.
    file : str
        Its name.
    options : ReadOptions
        What the user has said about it.

    Returns
    -------
    (block, rows, dialect) : tuple
        Where the table is, and how the lines are cut.

    Raises
    ------
    InputError
        There is none.
    """
    dialect = find_dialect(lines, options)
    rows = _rows(lines, dialect)
    if options.header is not None and options.header > len(lines):
        raise InputError(f"has {len(lines)} lines", file=file, wanted=f"a header in line {options.header}")
    block = find_block(rows, None if options.header is None else options.header - 1)
    if block is None:
        raise NotesError("no rows of numbers", file=file, wanted=f"a header such as {_EXAMPLE} and data")
    _check_width(block, rows, lines, file, dialect)
    return block, rows, dialect


def _rows(lines: list[str], dialect: Dialect) -> Rows:
    """Rows of cells; those that no table has are not looked at: a preamble may have a million."""

    def cells(i: int) -> list[str]:
        return dialect.cells(lines[i])[: MOST_COLUMNS + 1]

    def names(i: int, width: int) -> list[str]:
        return dialect.names(lines[i].lstrip().removeprefix("#"), width)[: MOST_COLUMNS + 1]

    return Rows(len(lines), cells, dialect.is_number, names)


def _check_width(block: Block, rows: Rows, lines: list[str], file: str, dialect: Dialect) -> None:
    """Refuse a table wider than any rig writes; what stands around it may be as wide as it likes."""
    data = (i for i in range(block.first, block.stop) if len(lines[i]) > MOST_COLUMNS and rows.is_data(i))
    for i in data if block.header is None else (block.header, *data):
        if (width := len(dialect.cells(lines[i]))) > MOST_COLUMNS:
            wanted = f"at most {MOST_COLUMNS} columns"
            raise InputError(f"has {width} columns", file=file, line=i + 1, wanted=wanted)


def _notes(block: Block) -> list[str]:
    if block.header is None:
        return ["no header: columns are numbered"]
    notes = [f"header in line {block.header + 1}"]
    if block.units is not None:
        notes.append(f"units in line {block.units + 1}")
    return notes


def _split(lines: list[str], rows: Rows, block: Block) -> list[Block]:
    """Cut where the header comes again; lines of text above it are the preamble of what follows."""
    tail = rows.content(max(block.first, rows.length - _LONGEST_FOOTER), rows.length)
    end = 1 + max((i for i in tail if rows.has_numbers(i)), default=rows.length - 1)
    if any('"' in line for line in lines[end:]):  # the rest of a cell that goes over several lines
        end = rows.length
    if block.header is None:
        return [block._replace(stop=end)]
    head = lines[block.header].strip()
    again = [i for i in range(block.first, end) if lines[i].strip() == head]
    blocks = []
    for header, following in zip([block.header, *again], [*again, None], strict=True):
        shift = header - block.header
        stop = end
        if following is not None:
            stop = following
            while stop > block.first + shift and not rows.begins_with_number(stop - 1):
                stop -= 1
        units = lines[block.units] if block.units is not None else ""
        same = not units or [units] == lines[(block.units or 0) + shift :][:1]
        first = block.first + shift if same else header + 1
        blocks.append(block._replace(header=header, first=first, stop=stop))
    return blocks


def _check(block: Block, rows: Rows, lines: list[str], file: str) -> None:
    """Refuse a header that is none, and one without data."""
    if block.header is None:
        return
    line = block.header + 1
    if lines[block.header].count('"') % 2:
        problem = "header cannot be read: a quotation mark is not closed"
        raise InputError(problem, file=file, line=line, wanted=_EXAMPLE)
    names = [name for name in block.headers if name]
    twice = [name for name in dict.fromkeys(names) if names.count(name) > 1]
    if twice:
        found = f"header has {listed(twice)} more than once"
        wanted = "a different name for each column"
        raise InputError(found, file=file, line=line, value=twice[0], wanted=wanted)
    if next(rows.content(block.first, block.stop), None) is None:
        wanted = "rows of numbers below it"
        raise NoTableError("a header but no data", file=file, line=line, wanted=wanted)
