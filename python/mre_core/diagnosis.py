"""What a diagnosis says: verdict, effects, where, and the models before and after."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from math import isfinite
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import words
from ._core import __version__
from .model import Model

SCHEMA = "mre-core/diagnosis/1"


@dataclass(frozen=True)
class Estimate:
    """A fitted parameter with its 95 % interval; None at an end that the recordings do not determine."""

    value: float
    low: float | None
    high: float | None
    unit: str


@dataclass(frozen=True)
class MissingEffect:
    """An effect that the base model leaves out."""

    id: str
    law: str
    statement: str
    """What was left out, where it shows, and how much it improves, in one sentence."""
    equation: str
    reference: str
    parameters: Mapping[str, Estimate]
    p_value: float
    form: str
    """``"exact"``, or ``"approximate"`` where its law, or that of another, is not the catalogue's."""
    lack_of_fit: float
    """What the best further effect would add to an approximate form, as a share of the force's rms."""
    indistinguishable_from: tuple[str, ...]
    no_test_tells: tuple[str, ...]
    """Those of them that the proposed test, the best within the limits, is not expected to tell from it."""
    checks: Mapping[str, str]
    """How else to tell it from those of ``indistinguishable_from`` where something simple does, by id."""
    at_the_end: tuple[str, ...]
    """Parameters that the recordings press to the end of their range, or that cannot be told from nothing and
    without which it is another effect: the name is then the nearest one, and the form approximate."""
    held_out_rms_before: float
    """Rms error in N on held-out data without this effect, the other effects in place."""
    held_out_rms_after: float


@dataclass(frozen=True)
class Comparison:
    """Rms errors in N of the base model and the final one, trained without the held-out data.

    nan where an interruption came before.
    """

    train_rms_before: float
    train_rms_after: float
    held_out_rms_before: float
    held_out_rms_after: float
    noise_rms: float
    unit: str = "N"


@dataclass(frozen=True)
class Refitted:
    """Rms errors of a base model whose parameters were kept, over all samples that count."""

    rms_as_given: float
    rms_fitted: float
    """With parameters fitted to these recordings."""
    as_well: bool
    """True where these leave no more than the effects that are named, which are hints then."""
    unit: str = "N"


@dataclass(frozen=True)
class History:
    """Forces in N over one recording, shape (n,) each."""

    recording: str
    time: NDArray[np.float64]
    """s."""
    displacement: NDArray[np.float64]
    """mm."""
    velocity: NDArray[np.float64]
    """mm/s."""
    measured: NDArray[np.float64]
    base: NDArray[np.float64]
    """Of the base model, fitted alone."""
    final: NDArray[np.float64]
    """Of the base model and the effects, fitted together, as the measurement shows it."""


@dataclass(frozen=True)
class Diagnosis:
    """A verdict on a base model, and the models before and after.

    ``str()`` gives the verdict in one sentence; `to_dict` the content of ``diagnosis.json``.
    """

    base: str
    verdict: str | None
    """``"adequate"``, ``"missing_physics"``, ``"partly_explained"`` or ``"unexplained"``; None where an
    interruption came before."""
    effects: tuple[MissingEffect, ...]
    """By how much each improves the fit of held-out data."""
    where: tuple[Mapping[str, Any], ...]
    """Places of the mismatch of the base model, strongest first."""
    fit: Comparison
    unknown: Mapping[str, Any] | None
    """What an unexplained mismatch depends on, in words and numbers, with its map over displacement and
    velocity; which effects came nearest to it."""
    absorbed_detail: tuple[Mapping[str, Any], ...]
    """Effects that these recordings would hide, up to which size, and why."""
    next_test: Mapping[str, Any] | None
    p_values: Mapping[str, Any]
    """Of the base model's mismatch, of the final model's (`rest`), of a noise whose size does not follow the
    motion (`even`), and of each effect beside the final model."""
    base_model: Model
    model: Model
    """Base model and effects, fitted together on everything."""
    recordings: tuple[str, ...]
    false_alarm: float
    fixed: bool
    seed: int
    histories: tuple[History, ...] = field(compare=False, repr=False)
    blank: Mapping[str, Any] | None = None
    """Of simulations of the base model, from which nothing is missing: their `count`, in how many an effect
    was `named`, the `rate` with its 95 % interval from `low` to `high` beside the `stated` one, in how many
    a mismatch was found and nothing named (`unexplained`), and how often each effect was named
    (`by_effect`)."""
    left_out: Mapping[str, int] = field(default_factory=dict)
    """Samples by recording that no fit, test or rms counts: near corners, too sharp turns and ends
    of a motion without a recorded velocity, where the one that can be derived is wrong or noisy, and those at
    the very turn of a motion, where the sign of the velocity is not known."""
    refitted: Refitted | None = None
    """Where the parameters of a base without effects were kept, something is missing, and fitted ones leave
    less."""
    interrupted: bool = False
    """True where Ctrl-C ended it early: what was not reached is empty, or nan."""
    one_specimen: bool = False
    """True where the recordings follow each other on one specimen."""
    velocity_derived: tuple[str, ...] = ()
    """Recordings whose velocity was a difference quotient of the displacement, or smoothed, and was derived
    anew."""
    pressed: Mapping[str, Sequence[Mapping[str, Any]]] = field(default_factory=dict)
    """Parameters that the recordings would plainly have pass a limit of what is physical (a damping below
    zero), of the base model alone (``"base"``) and beside the effects (``"final"``): evidence that something
    is missing, and no properties of the device."""

    off: Mapping[str, Estimate] = field(default_factory=dict)
    """What is off of parameters that were kept, or of a simulation, where that explains as much as effects
    do: a ``stiffness``, a ``damping``, a ``scale`` of the force, a ``zero``, to be added. Where it explains
    more, no effect is named."""

    @property
    def absorbed(self) -> tuple[str, ...]:
        """Ids of effects that these recordings would hide."""
        return tuple(detail["id"] for detail in self.absorbed_detail)

    def __str__(self) -> str:
        named = [e.id for e in self.effects]
        ends = {e.id: e.at_the_end for e in self.effects if e.at_the_end}
        nothing_left = (self.p_values.get("rest") or 0.0) > self.false_alarm
        whole = self.verdict == "partly_explained" and nothing_left
        inexact = self.verdict == "missing_physics" and any(e.form == "approximate" for e in self.effects)
        said = "nearest" if whole else "inexact" if inexact else self.verdict
        if said is None or not isfinite(self.fit.held_out_rms_after):
            return words.broken_off(said, self.base, named)
        told = [words.verdict(said, self.base, named, asdict(self.fit))]
        if ends:
            told.append(words.at_the_end(ends))
        elif whole and not self.off and not (self.refitted and self.refitted.as_well):
            told.append(words.WORSE)
        if self.verdict in ("adequate", "missing_physics"):
            told.append(words.noise(self.p_values.get("even")))
        told.extend(words.pressed(self.pressed))
        if self.off:
            told.append(words.off({name: asdict(estimate) for name, estimate in self.off.items()}, named))
        if self.refitted is not None:
            given, fitted = self.refitted.rms_as_given, self.refitted.rms_fitted
            told.append(words.refitted(given, fitted, as_well=self.refitted.as_well))
        if self.one_specimen:
            told.append(words.ONE_SPECIMEN)
        if self.velocity_derived:
            told.append(words.velocity_derived(self.velocity_derived))
        return " ".join(filter(None, told))

    def to_dict(self) -> dict[str, Any]:
        """Content of ``diagnosis.json``."""
        return {
            "schema": SCHEMA,
            "version": __version__,
            "base": self.base,
            "fixed": self.fixed,
            "verdict": self.verdict,
            "statement": str(self),
            "effects": [
                asdict(effect)
                | {
                    "indistinguishable_from": list(effect.indistinguishable_from),
                    "no_test_tells": list(effect.no_test_tells),
                    "at_the_end": list(effect.at_the_end),
                }
                for effect in self.effects
            ],
            "where": [dict(place) for place in self.where],
            "fit": asdict(self.fit),
            "unknown": None if self.unknown is None else dict(self.unknown),
            "absorbed": list(self.absorbed),
            "absorbed_detail": [dict(detail) for detail in self.absorbed_detail],
            "next_test": None if self.next_test is None else dict(self.next_test),
            "p_values": dict(self.p_values),
            "blank": None if self.blank is None else dict(self.blank),
            "left_out": dict(self.left_out),
            "recordings": list(self.recordings),
            "false_alarm": self.false_alarm,
            "seed": self.seed,
            "refitted": None if self.refitted is None else asdict(self.refitted),
            "interrupted": self.interrupted,
            "one_specimen": self.one_specimen,
            "velocity_derived": list(self.velocity_derived),
            "off": {name: asdict(estimate) for name, estimate in self.off.items()},
            "pressed": {model: list(map(dict, found)) for model, found in self.pressed.items()},
        }
