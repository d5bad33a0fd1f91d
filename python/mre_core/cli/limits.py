"""Limits of the next test from the command line."""

from ..errors import InputError
from ..limits import UNITS


def limits_of(given: tuple[str, ...]) -> dict[str, float | tuple[float, float]]:
    """Read NAME=VALUE, each name once."""
    found: dict[str, float | tuple[float, float]] = {}
    for text in given:
        name, _, value = text.partition("=")
        if name in found or name not in UNITS:
            raise InputError(f"--limit {text}", wanted=f"one of {', '.join(UNITS)}, each once")
        try:
            found[name] = range_of(value) if name == "current" else float(value)
        except ValueError:
            form = "LOWEST:HIGHEST" if name == "current" else "NUMBER"
            raise InputError(f"--limit {text}", wanted=f"--limit {name}={form} in {UNITS[name]}") from None
    return found


def range_of(text: str) -> tuple[float, float]:
    """Read LOWEST:HIGHEST.

    Raises
    ------
    ValueError
        The text has another form.
    """
    low, high = map(float, text.split(":"))
    return low, high
