"""What the proposed test does to a doubt: recorded on the concealed truth, and diagnosed with the rest."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import mre_core
import numpy as np
from judge import recordings_of
from mre_core.concealed import Excitation, followed, steady_current
from mre_core.next_test import command
from plans import Trial


@dataclass(frozen=True)
class Resolved:
    """What was said of a trial before and after the proposed test."""

    trial: Trial
    before: frozenset[str]
    """What may be the effect: the name and what is not told from it; empty where none is given."""
    told: frozenset[str]
    """Those of them that the proposed test is said to tell from the name; empty: no test would."""
    after: frozenset[str]
    """As before, with the test; the same where none is to tell anything."""
    excitation: str | None = None
    """Kind of the proposed test."""
    expected: float | None = None
    """Chance, as the tool gives it, that one effect alone is left."""
    left: frozenset[str] | None = None
    """What the tool expects to be left in doubt beside the truth; None: it expects nothing of it."""

    @property
    def doubted(self) -> bool:
        """The truth was among several."""
        return len(self.before) > 1 and set(self.trial.case.effects) <= self.before

    @property
    def right(self) -> bool:
        """The truth alone is left."""
        return self.after == set(self.trial.case.effects)

    @property
    def as_told(self) -> bool:
        """The truth is left, and no more beside it than the tool expects."""
        truth = frozenset(self.trial.case.effects)
        return truth <= self.after <= truth | (self.left or frozenset())


def run(trial: Trial) -> Resolved:
    """Diagnose, record the proposed test, diagnose again."""
    first = _diagnosed(trial, ())
    before = _said(first)
    proposal = first.next_test if first else None
    told = frozenset(proposal["separates"]) & before if proposal else frozenset()
    if proposal is None or len(before) < 2 or not told:
        return Resolved(trial, before, told, before)
    after = _said(_diagnosed(trial, (proposed(proposal, current=1.0),)))
    (truth,) = trial.case.effects
    left = frozenset(proposal["leaves"][truth]) if truth in proposal["leaves"] else None
    kind, expected = str(proposal["excitation"]), proposal["certainty"]
    return Resolved(trial, before, told, after, kind, expected, left)


def proposed(proposal: Mapping[str, Any], current: float) -> Excitation:
    """The proposed test as an excitation, at this current in A where it commands none."""
    signal = command(proposal)
    rate = float(proposal["limits"]["rate_hz"])
    course = steady_current(current)
    if (steps := signal.current) is not None:
        course = lambda t: np.interp(t, signal.time, steps)  # noqa: E731
    return Excitation("proposed", rate, len(signal.time), followed(signal.time, signal.displacement), course)


def _diagnosed(trial: Trial, also: tuple[Excitation, ...]) -> mre_core.Diagnosis | None:
    try:
        return mre_core.diagnose(
            recordings_of(trial.case.simulate(also)),
            trial.case.base,
            seed=1,
            false_alarm=trial.false_alarm,
            threads=1,
        )
    except mre_core.InputError:  # a lag so long that the device gives out energy
        return None


def _said(found: mre_core.Diagnosis | None) -> frozenset[str]:
    """What may be the effect."""
    effects = found.effects if found else ()
    return frozenset(one for effect in effects for one in (effect.id, *effect.indistinguishable_from))
