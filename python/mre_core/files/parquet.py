"""Parquet: one table; the unit of a column may stand in the metadata of its field."""

from pathlib import Path
from typing import Any, Final

from ..errors import InputError
from .arrays import readable
from .limits import check_values
from .options import ReadOptions
from .table import MemoryTable, NoTableError, Table, with_unit

_UNIT_KEYS: Final = (b"unit", b"units", b"Unit", b"Units")


def read(path: Path, options: ReadOptions) -> list[Table]:
    """Read a Parquet file, which is one table. See `readers` for what all readers share."""
    file = str(path)
    import pyarrow as arrow
    import pyarrow.parquet as parquet

    try:
        # Text stays as a dictionary: a file of some kB can repeat a long one a million times.
        texts = [field.name for field in parquet.read_schema(path) if _is_text(arrow, field.type)]
        with parquet.ParquetFile(path, read_dictionary=texts) as opened:
            check_values(_count(opened.metadata), file)
            table = opened.read()
    except InputError:
        raise
    except (arrow.ArrowException, OSError, ValueError) as error:  # also names that are no text
        raise InputError(f"cannot be read: {error}", file=file, wanted="a whole Parquet file") from None
    if not table.num_rows:
        raise NoTableError("has no rows", file=file, wanted="rows of numbers")
    columns: dict[str, Any] = {}
    for field, column in zip(table.schema, table.columns, strict=True):
        header = with_unit(field.name, _unit(field.metadata))
        if header in columns:
            raise InputError(
                f"has the column '{header}' twice", file=file, wanted="a different name for each"
            )
        columns.update([readable(header, column.to_numpy())])
    return [MemoryTable(file, columns, notes=["Parquet"])]


def _is_text(arrow: Any, kind: Any) -> bool:
    types = arrow.types
    return any(test(kind) for test in (types.is_string, types.is_large_string, types.is_binary))


def _count(metadata: Any) -> int:
    """Values in all columns, those in lists included."""
    groups = [metadata.row_group(i) for i in range(metadata.num_row_groups)]
    counts = [group.column(j).num_values for group in groups for j in range(group.num_columns)]
    return int(max(sum(counts), metadata.num_rows * metadata.num_columns))


def _unit(metadata: Any) -> object:
    return next((metadata[key] for key in _UNIT_KEYS if metadata and key in metadata), None)
