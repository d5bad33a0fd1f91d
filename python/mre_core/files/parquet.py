"""Parquet: one table; the unit of a column may stand in the metadata of its field."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any, Final

from ..errors import InputError, shown
from .arrays import readable
from .limits import check_values
from .options import ReadOptions
from .table import MemoryTable, NoTableError, Table, with_unit

_UNIT_KEYS: Final = (b"unit", b"units", b"Unit", b"Units")
_ROWS: Final = 1 << 18
"""Rows that are read together."""


def read(path: Path, options: ReadOptions) -> list[Table]:
    """Read a Parquet file, which is one table. See `readers` for what all readers share."""
    file = str(path)
    import pyarrow as arrow
    import pyarrow.parquet as parquet

    try:
        # Text stays as a dictionary: a file of some kB can repeat a long one a million times.
        schema = parquet.read_schema(path)
        texts = [field.name for field in schema if _is_text(arrow, field.type)]
        nested = [field.name for field in schema if arrow.types.is_nested(field.type)]
        flat = [name for name in schema.names if name not in nested] if nested else None
        with parquet.ParquetFile(path, read_dictionary=texts) as opened:
            batches = list(_batches(opened, flat, file))
    except InputError:
        raise
    except (arrow.ArrowException, OSError, ValueError) as error:  # also names that are no text
        raise InputError(f"cannot be read: {error}", file=file, wanted="a whole Parquet file") from None
    if not batches:
        raise NoTableError("has no rows", file=file, wanted="rows of numbers")
    table = arrow.Table.from_batches(batches)
    columns: dict[str, Any] = {}
    for field, column in zip(table.schema, table.columns, strict=True):
        header = with_unit(field.name, _unit(field.metadata))
        if header in columns:
            raise InputError(
                f"has the column '{header}' twice", file=file, wanted="a different name for each"
            )
        columns.update([readable(header, column.to_numpy())])
    notes = [f"column {shown(name)} holds lists or records, which are not read" for name in nested]
    return [MemoryTable(file, columns, notes=["Parquet", *notes])]


def _is_text(arrow: Any, kind: Any) -> bool:
    types = arrow.types
    return any(test(kind) for test in (types.is_string, types.is_large_string, types.is_binary))


def _batches(opened: Any, columns: list[str] | None, file: str) -> Iterator[Any]:
    """Read some rows at a time: what the file says of its size need not be true.

    What it says of the parts of a column is not asked for: where that is damaged, asking ends the process.
    """
    check_values(opened.metadata.num_rows * opened.metadata.num_columns, file)
    count = 0
    for batch in opened.iter_batches(_ROWS, columns=columns):
        count += batch.num_rows * batch.num_columns
        check_values(count, file)
        yield batch


def _unit(metadata: Any) -> object:
    return next((metadata[key] for key in _UNIT_KEYS if metadata and key in metadata), None)
