"""What a joint fit has found."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any

from ..model import Model
from .bounds import words_of
from .choose import Trial
from .intervals import Spread
from .tangents import values_of
from .variable import UNITS


@dataclass(frozen=True)
class LawFit:
    """A model with laws over the current, and how well it does."""

    model: Model
    rms: float
    """Rms error in N over all samples, by the weights of the fit."""
    relative_rms: float
    """The same as a share of the force's rms."""
    by_level: Mapping[float | str, float]
    """The same by level of the current in A, or of what else the laws run over; of recordings in which that
    changes, by name."""
    left_out: Trial | None
    """How well each level is predicted from the others; None where there are too few."""
    trials: tuple[Trial, ...]
    """What was tried to choose the laws, in that order; empty where all were given."""
    samples: int
    spread: Spread | None = field(default=None, compare=False, repr=False)
    """Intervals of the laws' values; None where the recordings could be read only once."""
    notes: tuple[str, ...] = ()
    """One a value of the laws: whether a bound holds it, or empty."""
    chosen_blindly: bool = False
    """True where laws were wanted and nothing could be left out to choose them by."""

    def rows(self) -> list[dict[str, Any]]:
        """Values of the laws: parameter, law, at, value, low, high, unit, note.

        ``at`` is what has the value, None where all have it; the saturation of a law has a row of its own.
        ``low`` and ``high`` are the ends of the 95 % interval, None where the recordings do not determine
        the value or a bound holds it; ``note`` says so of a bound.
        """
        values = values_of(self.model.laws, self.model.units, self.model.over)
        intervals = [None] * len(values) if self.spread is None else self.spread.intervals
        notes = self.notes or ("",) * len(values)
        return [
            asdict(value) | dict(zip(("low", "high"), interval or (None, None), strict=True)) | {"note": note}
            for value, interval, note in zip(values, intervals, notes, strict=True)
        ]

    @property
    def words(self) -> tuple[str, ...]:
        """What to look at: parameters that a bound holds, laws that nothing could tell apart."""
        said = words_of(self.rows(), UNITS[self.model.over])
        if self.chosen_blindly:
            said.append(
                f"laws were not chosen by what they predict: no {self.model.over} and no recording lies"
                " between others, so that none could be left out"
            )
        return tuple(said)

    def to_dict(self) -> dict[str, Any]:
        """Content of ``laws.json``."""
        return {
            "schema": "mre-core/laws/1",
            "model": self.model.name,
            "laws": {name: law.to_dict() for name, law in self.model.laws.items()},
            "values": self.rows(),
            "rms_N": self.rms,
            "relative_rms": self.relative_rms,
            "over": self.model.over,
            "relative_rms_by_level": _rows(self.by_level),
            "left_out": None if self.left_out is None else _trial(self.left_out),
            "trials": [_trial(trial) for trial in self.trials],
            "samples": self.samples,
            "words": list(self.words),
        }


def _trial(trial: Trial) -> dict[str, Any]:
    by_level = _rows(trial.by_level)
    return {
        "laws": dict(trial.laws),
        "relative_rms": trial.error,
        "relative_rms_by_level": by_level,
        "relative_rms_with_ends": trial.score,
        "relative_rms_fitted": trial.fitted,
    }


def _rows(by_level: Mapping[float | str, float]) -> list[dict[str, float | str]]:
    return [
        {"recording" if isinstance(label, str) else "level": label, "relative_rms": error}
        for label, error in by_level.items()
    ]
