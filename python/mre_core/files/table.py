"""What every reader gives: named columns, their numbers on demand, and where a row stands in the file."""

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from ..columns import recognise
from ..errors import InputError, listed
from ..frame import frame_numbers

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


class NoTableError(InputError):
    """A file holds no table of numbers at all; in a folder it is passed over."""


class NotesError(NoTableError):
    """A text without a header that is recognised and without rows of numbers: notes, no broken recording."""


class Table(ABC):
    """Columns of one recording.

    Parameters
    ----------
    source : str or None
        File, and what in it, for messages.
    headers : list of str
        Names of the columns, with the unit in brackets where the file states it elsewhere.
    name : str
        Name inside the file (sheet, group); empty where the file holds one table.
    notes : sequence of str
        What was understood about the file.
    """

    def __init__(
        self, source: str | None, headers: list[str], *, name: str = "", notes: Sequence[str] = ()
    ) -> None:
        self.source = source
        self.headers = headers
        self.name = name
        self.notes = tuple(notes)

    @abstractmethod
    def numbers(self, columns: Sequence[str]) -> dict[str, "NDArray[np.float64]"]:
        """Finite values by column; the others may hold anything. Raises InputError with the place."""

    @abstractmethod
    def place(self, row: int) -> dict[str, int]:
        """Keywords of `InputError` for a row of data, counted from 0."""


class MemoryTable(Table):
    """Columns that are in memory as they are.

    Parameters
    ----------
    columns : mapping of str to array_like
        Values by header.
    first : int
        Number of the first row as its source counts.
    """

    def __init__(
        self,
        source: str,
        columns: Mapping[str, Any],
        *,
        name: str = "",
        notes: Sequence[str] = (),
        first: int = 0,
    ) -> None:
        super().__init__(source, list(columns), name=name, notes=notes)
        self._columns = columns
        self._first = first

    def numbers(self, columns: Sequence[str]) -> dict[str, "NDArray[np.float64]"]:
        """Finite values by column."""
        return {name: frame_numbers(self._columns[name], name, self.source, self._first) for name in columns}

    def place(self, row: int) -> dict[str, int]:
        """Row of the source."""
        return {"row": self._first + row}


class ChainedTable(Table):
    """Blocks of one test, one behind the other."""

    def __init__(self, parts: Sequence[Table]) -> None:
        first = parts[0]
        notes = (*first.notes, f"{len(parts)} blocks in which time goes on: one recording")
        super().__init__(first.source, first.headers, notes=notes)
        self._parts = parts
        self._lengths: list[int] = []

    def numbers(self, columns: Sequence[str]) -> dict[str, "NDArray[np.float64]"]:
        """Finite values by column, of all blocks."""
        import numpy as np

        found = [part.numbers(columns) for part in self._parts]
        self._lengths = [len(next(iter(values.values()), ())) for values in found]
        return {name: np.concatenate([values[name] for values in found]) for name in columns}

    def place(self, row: int) -> dict[str, int]:
        """Place in the block that holds the row."""
        for part, length in zip(self._parts, self._lengths, strict=True):
            if row < length:
                return part.place(row)
            row -= length
        return {}


class EvenTable(Table):
    """A table without times, whose rows are evenly spaced.

    Parameters
    ----------
    table : Table
        With at least one more column.
    rate : float
        Rows in a second.
    """

    TIME = "time [s]"

    def __init__(self, table: Table, rate: float) -> None:
        headers = [header for header in table.headers if (recognise(header) or ("",))[0] != "time"]
        notes = (*table.notes, f"time from {rate:g} Hz")
        super().__init__(table.source, [self.TIME, *headers], name=table.name, notes=notes)
        self._table = table
        self._rate = rate

    def numbers(self, columns: Sequence[str]) -> dict[str, "NDArray[np.float64]"]:
        """Finite values by column; time from the number of rows of the others."""
        import numpy as np

        found = self._table.numbers([name for name in columns if name != self.TIME])
        rows = len(next(iter(found.values()), ()))
        return {self.TIME: np.arange(rows) / self._rate, **found}

    def place(self, row: int) -> dict[str, int]:
        """As in the table underneath."""
        return self._table.place(row)


def with_unit(name: str, unit: object) -> str:
    """Put a unit that stands apart behind a name, unless the name has it already.

    Parameters
    ----------
    name : str
        Name of a column.
    unit : object
        Text as in ``kN``, ``[kN]`` or ``(kN)``; anything else counts as none.

    Returns
    -------
    str
        Such as ``Force [kN]``.
    """
    text = unit.decode("utf-8", "replace") if isinstance(unit, bytes) else str(unit or "")
    bare = text.strip().strip("[]()").strip()
    stated = name.rstrip().rstrip("])").rstrip()
    if not bare or bare in {"-", "--", "1", "none", "None"}:
        return name
    shorter = stated.removesuffix(bare)
    if shorter != stated and shorter[-1:] in {"[", "(", "_", " ", "/", ","}:
        return name
    return f"{name.strip()} [{bare}]"


def chosen(tables: list[Table], wanted: str | None, file: str) -> list[Table]:
    """Keep the table that the user names.

    Parameters
    ----------
    tables : list of Table
        All of a file.
    wanted : str or None
        Name or number, counted from 1; None keeps all.
    file : str
        The file.

    Returns
    -------
    list of Table
        One table, or all.

    Raises
    ------
    InputError
        There is no such table.
    """
    if wanted is None:
        return tables
    named = [table for table in tables if table.name == wanted]
    if not named and wanted.isdigit() and 1 <= int(wanted) <= len(tables):
        named = [tables[int(wanted) - 1]]
    if not named:
        names = [table.name or str(i) for i, table in enumerate(tables, 1)]
        raise InputError(f"there is no table '{wanted}'", file=file, value=wanted, wanted=listed(names))
    return named[:1]
