"""Which column of a table stands for what, and in which unit."""

import re
from collections.abc import Collection, Mapping, Sequence
from typing import Final, NamedTuple

from .errors import InputError, listed, mapping, shown
from .units import IDENTITY, ROLES, Conversion, conversion, find_conversion, measured_by

ALIASES: Final[dict[str, str]] = {
    alias: role
    for role, aliases in {
        "time": ("time", "t", "zeit", "running_time", "elapsed_time", "时间"),
        "displacement": (
            *("displacement", "disp", "stroke", "position", "axial_displacement", "axial_disp"),
            *("weg", "verschiebung", "位移"),
        ),
        "velocity": ("velocity", "vel", "geschwindigkeit", "速度"),
        "force": ("force", "load", "kraft", "axial_force", "力", "荷载", "载荷"),
        "current": ("current", "strom", "电流"),
        "temperature": ("temperature", "temp", "temperatur", "温度"),
        "simulated": ("simulated_force", "simulated"),
    }.items()
    for alias in aliases
}

CANONICAL: Final[dict[str, str]] = {
    "time": "time_s",
    "displacement": "displacement_mm",
    "velocity": "velocity_mm_s",
    "force": "force_N",
    "current": "current_A",
    "temperature": "temperature_C",
    "simulated": "simulated_force_N",
}

_LONGEST_HEADER: Final = 200
"""Characters of a header that is looked into."""
_BRACKETS: Final = (("[", "]"), ("(（", ")）"))


class Column(NamedTuple):
    """A column with a role: how its values become canonical, and whether that is an assumption."""

    header: str
    role: str
    conversion: Conversion
    assumed: bool


def find_columns(
    headers: Sequence[str],
    map: Mapping[str, str] | None = None,
    *,
    require_force: bool = True,
    fixed: Collection[str] = (),
    file: str | None = None,
) -> dict[str, Column]:
    """Find the column and the unit of every role.

    Parameters
    ----------
    headers : sequence of str
        Column names, all different.
    map : mapping of str to str, optional
        Role to ``column`` or ``column[unit]``; other roles are recognised by their header. A minus in front
        turns the sign.
    require_force : bool
        Whether a missing force is an error, as a missing time or displacement is.
    fixed : collection of str
        Roles that need no column because their value is known.
    file : str, optional
        Source of the table, for messages.

    Returns
    -------
    dict of str to Column
        Roles found, in the order of `ROLES`.

    Raises
    ------
    InputError
        A role is missing, ambiguous or unknown, a mapped column does not exist, or a unit is wrong.
    """
    found: dict[str, Column] = {}
    for role, text in check_map(map, file).items():
        if role not in fixed:
            found[role] = _mapped(role, text, headers, file)
    taken: dict[str, str] = {}
    for role, column in found.items():
        if column.header in taken:
            problem = f"mapped to both {taken[column.header]} and {role}"
            raise InputError(problem, file=file, column=column.header, wanted="one role for each column")
        taken[column.header] = role
    for header in headers:
        match = None if header in taken else recognise(header)
        if match is None or match[0] in taken.values() or match[0] in fixed:
            continue
        role, unit = match
        if role in found:
            raise InputError(
                f"columns '{found[role].header}' and '{header}' both read as {role}",
                file=file,
                wanted=f"one of them named by map, as {role}={header}",
            )
        known = IDENTITY if unit is None else conversion(unit, role, file=file, column=header)
        found[role] = Column(header, role, known, unit is None)
    required = ["time", "displacement", *(["force"] if require_force else [])]
    for role in required:
        if role not in found and role not in fixed:
            raise InputError(
                f"no column for {role} among {listed(list(headers))}",
                file=file,
                wanted=f"{CANONICAL[role]}, or another one named by map, as {role}=NAME[{ROLES[role].unit}]"
                " (mre-core inspect guesses which)",
            )
    return {role: found[role] for role in ROLES if role in found}


def check_map(map: Mapping[str, str] | None, file: str | None = None) -> Mapping[str, str]:
    """Take roles and their columns; None stands for none.

    Raises
    ------
    TypeError
        It is no mapping, or the name of a column is no text.
    InputError
        There is no such role.
    """
    for role, text in mapping("map", map, "role to column").items():
        if role not in ROLES:
            found = f"map names the role {shown(role)}"
            raise InputError(found, file=file, value=role, wanted=", ".join(ROLES))
        if not isinstance(text, str):
            raise TypeError(f"the column of {role} is {shown(text)}: wanted its name")
    return {} if map is None else map


def assumption(columns: Collection[Column], file: str | None = None) -> str | None:
    """Say which units are assumed.

    Parameters
    ----------
    columns : collection of Column
        Columns in use.
    file : str, optional
        Source of the table.

    Returns
    -------
    str or None
        One line, or None where every unit is known.
    """
    assumed = [column for column in columns if column.assumed]
    if not assumed:
        return None
    units = ", ".join(f"'{column.header}' (taken as {ROLES[column.role].unit})" for column in assumed)
    example = f"map {assumed[0].role}='{assumed[0].header}[{ROLES[assumed[0].role].unit}]'"
    return (f"{file}: " if file else "") + f"no unit in the header of {units}; to state it, {example}"


def split_unit(header: str) -> tuple[str, str | None]:
    """Split a header such as ``Force [kN]`` into name and unit."""
    text = header.rstrip()
    pair = next((pair for pair in _BRACKETS if text.endswith(tuple(pair[1]))), None)
    if pair is None:
        return header, None
    opening = max(text.rfind(sign) for sign in pair[0])
    unit = text[opening + 1 : -1]
    if opening < 0 or any(sign in unit for sign in pair[1]):
        return header, None
    return text[:opening].rstrip(), unit.strip() or None


def suffixes(header: str) -> list[tuple[str, str]]:
    """Every split of a header in front of a word, longest ending first: ``vel``, ``m_s`` or ``F / kN``."""
    if len(header) > _LONGEST_HEADER:
        return [("", header)]
    gaps = re.finditer(r"\s*[/,]\s*|[_\s]+", header)
    return [("", header), *((header[: gap.start()], header[gap.end() :]) for gap in gaps)]


def _alias(name: str) -> str | None:
    return ALIASES.get(re.sub(r"\s+", "_", name.strip().lower()))


def recognise(header: str) -> tuple[str, str | None] | None:
    """Read a header that is an alias with at most a unit behind it.

    Parameters
    ----------
    header : str
        Name of a column.

    Returns
    -------
    (role, unit) or None
        The unit is None where the header states none.
    """
    name, unit = split_unit(header.strip())
    if role := _alias(name):
        # A lone letter claims no unit of another quantity: "T [degC]" is not a time.
        foreign = len(name) == 1 and unit is not None and find_conversion(unit, role) is None
        return None if foreign else (role, unit)
    for start, suffix in suffixes(name) if unit is None else ():
        if (role := _alias(start)) and find_conversion(suffix, role):
            return role, suffix
    return None


def _mapped(role: str, text: str, headers: Sequence[str], file: str | None) -> Column:
    """Resolve ``column``, ``column[unit]`` or ``-column``; the whole text is tried as a column first."""
    if not isinstance(text, str) or not text.strip():
        problem = f"map gives {shown(text)} for {role}"
        raise InputError(problem, file=file, value=text, wanted="the name of a column")
    if text in headers:
        return _read_unit(role, text, file)
    if text.startswith("-") and (text[1:] in headers or text[1:2] != "-"):
        column = _mapped(role, text[1:], headers, file)
        factor, offset = column.conversion
        return column._replace(conversion=Conversion(-factor, -offset))
    name, unit = split_unit(text) if text.rstrip().endswith("]") else (text, None)
    without_units = [header for header in headers if split_unit(header)[0] == name]
    if name not in headers and len(without_units) == 1:
        name = without_units[0]
    if name in headers:
        if unit is None:
            return _read_unit(role, name, file)
        return Column(name, role, conversion(unit, role, file=file, column=name), False)
    # Loaded for this message only.
    from difflib import get_close_matches

    lower = {header.lower(): header for header in headers}
    near = [lower[match] for match in get_close_matches(name.lower(), lower, n=3)]
    hint = f" (nearest: {listed(near)})" if near else ""
    raise InputError(
        f"map names the column '{name}' for {role}, which is not there{hint}",
        file=file,
        value=text,
        wanted=f"one of {listed(list(headers))}",
    )


def _read_unit(role: str, header: str, file: str | None) -> Column:
    """Take the unit of a mapped column from its header."""
    name, unit = split_unit(header)
    if unit is not None:
        return Column(header, role, conversion(unit, role, file=file, column=header), False)
    for _, suffix in suffixes(name):
        if known := find_conversion(suffix, role):
            return Column(header, role, known, False)
    # A single letter is as likely the name of a sensor as a unit.
    other = next((text for _, text in suffixes(name) if len(text) > 1 and measured_by(text)), None)
    if other is not None:
        example = f"'{header}[{ROLES[role].unit}]' in the map if that is what it holds"
        raise InputError(
            f"mapped to {role}, but '{other}' is a unit of {measured_by(other)}",
            file=file,
            column=header,
            value=other,
            wanted=f"a column with a unit such as {ROLES[role].examples}, or {example}",
        )
    return Column(header, role, IDENTITY, True)
