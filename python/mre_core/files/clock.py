"""Times of day and dates, as seconds from the first one."""

import re
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


_CLOCK: Final = re.compile(
    r"(?:(?P<date>\d{4}-\d\d-\d\d|\d{4}/\d\d?/\d\d?|\d\d?[./]\d\d?[./]\d{4})[T ]+)?"
    r"(?P<hour>\d\d?):(?P<minute>\d\d)(?::(?P<second>\d\d(?:[.,]\d+)?))?(?: ?(?P<half>[AaPp])[Mm])?"
)


def is_clock(text: str) -> bool:
    """Tell a time of day, with or without a date, from any other text."""
    return _CLOCK.fullmatch(text) is not None


def seconds_of_texts(texts: Sequence[str]) -> "NDArray[np.float64]":
    """Convert times of day.

    Parameters
    ----------
    texts : sequence of str
        Such as ``10:31:05,123`` or ``21.11.2026 10:31:05.123``.

    Returns
    -------
    (n,) ndarray
        Seconds from the first one; NaN for what is no time of day.
    """
    import numpy as np
    import pandas as pd

    matches = [_CLOCK.fullmatch(text) for text in texts]
    dates = {match["date"] for match in matches if match}
    # A single date does not matter, and in what order its parts stand is not known.
    days = {date: 0.0 for date in dates}
    if len(dates) > 1:
        known = {date: pd.Timestamp(pd.to_datetime(date, dayfirst="." in date)) for date in dates if date}
        earliest = min(known.values())
        days |= {date: float((day - earliest).days) for date, day in known.items()}
    found = np.full(len(texts), np.nan)
    for i, match in enumerate(matches):
        if match:
            second = float((match["second"] or "0").replace(",", "."))
            hour = int(match["hour"]) % (12 if match["half"] else 24) + 12 * ((match["half"] or "a") in "pP")
            found[i] = 86400 * days[match["date"]] + 3600 * hour + 60 * int(match["minute"]) + second
    # Exact to the microsecond, where the file is.
    return np.asarray(np.round(found - found[0], 9))


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
