"""Recordings out of data frames of any make."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from ._core import Recording
from .checks import check_text
from .conditions import read_conditions
from .files.table import Table
from .frame import frame_headers, frame_numbers
from .tabled import columns_of, recording_of

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


def from_dataframe(
    df: Any,
    map: Mapping[str, str] | None = None,
    *,
    name: str = "",
    require_force: bool = True,
    **conditions: float | str | None,
) -> Recording:
    """Make a recording from a data frame.

    Parameters
    ----------
    df : pandas.DataFrame or alike
        Anything with ``columns`` and ``df[column]``, where a column converts to a NumPy array of n
        numbers. Columns are recognised and converted as by `load`.
    map : mapping of str to str, optional
        Role to ``column`` or ``column[unit]``, as in `load`.
    name : str
        Name of the recording.
    require_force : bool
        False leaves the force unread, for a simulation.
    **conditions : float or str
        ``current`` (A) or ``temperature`` (degC) of the whole recording, as in `load`.

    Returns
    -------
    Recording
        The recording, in canonical units.

    Raises
    ------
    InputError
        The name, a column, a unit, a value or a condition is not usable. Rows are counted from 0.

    Warns
    -----
    UnitAssumedWarning
        A column states no unit, so the canonical one is taken.
    """
    check_text(name, "name")
    source = f"recording '{name}'" if name else None
    fixed = read_conditions(conditions, file=source)
    table = _FrameTable(df, source)
    columns = columns_of(table, map, fixed, require_force=require_force)
    return recording_of(table, columns, fixed, name, stacklevel=2)


class _FrameTable(Table):
    """Columns of a data frame of any make."""

    def __init__(self, df: Any, source: str | None) -> None:
        self._labels = frame_headers(df, source)
        self._df = df
        super().__init__(source, list(self._labels))

    def numbers(self, columns: Sequence[str]) -> "dict[str, NDArray[np.float64]]":
        return {name: frame_numbers(self._df[self._labels[name]], name, self.source) for name in columns}

    def place(self, row: int) -> dict[str, int]:
        return {"row": row}
