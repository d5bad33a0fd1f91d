"""The tests of a campaign, and which of them takes which part in the study."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from .._core import Problem, Recording
from ..errors import InputError
from ..grouping import group_by_current
from ..replica import CAMPAIGN, record

_LEAST = 20
"""Samples that are scored."""
_SAME = 1.1
"""Ratio of amplitudes up to which they are one level."""


@dataclass(frozen=True)
class Case:
    """One test: a recording with its levels."""

    name: str
    """Of the recording; no other of the campaign has it."""
    recording: Recording
    current: float | None
    """A; None where it is not known."""
    amplitude: float
    """Half the stroke, mm."""


@dataclass(frozen=True)
class Campaign:
    """Tests at several currents and amplitudes; the paper has twelve.

    The paper's choices are read as ranks, so that they mean something for any campaign.
    """

    cases: tuple[Case, ...]
    made_by: str = ""
    """Model that a simulated campaign was made by; following it then says nothing of the model."""

    @property
    def currents(self) -> list[float | None]:
        """Levels of the current, rising."""
        return list(dict.fromkeys(case.current for case in self.cases))

    @property
    def amplitudes(self) -> list[float]:
        """Levels of the amplitude, rising."""
        return sorted({case.amplitude for case in self.cases})

    @property
    def smallest(self) -> Case:
        """Lowest current, smallest amplitude: 0 A and 2 mm in the paper (Table 2, Figures 4 to 7)."""
        return min(self.at_current(self.currents[0]), key=lambda case: case.amplitude)

    @property
    def by_amplitude(self) -> list[Case]:
        """All amplitudes at the highest current: 3 A in the paper (Figures 8 and 9)."""
        return self.at_current(self.currents[-1])

    @property
    def by_current(self) -> list[Case]:
        """All currents at the middle amplitude: 4 mm in the paper (Figure 10)."""
        return [case for case in self.cases if case.amplitude == self._middle]

    @property
    def searched(self) -> Case:
        """Second current, middle amplitude: 1 A and 4 mm in the paper (Figures 12 and 13)."""
        level = self.currents[min(1, len(self.currents) - 1)]
        return min(self.at_current(level), key=lambda case: abs(case.amplitude - self._middle))

    @property
    def _middle(self) -> float:
        return self.amplitudes[len(self.amplitudes) // 2]

    def at_current(self, level: float | None) -> list[Case]:
        """List the tests at one level of the current, by rising amplitude."""
        return sorted((c for c in self.cases if c.current == level), key=lambda c: c.amplitude)


def replica(seed: int) -> Campaign:
    """Simulate the paper's twelve tests."""
    return replace(as_campaign([record(condition, seed) for condition in CAMPAIGN]), made_by="sinh")


def as_campaign(recordings: Sequence[Recording]) -> Campaign:
    """Order recordings by current and amplitude.

    Parameters
    ----------
    recordings : sequence of Recording
        With force, each at one constant current, or all without.

    Raises
    ------
    MreError
        There are none, one has no force or too few samples, does not move or has a force that never changes,
        a current changes inside a recording, only some currents are known, or a model cannot be fitted.
    """
    if not recordings:
        raise InputError("recordings are an empty list", wanted="at least one recording")
    strokes = [_stroke(recording) for recording in recordings]
    amplitudes = _levels(sorted(strokes))
    levels = [amplitudes[stroke] for stroke in strokes]
    cases = []
    for current, members in group_by_current(recordings):
        for member in members:
            place = next(i for i, recording in enumerate(recordings) if recording is member)
            cases.append(Case(_name(recordings, place), member, current, levels[place]))
    return Campaign(tuple(cases))


def _stroke(recording: Recording) -> float:
    """Half the stroke of a recording that can be studied."""
    name = f"recording '{recording.name}'"
    if recording.force is None:
        raise InputError(f"{name} has no force", wanted="a force to identify from")
    if recording.current_varies:
        raise InputError(f"{name} has a current that changes", wanted="one constant current each")
    scored = slice(*recording.scored)
    x, force = recording.displacement[scored], recording.force[scored]
    if len(x) < _LEAST:
        raise InputError(f"{name} has {len(x)} samples", wanted=f"at least {_LEAST}")
    for what, values in (("displacement", x), ("force", force)):
        if np.ptp(values) == 0:
            raise InputError(
                f"the {what} of {name} is {values[0]:.6g} throughout", wanted=f"a {what} that changes"
            )
    for model in ("sinh", "bouc_wen"):
        Problem(recording, model)  # says now what it would say after minutes of work
    return float(np.ptp(x)) / 2


def _name(recordings: Sequence[Recording], place: int) -> str:
    """Name of a recording, with a number where others before have the same."""
    names = [recording.name or "recording" for recording in recordings[: place + 1]]
    before = names.count(names[-1])
    return names[-1] if before == 1 else f"{names[-1]} ({before})"


def _levels(rising: list[float]) -> dict[float, float]:
    """Level of each amplitude: the mean of those that are nearly the same, to two digits."""
    groups: list[list[float]] = []
    for value in rising:
        if groups and value <= _SAME * groups[-1][0]:
            groups[-1].append(value)
        else:
            groups.append([value])
    return {value: float(f"{np.mean(group):.2g}") for group in groups for value in group}
