"""HDF5: datasets of equal length in one group are a table; units from the attribute ``units`` or ``unit``."""

from pathlib import Path
from typing import Any, Final

from ..errors import InputError
from .arrays import Series, tables_of
from .extras import need
from .limits import check_own, check_values
from .options import ReadOptions
from .table import NoTableError, Table

_UNIT_KEYS: Final = ("units", "unit", "Units", "Unit")


def read(path: Path, options: ReadOptions) -> list[Table]:
    """Read an HDF5 file: one table for each group with datasets of equal length. See `readers`."""
    file = str(path)
    h5py = need("h5py", "hdf5", file=file)
    series: list[Series] = []

    def visit(name: str, item: Any) -> None:
        if not isinstance(item, h5py.Dataset) or item.ndim not in (1, 2) or item.dtype.kind not in "iufV":
            return
        folder, _, last = name.rpartition("/")
        check_own(item, file)
        check_values(sum(one.values.nbytes for one in series) // 8 + item.nbytes // 8, file)
        unit = next((item.attrs[key] for key in _UNIT_KEYS if key in item.attrs), None)
        series.append(Series(folder, last, item[()], unit))

    try:
        with h5py.File(path, "r") as opened:
            opened.visititems(visit)
    except InputError:
        raise
    except Exception as error:  # h5py has none of its own, and many for types that NumPy has not
        raise InputError(f"cannot be read: {error}", file=file, wanted="a whole HDF5 file") from None
    if tables := tables_of(series, file, ["HDF5"]):
        return tables
    raise NoTableError(
        "no group with two datasets of one length", file=file, wanted="time, displacement, force"
    )
