"""JSON that somebody else may have written: read within limits, and its numbers checked."""

import json
import math
import os
import re
from collections.abc import Mapping
from numbers import Real
from pathlib import Path
from typing import Any, Final

from .errors import InputError, shown

LARGEST_FILE: Final = 50_000_000
"""Bytes; a model with every effect of the catalogue has some thousands."""

_HALF: Final = re.compile(rb"\\u[dD][89a-fA-F]")
"""An escape that stands for half of a character, which is no text where the other half is missing."""
_KINDS: Final = {
    dict: "entries in braces",
    list: "a list",
    str: "a text",
    float: "a finite number",
    int: "a whole number",
    bool: "true or false",
}
_INSTANCES: Final[Any] = {dict: Mapping, list: list | tuple}
_LARGEST: Final = 1e300


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
        found = json.loads(content)
        if _HALF.search(content):
            json.dumps(found, ensure_ascii=False).encode()
    except RecursionError:
        raise InputError("is not JSON: it is nested too deeply", file=file) from None
    except UnicodeEncodeError:
        raise InputError("holds half of a character, such as \\ud800", file=file, wanted="text") from None
    except ValueError as error:
        raise InputError(f"is not JSON: {error}", file=file) from None
    return found


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
    except ValueError:
        raise InputError("cannot be read: its name holds a null byte", file=str(path)) from None
    if len(content) > most:
        raise InputError(f"has more than {most} bytes", file=str(path), wanted="a smaller file")
    return content


def conform(content: Any, shape: Any, file: str, place: str = "") -> None:
    """See that content has a shape.

    Parameters
    ----------
    content : object
        What stands in the file.
    shape : object
        ``str``, ``bool``, ``int``, or ``float`` for any finite number; a list of one shape for any number of
        such; a mapping of keys to shapes, others may be there, or of ``"*"`` to the shape of all entries; a
        tuple of one shape that may be missing or null.
    file : str
        The file, for messages.
    place : str
        Where in it; empty for the whole.

    Raises
    ------
    InputError
        Something is missing or of another kind.
    """
    if isinstance(shape, tuple):
        if content is not None:
            conform(content, shape[0], file, place)
        return
    here = place or "the content"
    kind = type(shape) if isinstance(shape, dict | list) else shape
    if not _is(content, kind):
        raise InputError(f"{here} is {shown(content)}", file=file, wanted=_KINDS[kind])
    if isinstance(shape, list):
        for at, one in enumerate(content):
            conform(one, shape[0], file, f"{place}[{at}]")
    elif isinstance(shape, dict):
        for key in content if "*" in shape else shape:
            inner = shape.get(key, shape.get("*"))
            if key not in content and not isinstance(inner, tuple):
                raise InputError(f"{here} has no {shown(key)}", file=file, wanted=", ".join(shape))
            conform(content.get(key), inner, file, f"{key} of {place}" if place else str(key))


def _is(content: Any, kind: type) -> bool:
    if kind in (int, float) and isinstance(content, bool):
        return False
    if kind is float:
        return isinstance(content, int | float) and abs(content) < _LARGEST
    return isinstance(content, _INSTANCES.get(kind, kind))


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
