"""A campaign as a joint fit sees it: levels of the current, and recordings whose current changes.

What is said of the current holds for what else laws may run over (`variable`).
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from .._core import Recording
from ..errors import InputError, shown
from ..grouping import each_once, labels, same_level
from ..stored import number
from .factors import DirectFactor, Samples, SinhFactor
from .law import Dependence, Law
from .parts import Changing, Part, Steady
from .shapes import ShapeBox, shape_boxes
from .structure import Structure
from .variable import series_of

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Campaign:
    """Recordings of several currents, worked in."""

    structure: Structure
    parts: tuple[Part, ...]
    limits: Mapping[str, tuple[float, float]]
    """Of the coefficients."""
    shape_boxes: Mapping[str, ShapeBox]
    tested: Mapping[str, float]
    """Largest displacement in mm and velocity in mm/s."""
    current: float | None
    """Of all recordings, where that is not what the laws run over."""
    samples: int
    weight: float
    """Sum of the weights of all samples."""

    @property
    def levels(self) -> tuple[float, ...]:
        """Currents in A, rising: the levels, and the ends of a current that changes beyond them."""
        steady = {p.currents[0] for p in self.parts if len(p.currents) == 1}
        ends = [end for p in self.parts for end in p.currents]
        return tuple(sorted({*steady, min(ends), max(ends)}))

    @property
    def variety(self) -> int:
        """How many currents the values of a law can be told apart by."""
        return max([len(self.levels), *(p.visited for p in self.parts if isinstance(p, Changing))])

    @property
    def removable(self) -> tuple[Part, ...]:
        """What can be left out and predicted: the levels that others enclose.

        Where there is none, the recordings whose current changes in a range that the others enclose.
        """
        steady = [p for p in self.parts if isinstance(p, Steady)]
        levels = self.levels
        if inner := tuple(p for p in steady if levels[0] < p.label < levels[-1]):
            return inner
        return tuple(p for p in self.parts if isinstance(p, Changing) and self._encloses(p))

    def _encloses(self, part: Part) -> bool:
        rest = self.without(part)
        if not rest.parts:
            return False
        (low, high), (first, last) = part.currents, (rest.levels[0], rest.levels[-1])
        return (first <= low or same_level(low, first)) and (last >= high or same_level(high, last))

    def without(self, part: Part) -> "Campaign":
        """Leave out a part."""
        return replace(self, parts=tuple(p for p in self.parts if p is not part))

    def only(self, part: Part) -> "Campaign":
        """Keep one part alone."""
        return replace(self, parts=(part,))

    def rows(self, laws: Sequence[Law], shapes: Sequence[Dependence]) -> tuple[Array, Array]:
        """Columns and force of all parts, at least one, one below the other."""
        parts = [part.rows(laws, shapes) for part in self.parts]
        return np.vstack([rows for rows, _ in parts]), np.concatenate([right for _, right in parts])


def read_campaign(
    recordings: Recording | Iterable[Recording],
    structure: Structure,
    bounds: Mapping[str, tuple[float, float]],
    over: str,
    *,
    by_force: bool,
) -> Campaign:
    """Work in recordings one after the other; `by_force` weights them by their mean squared force.

    `over` is what laws run over; where that is not the current, all recordings have the same one.

    Raises
    ------
    InputError
        No recording, one without force or without what the laws run over, other currents beside that, a
        bound of no parameter, or one that is reversed.
    """
    steady: list[Steady] = []
    varying: list[tuple[int, Samples, Array]] = []
    names: list[str] = []
    farthest = fastest = strongest = weights = 0.0
    samples = 0
    currents: set[float | None] = set()
    for recording in each_once(recordings):
        force = recording.force
        if force is None:
            raise InputError(f"recording '{recording.name}' has no force", wanted="a force to fit")
        first, last = recording.scored
        weight = weight_of(force[first:last], by_force=by_force)
        farthest = max(farthest, float(np.abs(recording.displacement).max()))
        fastest = max(fastest, float(np.abs(recording.velocity).max()))
        strongest = max(strongest, float(np.abs(force).max()))
        samples += last - first
        weights += weight * (last - first)
        series = series_of(recording, over)
        if len(series) > 1:
            varying.append((len(names), Samples(structure, recording, weight), series))
        else:
            _level(steady, float(series[0]), structure).add(recording, weight)
        names.append(recording.name)
        if over != "current":
            currents.add(_steady_current(recording, over))
    if len(currents) > 1:
        found = ", ".join("unknown" if c is None else f"{c:g} A" for c in sorted(currents, key=str))
        raise InputError(f"recordings at several currents ({found})", wanted=f"one, for laws over {over}")
    if not samples:
        raise InputError("recordings are an empty list", wanted="at least one recording")
    called = labels(names)
    changing = [Changing(structure, part, series, called[i]) for i, part, series in varying]
    bounds = {name: _pair(name, pair, structure) for name, pair in bounds.items()}
    limits = structure.limits(strongest)
    held = [p.factor for p in steady if isinstance(p.factor, DirectFactor)]
    kept = [r for factor in held for r in factor.recordings] + [c.samples.recording for c in changing]
    return Campaign(
        structure,
        (*sorted(steady, key=lambda p: p.currents), *changing),
        {name: bounds.get(name, limits[name]) for name in structure.coefficients},
        shape_boxes(structure, farthest, kept, bounds),
        {"displacement_mm": farthest, "velocity_mm_s": fastest},
        next(iter(currents), None),
        samples,
        weights,
    )


def _pair(name: str, pair: tuple[float, float], structure: Structure) -> tuple[float, float]:
    """Bounds of a parameter, checked."""
    if name not in structure.names:
        raise InputError(f"bounds for '{name}'", wanted=f"one of {', '.join(structure.names)}")
    ends = list(pair) if isinstance(pair, Iterable) else []
    if len(ends) != 2:
        raise InputError(f"bounds of {name} are {shown(pair)}", wanted="(lower, upper)")
    low, high = (number(end, f"a bound of {name}") for end in ends)
    if low > high:
        raise InputError(f"bounds of {name} are {low} to {high}", wanted="lower at most upper")
    return low, high


def weight_of(force: Array, *, by_force: bool) -> float:
    """Weight of a sample of a recording: one, or as much as makes the mean squared force one."""
    return 1.0 / max(float(np.mean(force**2)), 1e-300) if by_force else 1.0


def _steady_current(recording: Recording, over: str) -> float | None:
    if recording.current_varies:
        problem = f"the current changes within '{recording.name}'"
        raise InputError(problem, wanted=f"a constant one, for laws over {over}")
    return recording.current_level


def _level(steady: list[Steady], current: float, structure: Structure) -> SinhFactor | DirectFactor:
    """Find the factor of the level that a current belongs to, by the tolerance of `group_by_current`."""
    for level in steady:
        if same_level(current, level.currents[0]):
            level.members.append(current)
            return level.factor
    kind = DirectFactor if structure.model == "bouc_wen" else SinhFactor
    steady.append(Steady([current], kind(structure)))
    return steady[-1].factor
