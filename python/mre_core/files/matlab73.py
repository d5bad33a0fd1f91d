"""MATLAB 7.3: HDF5 underneath, with matrices turned around and structs as groups."""

from pathlib import Path
from typing import Any, Final

from ..errors import InputError
from .arrays import Series
from .extras import need
from .limits import check_own, check_values

_NUMBERS: Final = {
    b"double",
    b"single",
    *(f"{sign}int{bits}".encode() for sign in ("", "u") for bits in (8, 16, 32, 64)),
}


def series_73(path: Path) -> tuple[list[Series], list[str]]:
    """Read the arrays of a file.

    Parameters
    ----------
    path : Path
        The file.

    Returns
    -------
    (series, opaque) : tuple of list
        Arrays, and names of MATLAB objects, which cannot be read.

    Raises
    ------
    InputError
        The file cannot be read.
    """
    file = str(path)
    h5py = need("h5py", "mat", file=file)
    series: list[Series] = []
    opaque: list[str] = []

    def read(folder: str, name: str, item: Any) -> None:
        kind = bytes(item.attrs.get("MATLAB_class", b""))
        inside = f"{folder}.{name}" if folder else name
        if isinstance(item, h5py.Group):
            if "MATLAB_object_decode" not in item.attrs:
                walk(inside, item)
        elif "MATLAB_object_decode" in item.attrs or (kind and kind not in _NUMBERS):
            if kind == b"struct" and item.dtype == object:
                return
            if "MATLAB_object_decode" in item.attrs:
                opaque.append(inside)
        elif "MATLAB_empty" in item.attrs:
            return
        elif item.dtype == h5py.ref_dtype:
            for i, reference in enumerate(item[()].ravel(), 1):  # one field of an array of structs
                read(f"{folder}({i})", name, item.file[reference])
        elif item.dtype.kind in "iuf" and item.ndim in (1, 2):
            check_own(item, file)
            check_values(sum(one.values.nbytes for one in series) // 8 + item.nbytes // 8, file)
            series.append(Series(folder, name, item[()].T))

    def walk(folder: str, group: Any) -> None:
        for name, item in group.items():
            if not name.startswith("#") and isinstance(group.get(name, getlink=True), h5py.HardLink):
                read(folder, name, item)

    try:
        with h5py.File(path, "r") as opened:
            walk("", opened)
    except InputError:
        raise
    except Exception as error:  # h5py has none of its own, and many for types that NumPy has not
        raise InputError(f"cannot be read: {error}", file=file, wanted="a whole .mat file") from None
    return series, opaque
