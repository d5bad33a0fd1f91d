"""Excel workbooks (.xlsx, .xlsm, .xls): every sheet with numbers is a table."""

from contextlib import closing
from pathlib import Path
from typing import Any, Final

from ..errors import InputError, listed
from .arrays import readable
from .dialect import Dialect
from .extras import need
from .layout import Rows, find_block
from .limits import check_archive, check_sheet, check_values
from .options import ReadOptions
from .table import MemoryTable, NoTableError, Table

_DIALECT: Final = Dialect("\t", ".")


def read(path: Path, options: ReadOptions) -> list[Table]:
    """Read a workbook: one table for each sheet with numbers. See `readers` for what all readers share.

    A sheet may have a preamble and a row of units; formulas count with the value that was saved.
    """
    file = str(path)
    sheets = _old_sheets(path, file) if path.suffix.lower() == ".xls" else _sheets(path, file)
    found = [table for name, sheet in sheets.items() if (table := _table(sheet, str(name), file, options))]
    if not found:
        names = [str(name) for name in sheets]
        raise NoTableError(f"no numbers in the sheets {listed(names)}", file=file, wanted="rows of numbers")
    if len(found) == 1:
        found[0].name = ""
    return found


def _sheets(path: Path, file: str) -> dict[str, Any]:
    openpyxl = need("openpyxl", "excel", file=file)
    check_archive(path)
    try:
        # Opened here, because openpyxl leaves a broken file open.
        with (
            path.open("rb") as raw,
            closing(openpyxl.load_workbook(raw, read_only=True, data_only=True, keep_links=False)) as book,
        ):
            return {str(sheet.title): _grid(sheet, file) for sheet in book.worksheets}
    except InputError:
        raise
    except Exception as error:  # openpyxl lets pass those of zip, XML and its own
        raise _broken(error, file) from None


def _grid(sheet: Any, file: str) -> Any:
    """Read the cells of a sheet, and stop where there are more than a sheet of numbers has."""
    import numpy as np

    sheet.reset_dimensions()  # what a file says of them need not be true
    rows: list[Any] = []
    count = 0
    for row in sheet.iter_rows(values_only=True):
        count += len(row)
        check_sheet(len(rows) + 1, len(row), count, file)
        rows.append(row)
    grid = np.full((len(rows), max(map(len, rows), default=0)), None, dtype=object)
    for cells, row in zip(grid, rows, strict=True):
        cells[: len(row)] = row
    return grid


def _old_sheets(path: Path, file: str) -> dict[str, Any]:
    import io

    import numpy as np

    xlrd = need("xlrd", "excel", file=file)

    def value(cell: Any, mode: int) -> Any:
        if cell.ctype == xlrd.XL_CELL_DATE:
            return xlrd.xldate_as_datetime(cell.value, mode)
        return cell.value if cell.ctype in (xlrd.XL_CELL_NUMBER, xlrd.XL_CELL_TEXT) else None

    try:
        book = xlrd.open_workbook(path, logfile=io.StringIO())
        found = {}
        for sheet in book.sheets():
            check_values(sheet.nrows * sheet.ncols, file)
            grid = np.empty((sheet.nrows, sheet.ncols), dtype=object)
            for i in range(sheet.nrows):
                cells = [value(cell, book.datemode) for cell in sheet.row(i)]
                grid[i, : len(cells)] = cells
            found[str(sheet.name)] = grid
    except InputError:
        raise
    except Exception as error:  # xlrd trips over a broken file anywhere
        raise _broken(error, file) from None
    return found


def _broken(error: Exception, file: str) -> InputError:
    return InputError(f"cannot be read: {error}", file=file, wanted="a whole workbook")


def _table(grid: Any, name: str, file: str, options: ReadOptions) -> Table | None:
    check_values(grid.size, file)
    texts: dict[int, list[str]] = {}

    def cells(i: int) -> list[str]:
        if i not in texts:
            texts[i] = [_text(value) for value in grid[i]]
        return texts[i]

    rows = Rows(len(grid), cells, _DIALECT.is_number, lambda i, _: cells(i))
    block = find_block(rows, None if options.header is None else min(options.header, len(grid)) - 1)
    if block is None:
        return None
    data = [i for i in range(block.first, block.stop) if any(cells(i))]
    while data and not rows.has_numbers(data[-1]):
        data.pop()
    if not any(rows.is_data(i) or rows.has_numbers(i) for i in data[:3]):
        return None
    first, last = data[0], data[-1]
    headers = [name.replace("\n", " ") for name in block.headers]
    columns: dict[str, Any] = {}
    for place, header in enumerate(headers):
        if header and header not in columns:
            columns.update([readable(header, _numeric(grid[first : last + 1, place]))])
    notes = [f"sheet '{name}'"]
    notes.append(
        "no header: columns are numbered" if block.header is None else f"header in row {block.header + 1}"
    )
    if block.units is not None:
        notes.append(f"units in row {block.units + 1}")
    # As numbered in the sheet.
    return MemoryTable(f"{file}: sheet '{name}'", columns, name=name, notes=notes, first=first + 1)


def _numeric(values: Any) -> Any:
    """Numbers where all cells are; a number that is saved as text counts as one."""
    import numpy as np

    if all(isinstance(value, int | float) and not isinstance(value, bool) for value in values):
        return values.astype(float)
    if any(isinstance(value, str) for value in values):
        dialects = (Dialect("\t", "."), Dialect("\t", ","))
        for dialect in dialects:
            if all(not isinstance(v, str) or dialect.is_number(v) for v in values):
                return np.array([dialect.to_float(v) if isinstance(v, str) else v for v in values])
    return values


def _text(value: object) -> str:
    return "" if value is None or value != value else str(value).strip()
