"""Units: from what a user writes to the canonical unit of a role."""

import re
from functools import lru_cache
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from .errors import InputError, shown

if TYPE_CHECKING:
    import numpy as np
    import pint
    from numpy.typing import NDArray


class Role(NamedTuple):
    """What a column can stand for: its canonical unit and examples of other units."""

    unit: str
    examples: str
    quantity: str


ROLES: Final[dict[str, Role]] = {
    "time": Role("s", "s, ms or min", "time"),
    "displacement": Role("mm", "mm, m or in", "displacement"),
    "velocity": Role("mm/s", "mm/s, m/s or in/s", "velocity"),
    "force": Role("N", "N, kN or lbf", "force"),
    "current": Role("A", "A or mA", "current"),
    "temperature": Role("degC", "degC, degF or K", "temperature"),
    "simulated": Role("N", "N, kN or lbf", "force"),
}


class Conversion(NamedTuple):
    """Linear step to the canonical unit: ``factor * value + offset``."""

    factor: float
    offset: float = 0.0

    def apply(self, values: "NDArray[np.float64]") -> "NDArray[np.float64]":
        """Convert an array.

        Parameters
        ----------
        values : (n,) ndarray
            Values in the unit of the source.

        Returns
        -------
        (n,) ndarray
            Values in the canonical unit; the same array where nothing is to be done.
        """
        return values if self == IDENTITY else values * self.factor + self.offset


IDENTITY: Final = Conversion(1.0, 0.0)

# Only these are read as units. pint also knows rods, links, points, years ("a") and the speed of
# light ("c"), and would see them in headers such as displacement_rod or velocity_c.
_PREFIXED: Final = {"meter", "second", "newton", "gram", "ampere", "force_pound"}
_PREFIXES: Final = {"nano", "micro", "milli", "centi", "kilo", "mega"}
_PLAIN: Final = _PREFIXED | {
    *("inch", "foot", "yard", "thou", "minute", "hour", "day"),
    *("kip", "force_kilogram", "force_metric_ton", "dyne"),
    *("kelvin", "degree_Celsius", "degree_Fahrenheit"),
}

_TEMPERATURE: Final = re.compile(
    r"(?:°|º|deg(?:rees?)?)?[ _]?(?:(?P<degC>c|celsius)|(?P<degF>f|fahrenheit)|(?P<K>k|kelvin))",
    re.IGNORECASE,
)
_FACTOR: Final = re.compile(r"([^\W\d]+)(?:(?:\^|\*\*)(-?\d)|(-[1-9]|[2-9]))?")
_PLAIN_TEXT: Final = str.maketrans({"⁻": "-", "¹": "1", "²": "2", "³": "3", "·": "*", "⋅": "*"})
_LONGEST_UNIT: Final = 40


def conversion(unit: str, role: str, *, file: str | None = None, column: str | None = None) -> Conversion:
    """Find how values in a unit become values in the canonical unit of a role.

    Parameters
    ----------
    unit : str
        Unit as written by a user, such as ``kN``, ``mm/s``, ``mm_s`` or ``°C``.
    role : str
        One of `ROLES`.
    file, column : str, optional
        Where the unit stands, for the message.

    Returns
    -------
    Conversion
        Factor and offset.

    Raises
    ------
    InputError
        The unit is unknown or measures something else.
    """
    found = find_conversion(unit, role)
    if found is not None:
        return found
    quantity, examples = ROLES[role].quantity, ROLES[role].examples
    other = measured_by(unit)
    what = f"is a unit of {other}, not of {quantity}" if other else f"is not a known unit of {quantity}"
    wanted = f"a unit such as {examples}"
    if column is not None:
        wanted += f", or map {role}='NAME[{ROLES[role].unit}]'"
    raise InputError(f"unit {shown(unit)} {what}", file=file, column=column, value=unit, wanted=wanted)


@lru_cache(maxsize=1024)
def find_conversion(unit: str, role: str) -> Conversion | None:
    """Find how values in a unit become canonical ones, or that they do not.

    Parameters
    ----------
    unit : str
        Unit as written by a user.
    role : str
        One of `ROLES`.

    Returns
    -------
    Conversion or None
        None where the text is no unit of the role.
    """
    text = unit.strip()
    # A bare C is coulomb to pint and a bare F is farad.
    if role == "temperature" and (match := _TEMPERATURE.fullmatch(text)):
        text = match.lastgroup or text
    canonical = ROLES[role].unit
    if text == canonical:
        return IDENTITY
    spellings = [text, re.sub(r"[ _]per[ _]", "/", text)]
    if role == "velocity":
        spellings.append(text.replace("_", "/", 1))
    if role in ("force", "simulated"):
        spellings.append(text.replace("KN", "kN"))
    if len(text) > 2:
        spellings.append(text.lower())
    for spelling in spellings:
        parsed = _parse(spelling)
        if parsed is not None and parsed.is_compatible_with(canonical):
            return _conversion(parsed, canonical)
    return None


def measured_by(unit: str) -> str | None:
    """Tell what a unit measures.

    Parameters
    ----------
    unit : str
        Unit as written by a user.

    Returns
    -------
    str or None
        ``force`` for ``kN``; None for a text that is no unit of any role.
    """
    return next((role.quantity for name, role in ROLES.items() if find_conversion(unit, name)), None)


@lru_cache(maxsize=1)
def _registry() -> "pint.UnitRegistry[Any]":
    # Loaded on first use: pint is slow to import, and canonical units do without it.
    # Fractions keep the factors exact.
    from fractions import Fraction

    import pint

    return pint.UnitRegistry(non_int_type=Fraction)


def _parse(text: str) -> "pint.Unit | None":
    """Read a product of powers of known units; a scale, a number or any other name gives None."""
    if not text or len(text) > _LONGEST_UNIT:
        return None
    text = re.sub(r"\s*([*/])\s*", r"\1", text.translate(_PLAIN_TEXT).replace("**", "^"))
    pieces = re.split(r"([*/. ])", text)
    expression = ""
    for i, piece in enumerate(pieces):
        if i % 2:
            expression += "/" if piece == "/" else "*"
        elif match := _FACTOR.fullmatch(piece):
            expression += f"{match[1]}**({match[2] or match[3] or 1})"
        else:
            return None
    import pint

    registry = _registry()
    try:
        unit = registry.parse_units(expression)
        names = [registry.parse_unit_name(name)[0] for name, _ in registry.Quantity(1, unit).unit_items()]
    except (pint.PintError, ValueError, TypeError, IndexError):
        return None
    known = all(
        name in _PLAIN and (not prefix or (name in _PREFIXED and prefix in _PREFIXES))
        for prefix, name, _ in names
    )
    return unit if known and names else None


def _conversion(unit: "pint.Unit", canonical: str) -> Conversion:
    from fractions import Fraction

    def convert(value: int) -> Any:
        return _registry().Quantity(Fraction(value), unit).to(canonical).magnitude

    offset = convert(0)
    return Conversion(float(convert(1) - offset), float(offset))
