"""Columns of numbers out of a data frame of any make."""

import math
from decimal import Decimal
from numbers import Real
from typing import TYPE_CHECKING, Any

from .errors import InputError, listed

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


def frame_headers(df: Any, source: str | None) -> dict[str, Any]:
    """Name the columns of a frame.

    Parameters
    ----------
    df : object
        Anything with ``columns``, or with ``column_names``.
    source : str or None
        Source of the frame, for messages.

    Returns
    -------
    dict
        Name to the label by which the frame knows the column.

    Raises
    ------
    InputError
        There are no columns, or two of the same name.
    """
    # A table of pyarrow has its columns themselves under the other name. The type is asked, because a frame
    # of pandas has its columns as attributes: one may be called column_names.
    known = hasattr(df, "columns") and not hasattr(type(df), "column_names")
    columns = getattr(df, "columns" if known else "column_names", None)
    if columns is None or callable(columns):
        raise InputError(f"found a {type(df).__name__}", file=source, value=df, wanted="a data frame")
    labels = list(columns)
    headers = {str(label): label for label in labels}
    if len(headers) < len(labels):
        names = [str(label) for label in labels]
        twice = [name for name in headers if names.count(name) > 1]
        raise InputError(
            f"the frame has {listed(twice)} more than once",
            file=source,
            value=twice[0],
            wanted="a different name for each column",
        )
    return headers


def frame_numbers(series: Any, column: str, source: str | None, first: int = 0) -> "NDArray[np.float64]":
    """Read one column as numbers.

    Parameters
    ----------
    series : array_like
        Column of n numbers of any type.
    column : str
        Its name.
    source : str or None
        Source of the frame, for messages.
    first : int
        Number of the first row as its source counts.

    Returns
    -------
    (n,) ndarray
        Finite values.

    Raises
    ------
    InputError
        A value is no finite number.
    """
    import numpy as np

    array = np.asarray(series)
    if array.ndim != 1:
        raise InputError(
            f"found {array.ndim} dimensions", file=source, column=column, wanted="one number in every row"
        )
    hidden = np.ma.getmaskarray(series).ravel() if isinstance(series, np.ma.MaskedArray) else np.zeros(0)
    if hidden.any():
        raise InputError(
            "found a masked value",
            file=source,
            row=first + int(hidden.argmax()),
            column=column,
            wanted="a finite number",
        )
    if array.dtype.kind in "iuf":
        values = np.ascontiguousarray(array, dtype=np.float64)
        if np.isfinite(values).all():
            return values
    # By item, because NumPy would take the text "1.5" and the truth value True for numbers. Dates and
    # durations go as text: they are integers of some unit underneath.
    items = (array.astype(str) if array.dtype.kind in "mM" else array).tolist()
    numbers = np.empty(len(array))
    for row, item in enumerate(items):
        numbers[row] = _number(item)
        if not math.isfinite(numbers[row]):
            raise InputError(
                file=source, row=first + row, column=column, value=item, wanted="a finite number"
            )
    return numbers


def _number(item: object) -> float:
    if isinstance(item, Real | Decimal) and not isinstance(item, bool):
        try:
            return float(item)
        except (ValueError, OverflowError):
            return math.nan
    return math.nan
