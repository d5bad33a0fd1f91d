"""Plain sentences about what was understood of files."""

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Final

from .errors import listed

if TYPE_CHECKING:
    from .inspection import Inspected, Inspection
    from .signals import Signals

GIVEN: Final = "as given"
"""Reason for a column that the user has named."""
_MUCH_NOISE: Final = 0.05
_FEW_SAMPLES: Final = 40
"""Samples in a cycle."""
_LONG_LAG: Final = 0.25
"""Samples."""


def remarks(found: "Inspection") -> list[str]:
    """Say what is wrong, what to look at, and what to do next.

    Parameters
    ----------
    found : Inspection
        What was understood.

    Returns
    -------
    list of str
        One sentence a line.
    """
    lines = [f"{table.problem}" for table in found.tables if table.problem]
    said: dict[str, list[str]] = {}
    for table in found.usable:
        for text in _about(table, found.map):
            said.setdefault(text, []).append(table.name)
    lines += [f"{listed(names)}: {text}" for text, names in said.items()]
    usable = found.usable
    currents = sorted({table.conditions["current"] for table in usable if "current" in table.conditions})
    if found.name_pattern and currents:
        levels = ", ".join(f"{current:g}" for current in currents)
        lines.append(f"file names have the form {found.name_pattern}: current {levels} A")
    if not usable:
        return [*lines, "no recording yet: name the columns by --map ROLE='COLUMN[UNIT]'"]
    turned = [table for table in usable if table.turned]
    if turned and len(turned) == len(usable):
        lines.append(
            "the energy is negative in every recording, as if the device drove the rig: the sign of the force"
            " is the other way round; the map turns it"
        )
    elif turned:
        names = ", ".join(table.name for table in turned)
        lines.append(f"the energy is negative in {names} only: the sign of the force differs between files")
    if all("current" not in table.conditions and not _has(table, "current") for table in usable):
        lines.append("no current: state it by --set 'current=1[A]', or leave it out if there is no coil")
    return lines


def _about(table: "Inspected", map: Mapping[str, str]) -> Iterator[str]:
    signals = table.signals
    if signals is None:
        return
    for guess in table.guesses:
        other = map.get(guess.role, guess.text).removeprefix("-")
        if other != guess.text and guess.reason != GIVEN:
            yield f"{guess.role} is in '{guess.header}', elsewhere in '{other}': they need a map each"
    assumed = [guess for guess in table.guesses if guess.unit is None]
    if assumed:
        columns = ", ".join(f"'{guess.header}' as {guess.text.rpartition('[')[2][:-1]}" for guess in assumed)
        yield f"no unit is stated, so {columns} is assumed"
    if signals.force_N is None:
        yield "no force: name its column by --map force='COLUMN[UNIT]'"
    if not signals.even:
        yield "the steps of time differ: diagnose needs even sampling, identify does not"
    yield from _noise(signals)
    if signals.frequency_Hz and signals.rate_Hz / signals.frequency_Hz < _FEW_SAMPLES:
        few = signals.rate_Hz / signals.frequency_Hz
        yield f"only {few:.0f} samples in a cycle: {_FEW_SAMPLES} or more would follow hysteresis better"
    if signals.velocity_lag_s is not None and abs(signals.velocity_lag_s) * signals.rate_Hz > _LONG_LAG:
        yield f"the velocity comes {1e3 * signals.velocity_lag_s:.3g} ms behind the slope of the displacement"
    if signals.phase_deg is not None and signals.frequency_Hz and -90 < signals.phase_deg < 0:
        late = -signals.phase_deg / 360 / signals.frequency_Hz
        yield f"the force comes {1e3 * late:.3g} ms behind the displacement, which no passive device does"


def _noise(signals: "Signals") -> Iterator[str]:
    stroke = signals.stroke_mm[1] - signals.stroke_mm[0]
    if signals.displacement_noise_mm > _MUCH_NOISE * stroke:
        yield f"the displacement has a noise of {signals.displacement_noise_mm:.2g} mm over {stroke:.3g} mm"
    if signals.force_N is not None and signals.force_noise_N is not None:
        span = signals.force_N[1] - signals.force_N[0]
        if signals.force_noise_N > _MUCH_NOISE * span:
            yield f"the force has a noise of {signals.force_noise_N:.2g} N over {span:.3g} N"


def _has(table: "Inspected", role: str) -> bool:
    return any(guess.role == role for guess in table.guesses)
