"""Conditions that hold for a whole recording: given outright, or read from a file name."""

import math
import re
import string
from collections.abc import Mapping
from numbers import Real
from typing import Final

from .errors import InputError, shown
from .units import ROLES, conversion, find_conversion

CONDITIONS: Final = ("current", "temperature")

# In file names a decimal point is often written x, as in 0x5.
_NUMBER: Final = r"[+-]?(?:\d+(?:[.x]\d*)?|\.\d+)(?:[eE][+-]?\d+)?"
_WITH_UNIT: Final = re.compile(r"\s*([^\[\]]*?)\s*(?:\[([^\[\]]*)\])?\s*")


def read_conditions(given: Mapping[str, object], *, file: str | None = None) -> dict[str, float]:
    """Check conditions and bring them to canonical units.

    Parameters
    ----------
    given : mapping of str to object
        Role to a number in the canonical unit (A, degC), or to a text such as ``500[mA]``. None
        stands for not given.
    file : str, optional
        Source of the recording, for messages.

    Returns
    -------
    dict of str to float
        Values in A and degC.

    Raises
    ------
    InputError
        Another role, a value that is no finite number, or a wrong unit.
    """
    return {role: _value(role, value, file) for role, value in given.items() if value is not None}


def _value(role: str, value: object, file: str | None) -> float:
    if role not in CONDITIONS:
        raise InputError(
            f"'{role}' is no condition of a recording", file=file, value=role, wanted=" or ".join(CONDITIONS)
        )
    unit = None
    number = math.nan
    if isinstance(value, str):
        if match := _WITH_UNIT.fullmatch(value):
            number, unit = _float(match[1]), match[2]
    elif isinstance(value, Real) and not isinstance(value, bool):
        number = _float(value)
    if not math.isfinite(number):
        canonical = ROLES[role].unit
        raise InputError(
            f"{role} is {shown(value)}",
            file=file,
            value=value,
            wanted=f"a finite number in {canonical}, or one with a unit such as '20[{canonical}]'",
        )
    if unit is None:
        return number
    return _convert(number, unit, role, file)


def _float(value: str | Real) -> float:
    try:
        return float(value)
    except (ValueError, OverflowError):
        return math.nan


def _convert(number: float, unit: str, role: str, file: str | None) -> float:
    step = conversion(unit, role, file=file)
    return number * step.factor + step.offset


def conditions_in_name(stem: str, pattern: str, *, file: str | None = None) -> dict[str, float]:
    """Read conditions from a file name.

    Parameters
    ----------
    stem : str
        File name without folder and ending.
    pattern : str
        Text with fields in braces, such as ``{amplitude}mm{frequency}Hz{current}A``. It has to match
        the whole stem. A field stands for a number, where ``0x5`` is 0.5. ``current`` and
        ``temperature`` are read, in the unit written behind the field (else A, degC); any other field
        is passed over.
    file : str, optional
        File, for messages.

    Returns
    -------
    dict of str to float
        Values in A and degC.

    Raises
    ------
    InputError
        The pattern is malformed or does not match.
    """
    behind = check_pattern(pattern, file)
    regex = "".join(
        re.escape(literal) + (f"(?P<{field}>{_NUMBER})" if field else "")
        for literal, field in _parts(pattern, file)
    )
    match = re.fullmatch(regex, stem, re.ASCII)
    if match is None:
        raise InputError(
            f"the name '{stem}' does not match the pattern '{pattern}'",
            file=file,
            value=stem,
            wanted="a name of that form with a number for each field",
        )
    values: dict[str, float] = {}
    for role in CONDITIONS:
        if role in behind:
            number = _value(role, match[role].replace("x", "."), file)
            word = re.match(r"°?[^\W\d_]*", behind[role])
            unit = word[0] if word else ""
            values[role] = _convert(number, unit, role, file) if find_conversion(unit, role) else number
    return values


def check_pattern(pattern: str, file: str | None = None) -> dict[str, str]:
    """Take the fields of a pattern, with the text behind each.

    Raises
    ------
    TypeError
        It is no text.
    InputError
        It is malformed.
    """
    if not isinstance(pattern, str):
        raise TypeError(f"name_pattern is {shown(pattern)}: wanted a text with fields in braces")
    fields: dict[str, str] = {}
    last = None
    for literal, field in _parts(pattern, file):
        if last is not None:
            fields[last] = literal
        problem = ""
        if field is not None and not field.isidentifier():
            problem = f"'{{{field}}}' is no field name"
        elif field in fields:
            problem = f"'{{{field}}}' stands there twice"
        elif field is not None and last is not None and not literal:
            problem = f"nothing between '{{{last}}}' and '{{{field}}}'"
        if problem:
            raise _malformed(pattern, problem, file)
        last = field
        if field is not None:
            fields[field] = ""
    if not fields:
        raise _malformed(pattern, "no field in braces", file)
    return fields


def _parts(pattern: str, file: str | None) -> list[tuple[str, str | None]]:
    try:
        parts = list(string.Formatter().parse(pattern))
    except ValueError as error:
        raise _malformed(pattern, str(error), file) from None
    for _, field, spec, conversion_mark in parts:
        if spec or conversion_mark:
            raise _malformed(pattern, f"a format behind '{field}'", file)
    return [(literal, field) for literal, field, _, _ in parts]


def _malformed(pattern: str, problem: str, file: str | None) -> InputError:
    return InputError(
        f"name pattern '{pattern}': {problem}",
        file=file,
        value=pattern,
        wanted="a pattern such as '{amplitude}mm{frequency}Hz{current}A'",
    )
