"""Times of day and dates, as seconds from the first one."""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


def seconds(values: Any) -> "NDArray[np.float64] | None":
    """Convert dates, durations or times of day.

    Parameters
    ----------
    values : array_like
        Column of n values.

    Returns
    -------
    (n,) ndarray or None
        Seconds from the first value; None where the values are anything else.
    """
    import datetime

    import numpy as np
    import pandas as pd

    array = np.asarray(values)
    first = array.ravel()[0] if array.size else None
    if isinstance(first, datetime.time):
        midnight = datetime.datetime.min
        if not all(isinstance(item, datetime.time) for item in array):
            return None
        array = np.array([datetime.datetime.combine(midnight, item) - midnight for item in array])
        first = array[0]
    if array.dtype.kind not in "mM" and not isinstance(first, datetime.datetime | datetime.timedelta):
        return None
    index = pd.Index(array)
    if not isinstance(index, pd.DatetimeIndex | pd.TimedeltaIndex) or index.hasnans:
        return None
    # Whole microseconds keep every digit of a clock, which a float of days would not.
    step = np.asarray(index - index[0]).astype("timedelta64[ns]").astype(np.int64)
    return np.asarray(step, dtype=np.float64) / 1e9
