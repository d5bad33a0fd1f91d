"""Figures of the loops of recordings, measured and of a model."""

import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .._core import Recording
from ..checks import choice
from ..errors import InputError
from ..grouping import each_of, labels
from ..model import Model, simulate
from .cycles import find_cycles
from .figures import CONVENTIONS, QUANTITIES, Convention, Loop, measure_loop


@dataclass(frozen=True)
class LoopTable:
    """Loops of one recording."""

    recording: str
    current: float | None
    """A; None where it is not known or changes."""
    convention: Convention
    """Forces that make the effective stiffness and the damping ratio: a key of `CONVENTIONS`."""
    measured: tuple[Loop, ...]
    """One a closed cycle."""
    model: tuple[Loop, ...] | None
    """The same cycles with the force of the model; None where there is no model."""

    def mean(self, quantity: str, *, of: str = "measured") -> float:
        """Mean over the cycles of an attribute of `Loop`, of ``"measured"`` or ``"model"``."""
        return float(np.mean(self._values(quantity, of)))

    def deviation(self, quantity: str, *, of: str = "measured") -> float | None:
        """Scatter over the cycles, as a standard deviation; None for a single one."""
        values = self._values(quantity, of)
        return float(np.std(values, ddof=1)) if len(values) > 1 else None

    def error(self, quantity: str) -> float | None:
        """Error of the model's mean as a share of the measured mean's size; None without a model."""
        measured = self.mean(quantity)
        if self.model is None or measured == 0:
            return None
        return (self.mean(quantity, of="model") - measured) / abs(measured)

    def _values(self, quantity: str, of: str) -> list[float]:
        loops = self.measured if of == "measured" else self.model
        if loops is None:
            raise InputError("the loops have no model", wanted="loops made with one")
        return [float(getattr(loop, quantity)) for loop in loops]

    def to_dict(self) -> dict[str, Any]:
        """Means, deviations and errors by quantity, and every cycle."""
        means = {}
        for q in QUANTITIES:
            means[q.name] = {
                "symbol": q.symbol,
                "unit": q.unit,
                "measured": self.mean(q.name),
                "deviation": self.deviation(q.name),
                "model": None if self.model is None else self.mean(q.name, of="model"),
                "error": self.error(q.name),
            }
        return {
            "recording": self.recording,
            "current_A": self.current,
            "convention": self.convention,
            "frequency_Hz": self.mean("frequency"),
            "amplitude_mm": self.mean("amplitude"),
            "mean": means,
            "cycles": [self._cycle(i) for i in range(len(self.measured))],
        }

    def _cycle(self, i: int) -> dict[str, Any]:
        loop = self.measured[i]
        row: dict[str, Any] = {
            "cycle": i + 1,
            "start_s": loop.start,
            "frequency_Hz": loop.frequency,
            "amplitude_mm": loop.amplitude,
        }
        for who, of in (("measured", loop), ("model", self.model[i] if self.model else None)):
            if of is not None:
                row[who] = {q.column: getattr(of, q.name) for q in QUANTITIES}
        return row


def loops(
    recordings: Recording | Sequence[Recording],
    model: Model | str | os.PathLike[str] | None = None,
    *,
    convention: Convention = "displacement_extremes",
) -> list[LoopTable]:
    """Measure the loops of recordings: stiffness, energy, damping and peak forces of every closed cycle.

    A cycle counts where a neighbouring one repeats its motion; ramps and incomplete cycles do not.

    Parameters
    ----------
    recordings : Recording or sequence of them
        With force. What is excluded is left out.
    model : Model or path, optional
        A model, or its file, whose loops are measured beside them.
    convention : {"displacement_extremes", "peak_force"}
        Forces that make the effective stiffness, and through it the damping ratio: those at the
        displacement extremes, or the peak forces. The two differ wherever the loop is open at its ends.

    Returns
    -------
    list of LoopTable
        One a recording.

    Raises
    ------
    MreError
        A recording has no force or no closed cycle, the model cannot follow it, or the convention is not
        known (a ValueError).

    Examples
    --------
    >>> import numpy as np
    >>> time = np.arange(1025) / 256
    >>> x, v = 2 * np.sin(2 * np.pi * time), 4 * np.pi * np.cos(2 * np.pi * time)
    >>> [table] = loops(Recording(time, x, 5 * x + 0.4 * v, velocity=v))
    >>> len(table.measured), round(table.mean("effective_stiffness"), 3), round(table.mean("energy"), 2)
    (4, 5.0, 31.58)
    """
    choice(convention, "convention", CONVENTIONS)
    everything = list(each_of(recordings))
    names = labels([recording.name for recording in everything])
    if isinstance(model, str | os.PathLike):
        model = Model.load(model)
    return [
        _measure(recording, name, model, convention)
        for recording, name in zip(everything, names, strict=True)
    ]


def _measure(recording: Recording, name: str, model: Model | None, convention: Convention) -> LoopTable:
    if recording.force is None:
        raise InputError(f"recording '{name}' has no force", wanted="a force to measure loops of")
    part = slice(*recording.scored)
    t, x = recording.time[part], recording.displacement[part]
    cycles = find_cycles(t, x)
    if not cycles:
        raise InputError(
            f"recording '{name}' has no closed cycle", wanted="a motion that repeats, as of a cyclic test"
        )

    def measured(force: Any) -> tuple[Loop, ...]:
        return tuple(measure_loop(t, x, force[part], cycle, convention) for cycle in cycles)

    predicted = None if model is None else measured(simulate(model, recording))
    return LoopTable(name, recording.current_level, convention, measured(recording.force), predicted)
