"""What the proposed test does to a doubt: recorded on the concealed truth, and diagnosed with the rest."""

import math
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
    after: frozenset[str]
    excitation: str | None = None
    """Kind of the proposed test; none where nothing is in doubt."""
    expected: float = 0.0
    """Product of the chances of telling them apart that the tool gives."""

    @property
    def doubted(self) -> bool:
        """The truth was among several."""
        return len(self.before) > 1 and self.excitation is not None

    @property
    def right(self) -> bool:
        """The truth alone is left."""
        return self.after == set(self.trial.case.effects)


def run(trial: Trial) -> Resolved:
    """Diagnose, record the proposed test, diagnose again."""
    before, proposal = _said(trial, ())
    if proposal is None or len(before) < 2:
        return Resolved(trial, before, before)
    after, _ = _said(trial, (proposed(proposal, current=1.0),))
    told = [chance for id, chance in proposal["chances"].items() if id in before]
    expected = math.prod(told) if told else 0.0  # the test is for an effect that is hidden
    return Resolved(trial, before, after, str(proposal["excitation"]), expected)


def proposed(proposal: Mapping[str, Any], current: float) -> Excitation:
    """The proposed test as an excitation, at this current in A where it commands none."""
    signal = command(proposal)
    rate = float(proposal["limits"]["rate_hz"])
    course = steady_current(current)
    if (steps := signal.current) is not None:
        course = lambda t: np.interp(t, signal.time, steps)  # noqa: E731
    return Excitation("proposed", rate, len(signal.time), followed(signal.time, signal.displacement), course)


def _said(trial: Trial, also: tuple[Excitation, ...]) -> tuple[frozenset[str], Mapping[str, Any] | None]:
    """What may be the effect, and the test that is proposed."""
    try:
        found = mre_core.diagnose(
            recordings_of(trial.case.simulate(also)),
            trial.case.base,
            seed=1,
            false_alarm=trial.false_alarm,
            threads=1,
        )
    except mre_core.InputError:  # a lag so long that the device gives out energy
        return frozenset(), None
    said = {one for effect in found.effects for one in (effect.id, *effect.indistinguishable_from)}
    return frozenset(said), found.next_test
