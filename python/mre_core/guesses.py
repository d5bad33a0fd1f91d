"""Which column of a foreign file may stand for what, with the reason."""

import re
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Final, NamedTuple

from .columns import recognise, split_unit, suffixes
from .units import ROLES, find_conversion, measured_by

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

WORDS: Final[dict[str, tuple[str, ...]]] = {
    "time": ("time", "zeit", "timestamp", "datetime", "zeitstempel", "时间", "x_value"),
    "displacement": (
        *("displacement", "disp", "stroke", "position", "lvdt", "deflection", "extension", "crosshead"),
        *("weg", "verschiebung", "位移", "行程"),
    ),
    "velocity": ("velocity", "speed", "vel", "geschwindigkeit", "速度"),
    "force": ("force", "load", "shear", "kraft", "力", "荷载", "载荷"),
    "current": ("current", "coil", "strom", "amps", "电流"),
    "temperature": ("temperature", "temp", "temperatur", "温度"),
}
_COMMANDS: Final = ("command", "cmd", "demand", "target", "setpoint", "reference", "soll", "error")
"""A column of what was asked for is not what was measured."""
_EVEN: Final = 0.01


class Guess(NamedTuple):
    """A column taken for a role, and why."""

    header: str
    role: str
    unit: str | None
    """Unit in the header; None where the canonical one is assumed."""
    reason: str
    certain: bool
    """Whether `mre_core.load` takes it so without being told."""

    @property
    def text(self) -> str:
        """What ``--map`` has to say."""
        return self.header if self.unit is not None else f"{self.header}[{ROLES[self.role].unit}]"


def guess_roles(columns: Mapping[str, "NDArray[np.float64] | None"]) -> dict[str, Guess]:
    """Guess the role of columns by their names, their units and their values.

    Parameters
    ----------
    columns : mapping of str to (n,) ndarray or None
        Values by header; None where they are no numbers.

    Returns
    -------
    dict of str to Guess
        By role, in the order of `ROLES`.
    """
    ranked = sorted(
        (
            (score, -place, Guess(header, role, unit, reason, score == 4))
            for place, (header, values) in enumerate(columns.items())
            for score, role, unit, reason in _readings(header, values)
        ),
        reverse=True,
        key=lambda one: one[:2],
    )
    found: dict[str, Guess] = {}
    for _, _, guess in ranked:
        if guess.role not in found and guess.header not in {other.header for other in found.values()}:
            found[guess.role] = guess
    _by_values(columns, found)
    return {role: found[role] for role in ROLES if role in found}


def _readings(header: str, values: object) -> list[tuple[float, str, str | None, str]]:
    """Roles that a header may mean: rank, role, unit and reason."""
    if values is None:
        return []
    if known := recognise(header):
        role, unit = known
        return [(4.0, role, unit, "by its name" if unit else "by its name; its unit is assumed")]
    name, unit = split_unit(header)
    unit = unit or next((text for _, text in suffixes(name) if measured_by(text)), None)
    lower = name.lower()
    command = next((word for word in _COMMANDS if word in lower), None)
    found = []
    for role, words in WORDS.items():
        word = next((word for word in words if _contains(lower, word)), None)
        fits = unit is not None and find_conversion(unit, role) is not None
        if word and (fits or unit is None):
            reason = f"'{word}' in its name" + (
                f" and {unit} as its unit" if fits else "; its unit is assumed"
            )
            found.append((3.0 if fits else 2.0, role, unit if fits else None, reason))
        elif fits and len(unit or "") > 1 | (role in ("time", "force", "current")):
            found.append((1.0, role, unit, f"{unit} is a unit of {ROLES[role].quantity}"))
    # A command is taken only where nothing else is there.
    return [(rank / 10 if command else rank, *rest) for rank, *rest in found]  # type: ignore[misc]


def _contains(name: str, word: str) -> bool:
    """Short words count only as words of their own: no 'vel' in 'level'."""
    if len(word) > 4 or not word.isascii():
        return word in name
    return word in re.split(r"[^a-zäöüß]+", name)


def _by_values(columns: Mapping[str, "NDArray[np.float64] | None"], found: dict[str, Guess]) -> None:
    """Take a column that grows evenly for time, and of two others the first one for displacement."""
    import numpy as np

    taken = {guess.header for guess in found.values()}
    free = {h: v for h, v in columns.items() if v is not None and h not in taken and len(v) > 2}
    if "time" not in found:
        for header, values in free.items():
            steps = np.diff(values)
            if steps.min() > 0 and np.ptp(steps) <= _EVEN * steps.mean():
                found["time"] = Guess(header, "time", None, "it grows evenly; its unit is assumed", False)
                free = {h: v for h, v in free.items() if h != header}
                break
    moving = {header: values for header, values in free.items() if np.ptp(values) > 0}
    missing = [role for role in ("displacement", "force") if role not in found]
    if len(moving) != len(missing) or not missing or any(recognise(h) for h in moving):
        return
    for role, header in zip(missing, moving, strict=True):
        reason = "it is the only column left" if len(missing) == 1 else _REASONS[role]
        found[role] = Guess(header, role, None, f"{reason}; its unit is assumed", False)


_REASONS: Final = {
    "displacement": "it is the first of the two that are left",
    "force": "it is the second of the two that are left",
}


_NAMED: Final = {"a": "current", "ma": "current", "mm": "amplitude", "hz": "frequency", "c": "temperature"}
_PIECE: Final = re.compile(r"(?<![\d.])(\d+(?:[.x]\d+)?)\s?(mA|A|mm|Hz|°?C)(?![a-z])")


def guess_pattern(stems: Sequence[str]) -> str | None:
    """Guess the form of file names such as ``3A-1Hz-8mm``.

    Parameters
    ----------
    stems : sequence of str
        File names without folder and ending.

    Returns
    -------
    str or None
        A pattern that all names have, with the current or the temperature in it; None where there is none.
    """
    from .conditions import CONDITIONS, conditions_in_name
    from .errors import InputError

    if not stems:
        return None
    used: set[str] = set()

    def field(match: "re.Match[str]") -> str:
        name = _NAMED[match[2].lower().removeprefix("°")]
        if name in used:
            return match[0]
        used.add(name)
        return f"{{{name}}}" + match[0][len(match[1]) :]

    pattern = _PIECE.sub(field, stems[0])
    if not used & set(CONDITIONS):
        return None
    try:
        for stem in stems:
            conditions_in_name(stem, pattern)
    except InputError:
        return None
    return pattern
