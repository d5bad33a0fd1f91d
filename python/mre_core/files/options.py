"""What a user can say about a file that is not read as it should be."""

import codecs
import math
from collections.abc import Callable, Mapping
from typing import Any, Final, NamedTuple

from ..errors import InputError, mapping

SEPARATORS: Final = {"comma": ",", "semicolon": ";", "tab": "\t", "bar": "|", "blank": ""}
_SIGNS: Final = {",": ",", ";": ";", "\t": "\t", "\\t": "\t", "|": "|", " ": ""} | SEPARATORS


class ReadOptions(NamedTuple):
    """How to read a file; None where that is found out."""

    encoding: str | None = None
    separator: str | None = None
    """One of the values of `SEPARATORS`; the empty text stands for runs of blanks."""
    decimal: str | None = None
    header: int | None = None
    """Line or row of the header, counted from 1."""
    table: str | None = None
    """Name of a sheet, a group or a struct, or the number of a block."""
    rate: float | None = None
    """Samples in a second, where there is no column for time."""

    @classmethod
    def of(cls, given: Mapping[str, object] | None) -> "ReadOptions":
        """Check texts such as ``decimal=,``.

        Parameters
        ----------
        given : mapping of str to object, or None
            ``encoding`` (such as gbk), ``separator`` (comma, semicolon, tab, bar or blank), ``decimal`` (a
            point or a comma), ``header`` (line, from 1), ``table`` (name of a sheet or group, number of a
            block), ``rate`` (Hz, in place of a column for time).

        Returns
        -------
        ReadOptions
            The options.

        Raises
        ------
        InputError
            Another key, or a value that is not usable.
        """
        options = mapping("read", given, "key to value")
        for key in options:
            if key not in _READ:
                raise InputError(f"read names '{key}'", value=key, wanted=f"one of {', '.join(_READ)}")
        return cls(**{key: _READ[key](str(value)) for key, value in options.items()})


def _encoding(text: str) -> str:
    try:
        return codecs.lookup(text.strip()).name
    except (LookupError, ValueError):
        raise _wrong("encoding", text, "the name of one, such as utf-8, cp1252, gbk or utf-16") from None


def _separator(text: str) -> str:
    if text.lower() in _SIGNS:
        return _SIGNS[text.lower()]
    raise _wrong("separator", text, ", ".join(SEPARATORS))


def _decimal(text: str) -> str:
    sign = {"point": ".", "comma": ","}.get(text.strip().lower(), text.strip())
    if sign in (".", ","):
        return sign
    raise _wrong("decimal", text, "point or comma")


def _header(text: str) -> int:
    if text.strip().isascii() and text.strip().isdigit() and 1 <= int(text) < 10**9:
        return int(text)
    raise _wrong("header", text, "the line of the header, counted from 1")


def _rate(text: str) -> float:
    number = text.strip().removesuffix("[Hz]").removesuffix("Hz")
    try:
        rate = float(number)
    except ValueError:
        rate = math.nan
    if not (math.isfinite(rate) and rate > 0):
        raise _wrong("rate", text, "samples in a second, above 0")
    return rate


def _wrong(key: str, text: str, wanted: str) -> InputError:
    return InputError(f"read {key} is '{text}'", value=text, wanted=wanted)


_READ: Final[dict[str, Callable[[str], Any]]] = {
    "encoding": _encoding,
    "separator": _separator,
    "decimal": _decimal,
    "header": _header,
    "table": str.strip,
    "rate": _rate,
}
