"""JSON that somebody else may have written: read within limits, and its numbers checked."""

import json
import math
import os
from numbers import Real
from pathlib import Path
from typing import Any, Final

from .errors import InputError, shown

LARGEST_FILE: Final = 50_000_000
"""Bytes; a model with every effect of the catalogue has some thousands."""


def read_json(path: str | os.PathLike[str]) -> Any:
    """Read a JSON file of a sensible size.

    Parameters
    ----------
    path : str or path-like
        The file.

    Returns
    -------
    object
        Its content.

    Raises
    ------
    InputError
        It is missing, not readable, too large, or no JSON.
    """
    file = str(path)
    content = read_limited(path, LARGEST_FILE)
    try:
        return json.loads(content)
    except RecursionError:
        raise InputError("is not JSON: it is nested too deeply", file=file) from None
    except ValueError as error:
        raise InputError(f"is not JSON: {error}", file=file) from None


def read_limited(path: str | os.PathLike[str], most: int) -> bytes:
    """Read a whole file that has at most so many bytes, whatever its folder says of its size.

    Raises
    ------
    InputError
        It is missing, not readable, or has more.
    """
    try:
        with Path(path).open("rb") as stream:
            content = stream.read(most + 1)
    except OSError as error:
        raise InputError(f"cannot be read: {error.strerror}", file=str(path)) from None
    if len(content) > most:
        raise InputError(f"has more than {most} bytes", file=str(path), wanted="a smaller file")
    return content


def number(value: object, name: str, *, least: float = -math.inf) -> float:
    """Take a number out of such a file.

    Parameters
    ----------
    value : object
        What stands there.
    name : str
        What it is, for messages.
    least : float
        Smallest value that it may have.

    Returns
    -------
    float
        Finite.

    Raises
    ------
    InputError
        It is no number, a truth value, not finite, or too small.
    """
    wanted = "a finite number" + (f" from {least:g}" if math.isfinite(least) else "")
    if isinstance(value, Real) and not isinstance(value, bool):
        try:
            found = float(value)
        except OverflowError:
            found = math.inf
        if math.isfinite(found) and found >= least:
            return found
    raise InputError(f"{name} is {shown(value)}", value=value, wanted=wanted)
