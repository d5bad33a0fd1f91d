"""The tests of a campaign, and which of them takes which part in the study."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from .._core import Recording
from ..errors import InputError
from ..grouping import group_by_current
from ..replica import CAMPAIGN, record

_SAME = 1.1
"""Ratio of amplitudes up to which they are one level."""


@dataclass(frozen=True)
class Case:
    """One test: a recording with its levels."""

    recording: Recording
    current: float | None
    """A; None where it is not known."""
    amplitude: float
    """Half the stroke, mm."""

    @property
    def name(self) -> str:
        """Of the recording."""
        return self.recording.name


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
    InputError
        There are none, one has no force or does not move, a current changes inside a recording, or only
        some currents are known.
    """
    strokes = {}
    for recording in recordings:
        name = f"recording '{recording.name}'"
        if recording.force is None:
            raise InputError(f"{name} has no force", wanted="a force to identify from")
        if recording.current_varies:
            raise InputError(f"{name} has a current that changes", wanted="one constant current each")
        scored = recording.displacement[slice(*recording.scored)]
        strokes[id(recording)] = float(np.ptp(scored)) / 2
        if not strokes[id(recording)] > 0:
            raise InputError(f"{name} does not move", wanted="a displacement that changes")
    amplitudes = _levels(sorted(strokes.values()))
    cases = [
        Case(recording, current, amplitudes[strokes[id(recording)]])
        for current, members in group_by_current(recordings)
        for recording in members
    ]
    return Campaign(tuple(cases))


def _levels(rising: list[float]) -> dict[float, float]:
    """Level of each amplitude: the mean of those that are nearly the same, to two digits."""
    groups: list[list[float]] = []
    for value in rising:
        if groups and value <= _SAME * groups[-1][0]:
            groups[-1].append(value)
        else:
            groups.append([value])
    return {value: float(f"{np.mean(group):.2g}") for group in groups for value in group}
