"""Errors and warnings about what a user hands in: one line each."""

from collections.abc import Mapping
from typing import Any
from unicodedata import category

from ._core import MreError

__all__ = [
    "CopyWarning",
    "ExtrapolationWarning",
    "InputError",
    "MreError",
    "SkippedWarning",
    "UnitAssumedWarning",
    "VelocityWarning",
]

_LONGEST = 2000
_LONGEST_VALUE = 60
_UNSEEN = ("Cc", "Cf", "Cs", "Co", "Cn")
"""Unicode categories: control, format, surrogate, private, not assigned."""


class UnitAssumedWarning(UserWarning):
    """A column states no unit, so the canonical one is taken."""


class SkippedWarning(UserWarning):
    """A file of a folder, or a table of a file, holds no recording and is passed over."""


class CopyWarning(UserWarning):
    """A recording holds what another one holds, under another name, current or temperature."""


class VelocityWarning(UserWarning):
    """A recorded velocity is no slope of the displacement, and a derived one fits better."""


class ExtrapolationWarning(UserWarning):
    """A simulation leaves the range in which the model was identified."""


class InputError(MreError):
    """An input cannot be used; the text is one line saying where, what was found and what was wanted.

    Parameters
    ----------
    problem : str, optional
        What is wrong. Without it the text says which `value` was found.
    file : str, optional
        File, or whatever else names the source of the data.
    line : int, optional
        Line of the file, counted from 1 as in a text editor.
    row : int, optional
        Row of a table, counted as its source counts: from 0 in memory, from 1 in a spreadsheet.
    column : str, optional
        Column as written in the header.
    value : object, optional
        The value found.
    wanted : str, optional
        What would have been right.
    """

    def __init__(
        self,
        problem: str = "",
        *,
        file: str | None = None,
        line: int | None = None,
        row: int | None = None,
        column: str | None = None,
        value: Any = None,
        wanted: str | None = None,
    ) -> None:
        self.file = file
        self.line = line
        self.row = row
        self.column = column
        self.value = value
        self.wanted = wanted
        spot = [
            f"line {line}" if line is not None else "",
            f"row {row}" if row is not None else "",
            f"column {shown(column)}" if column is not None else "",
        ]
        what = problem or f"found {shown(value)}"
        if wanted:
            what += f", wanted {wanted}"
        parts = [file or "", ", ".join(filter(None, spot)), what]
        super().__init__(one_line(": ".join(filter(None, parts))))


def one_line(text: str) -> str:
    """Join the lines of a text, and replace what a terminal would obey instead of showing.

    Parameters
    ----------
    text : str
        Any text, such as a name out of a file.

    Returns
    -------
    str
        The text in one line, with a question mark for every control character and turned direction;
        what is longer than 2,000 characters loses its middle.
    """
    joined = " ".join(text.splitlines())
    if len(joined) > _LONGEST:
        joined = f"{joined[: _LONGEST // 2]} ... {joined[-_LONGEST // 2 :]}"
    return "".join("?" if category(char) in _UNSEEN else char for char in joined)


def mapping(what: str, value: Any, of: str) -> Mapping[Any, Any]:
    """Take an argument that has to be a mapping.

    Parameters
    ----------
    what : str
        Name of the argument, for the message.
    value : mapping or None
        The argument; None stands for an empty one.
    of : str
        What is wanted, such as ``role to column``.

    Returns
    -------
    mapping
        The argument.

    Raises
    ------
    TypeError
        It is something else.
    """
    if value is None:
        return {}
    if not isinstance(value, Mapping):
        raise TypeError(f"{what} is {shown(value)}: wanted a mapping of {of}")
    return value


def shown(value: object) -> str:
    """Write a value for a message: quoted where it is text, and shortened.

    Parameters
    ----------
    value : object
        Any value.

    Returns
    -------
    str
        One short line.
    """
    try:
        text = f"'{value}'" if isinstance(value, str) else str(value)
    except Exception:  # of a number with thousands of digits, or of somebody else's class
        text = f"unprintable ({type(value).__name__})"
    text = one_line(text)
    return text if len(text) <= _LONGEST_VALUE else text[: _LONGEST_VALUE - 3] + "..."


def listed(names: list[str], most: int = 8) -> str:
    """List names for a message, shortened where there are many or long ones.

    Parameters
    ----------
    names : list of str
        Names, such as the columns of a file.
    most : int
        How many are spelled out.

    Returns
    -------
    str
        Names separated by commas.
    """
    short = [name if len(name) <= 32 else name[:29] + "..." for name in names[:most]]
    more = [f"... ({len(names) - most} more)"] if len(names) > most else []
    return ", ".join(short + more) or "none"
