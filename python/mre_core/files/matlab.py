"""MATLAB .mat, versions 4 to 7.3: vectors of equal length in one workspace or struct are a table."""

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Final

from ..errors import InputError
from .arrays import Series, tables_of
from .limits import check_values
from .matlab73 import series_73
from .options import ReadOptions
from .table import NoTableError, Table

_NO_NUMBERS: Final = {"cell", "char", "function", "object", "opaque", "sparse", "unknown"}
_COMPRESSED: Final = 15
"""miCOMPRESSED of the format, version 5."""


def read(path: Path, options: ReadOptions) -> list[Table]:
    """Read a .mat file: one table for each struct with data, and one for the workspace. See `readers`.

    Of vectors, matrices (a column each) and structs of them, those of equal length are a table.
    """
    file = str(path)
    with path.open("rb") as opened:
        start = opened.read(520)
    if b"\x89HDF\r\n\x1a\n" in (start[:8], start[512:520]):
        series, opaque = series_73(path)
        version = "7.3"
    else:
        series, opaque = _series(path)
        version = "4 to 7.2"
    if tables := tables_of(series, file, [f"MATLAB {version}"]):
        return tables
    if opaque:
        found = f"{opaque[0]} is a MATLAB object (table, timetable, timeseries), which only MATLAB can read"
        wanted = f"a struct: s = table2struct({opaque[0]}, 'ToScalar', true); save file.mat -struct s"
        raise NoTableError(found, file=file, wanted=wanted)
    raise NoTableError("no two vectors of one length", file=file, wanted="time, displacement and force")


def _series(path: Path) -> tuple[list[Series], list[str]]:
    file = str(path)
    import scipy.io as scipy_io  # type: ignore[import-untyped]

    try:
        check_values(_unpacked(path) // 8, file)
        shapes = scipy_io.whosmat(path)
        for name, shape, _ in shapes:
            check_values(math.prod(shape), f"{file}: variable '{name}'")
        wanted = [name for name, _, kind in shapes if kind not in _NO_NUMBERS]
        content = scipy_io.loadmat(path, squeeze_me=True, struct_as_record=False, variable_names=wanted)
    except InputError:
        raise
    except Exception as error:  # scipy has no error of its own for a broken file
        raise InputError(f"cannot be read: {error}", file=file, wanted="a whole .mat file") from None
    opaque = [str(name) for name, _, kind in shapes if kind in {"opaque", "object", "unknown"}]
    found = [
        one for name, value in content.items() if not name.startswith("__") for one in _walk("", name, value)
    ]
    return found, opaque


def _walk(folder: str, name: str, value: Any) -> Iterator[Series]:
    import numpy as np

    if hasattr(value, "_fieldnames"):
        inside = f"{folder}.{name}" if folder else name
        for field in value._fieldnames:
            yield from _walk(inside, field, getattr(value, field))
    elif isinstance(value, np.ndarray) and value.dtype == object and value.ndim == 1:
        for i, item in enumerate(value, 1):
            if hasattr(item, "_fieldnames"):
                yield from _walk(folder, f"{name}({i})", item)
    elif isinstance(value, np.ndarray) and value.dtype.kind in "iuf" and value.ndim in (1, 2):
        yield Series(folder, name, value)


def _unpacked(path: Path) -> int:
    """Add up the bytes of all variables, which are said at the beginning of each, compressed or not."""
    import struct
    import zlib

    total, length = 0, path.stat().st_size
    with path.open("rb") as opened:
        order = {b"IM": "<", b"MI": ">"}.get(opened.read(128)[126:128])
        while order and len(tag := opened.read(8)) == 8:
            kind, size = struct.unpack(f"{order}II", tag)
            following = opened.tell() + size
            if following > length:  # SciPy would read beyond what is there
                problem = "cannot be read: it ends within a variable"
                raise InputError(problem, file=str(path), wanted="a whole .mat file")
            if kind == _COMPRESSED:
                inside = zlib.decompressobj().decompress(opened.read(min(size, 1024)), 8)
                size = struct.unpack(f"{order}II", inside)[1] if len(inside) == 8 else size
            total += size
            opened.seek(following)
    return total
