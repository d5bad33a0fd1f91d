"""Arguments of functions, checked before they travel into the core, to other processes or onto a disk."""

import os
from collections.abc import Collection, Iterable
from numbers import Integral

from .errors import InputError, listed, shown

MOST_WORKERS = 1024
"""Threads or processes."""


def whole(value: object, name: str, least: int, most: int) -> int:
    """Take a whole number, of Python or NumPy.

    Raises
    ------
    InputError
        It is something else, a truth value, or outside the range.
    """
    if isinstance(value, Integral) and not isinstance(value, bool) and least <= int(value) <= most:
        return int(value)
    raise InputError(f"{name} is {shown(value)}", wanted=f"a whole number from {least} to {most}")


def workers(value: object, name: str = "threads") -> int | None:
    """Take a number of threads or processes; None stands for as many as there are cores.

    Raises
    ------
    InputError
        It is no whole number from 1 to 1024.
    """
    return None if value is None else whole(value, name, 1, MOST_WORKERS)


def choice(value: object, name: str, among: Collection[str]) -> str:
    """Take one of several names.

    Raises
    ------
    InputError
        It is none of them.
    """
    if isinstance(value, str) and value in among:
        return value
    raise InputError(f"{name} is {shown(value)}", wanted=f"one of {listed(list(among))}")


def texts(value: Iterable[str], name: str) -> tuple[str, ...]:
    """Take several texts; a single one stands for itself.

    Raises
    ------
    TypeError
        Something among them is no text.
    InputError
        One holds half of a character.
    """
    if isinstance(value, str) or not isinstance(value, Iterable):
        value = (value,)
    found = tuple(value)
    for one in found:
        if not isinstance(one, str):
            raise TypeError(f"{name} holds {shown(one)}: wanted texts")
        check_text(one, name)
    return found


def check_text(value: object, name: str) -> None:
    """Refuse what is no text that can be written.

    Raises
    ------
    TypeError
        It is no text at all.
    InputError
        It holds half of a character, as a text of Python may and no file can.
    """
    if not isinstance(value, str):
        raise TypeError(f"{name} is {shown(value)}: wanted a text")
    try:
        value.encode()
    except UnicodeEncodeError:
        found = f"{name} is {shown(value)}: it holds half of a character, such as \\ud800"
        raise InputError(found, wanted="text") from None


def flag(value: object, name: str) -> bool:
    """Take a truth value: a text or an array would pass for one, whatever it says.

    Raises
    ------
    InputError
        It is something else.
    """
    import numpy as np  # which the help of a command does not wait for

    if isinstance(value, bool | np.bool_):
        return bool(value)
    raise InputError(f"{name} is {shown(value)}", wanted="True or False")


def check_listener(value: object, name: str) -> None:
    """Refuse, before the work begins, what cannot be called while it goes on.

    Raises
    ------
    TypeError
        It is neither None nor callable.
    """
    if value is not None and not callable(value):
        raise TypeError(f"{name} is {shown(value)}: wanted a function")


def check_name(path: str | os.PathLike[str]) -> None:
    """Refuse a name that cannot be written.

    Raises
    ------
    InputError
        It is no text, or holds a null byte.
    """
    if not is_text(str(path)):
        wanted = "another name: it goes into results"
        raise InputError("its name is no text in UTF-8", file=str(path), wanted=wanted)


def is_text(name: str) -> bool:
    """Tell whether a name can be written: one of other bytes than UTF-8, or with a null byte, cannot."""
    try:
        return b"\0" not in name.encode()
    except UnicodeEncodeError:
        return False
