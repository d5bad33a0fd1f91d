"""Are recordings fit for an identification or a diagnosis? What is wrong is said, not guessed."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ._core import Recording
from .errors import InputError

_AGAINST = -0.5
"""Correlation of force and displacement below which their signs cannot agree."""
_GIVES = -0.1
"""Correlation of force and rate of displacement below which a device gives out energy; of several recordings,
one at least of those that all do."""
_COVERED = (0.2, 5.0)
"""Shares of the way of the displacement that a velocity in its own unit covers."""
_ROUGHER = 3.0
"""A force that is so many times as rough as the displacement is in its own column."""
_RESTS = 0.1
"""Recordings that move less than this share of the others, by their rms, say little of their velocity."""
_SMOOTH = 4
"""Order of the differences that show how rough a series is."""
_JUMPS = 1.5
"""Mean squared step over the variance: 2 for noise, small for motion."""
_RESOLVED = 0.4
"""The same of ten samples a cycle."""
_LEAST = 20
"""Samples that the noise is told by."""
_EACH = 5
"""Samples for each parameter."""
_SWING = 0.1
"""Share of the stroke that a reversal has to exceed."""


def check_recordings(recordings: Sequence[Recording], parameters: int) -> None:
    """Refuse recordings that cannot be diagnosed.

    Parameters
    ----------
    recordings : sequence of Recording
        All that share the `parameters` parameters of a base model, or more.
    parameters : int
        Number of parameters that are fitted to them.

    Raises
    ------
    InputError
        A recording without force, with a force that never changes, with signs that cannot agree or columns
        that are swapped, with a velocity that is not the displacement's; no full cycle of motion in any; too
        few samples.
    """
    energies = []
    for recording in recordings:
        x, force = _scored(recording)
        if np.mean(np.diff(x) ** 2) > _JUMPS * np.var(x):
            raise _wrong(recording, "the displacement jumps like noise from sample to sample", "a motion")
        against = float(np.corrcoef(x, force)[0, 1])
        energies.append(_energy(x, force))
        if against < _AGAINST and energies[-1] < 0:
            raise _wrong(
                recording,
                f"force and displacement have opposite signs (correlation {against:.2f})",
                "a force that rises with the displacement: turn the sign of one of them",
            )
    if max(energies) < 0 and min(energies) < _GIVES and not _force_is_rougher(recordings):
        raise _wrong(
            recordings[int(np.argmin(energies))],
            f"the device would give out energy in every cycle (force and velocity correlate by"
            f" {min(energies):.2f})",
            "force and displacement in their own columns, not swapped, with agreeing signs, and no time lag"
            " of one channel behind the other",
        )
    check_velocities(recordings)
    if not any(_has_cycle(_scored(recording)[0]) for recording in recordings):
        raise _wrong(recordings[0], "there is less than one cycle of motion", "at least one full cycle")
    samples = samples_of(recordings)
    if samples < (least := max(_LEAST, _EACH * parameters)):
        problem = f"there are {samples} samples for {parameters} parameters"
        raise _wrong(recordings[0], problem, f"at least {least}")


def samples_of(recordings: Sequence[Recording]) -> int:
    """Count the samples that a fit counts."""
    return sum(stop - start for start, stop in (recording.scored for recording in recordings))


def check_force(recording: Recording) -> NDArray[np.float64]:
    """Force over the samples that count, shape (n,), N.

    Raises
    ------
    InputError
        There is none, or one that never changes: its errors have no measure.
    """
    if recording.force is None:
        raise _wrong(recording, "there is no force", "a measured force")
    force = recording.force[slice(*recording.scored)]
    if np.ptp(force) == 0:
        raise _wrong(
            recording, f"the force is {force[0]:.6g} N throughout", "a force that changes with the motion"
        )
    return force


def check_velocities(recordings: Sequence[Recording]) -> None:
    """Refuse a recorded velocity of the wrong sign or unit.

    Parameters
    ----------
    recordings : sequence of Recording
        Of which those are compared that move by much, beside the others and beside a ramp, and smoothly.

    Raises
    ------
    InputError
        The integral of a velocity, mm, is not the displacement, by its sign or by far.
    """
    ways = [_ways(recording) for recording in recordings]
    largest = max(moved.std() for moved, _ in ways)
    for recording, (moved, covered) in zip(recordings, ways, strict=True):
        # A velocity that is zero throughout is refused by what it is.
        derived = recording.velocity_window is not None or not recording.velocity.any()
        x = recording.displacement[slice(*recording.scored)]
        if derived or moved.std() <= _RESTS * max(largest, float(x.std())) or not _is_smooth(moved):
            continue
        share = float(moved @ covered) / float(moved @ moved)
        if share < _AGAINST * np.sqrt(float(covered @ covered) / float(moved @ moved)):
            raise _wrong(
                recording,
                f"velocity and displacement have opposite signs ({share:.3g} times the way is covered)",
                "the rate of the displacement: turn the sign of one of them, or leave the velocity out",
            )
        if not _COVERED[0] < share < _COVERED[1]:
            raise _wrong(
                recording,
                f"the velocity covers {share:.3g} times the way of the displacement",
                "the rate of the displacement in its unit, or no velocity: it is derived then",
            )


def _ways(recording: Recording) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Displacement and integral of the velocity over the samples that count, mm, without lines.

    An offset of a velocity is a line in its integral.
    """
    scored = slice(*recording.scored)
    t, x, v = recording.time[scored], recording.displacement[scored], recording.velocity[scored]
    covered = np.concatenate([[0.0], np.cumsum((v[1:] + v[:-1]) / 2 * np.diff(t))])
    lines = np.stack([np.ones_like(t), t - t[0]], axis=1)
    moved, covered = (
        series - lines @ np.linalg.lstsq(lines, series, rcond=None)[0] for series in (x, covered)
    )
    return moved, covered


def _is_smooth(moved: NDArray[np.float64]) -> bool:
    """Of some samples a cycle: no noise, and a trapezoidal rule integrates its rate."""
    return moved.size > _LEAST and float(np.mean(np.diff(moved) ** 2)) < _RESOLVED * float(np.var(moved))


def _scored(recording: Recording) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Displacement and force over the samples that count."""
    return recording.displacement[slice(*recording.scored)], check_force(recording)


def _energy(x: NDArray[np.float64], force: NDArray[np.float64]) -> float:
    """Dissipated energy over what force and motion of these sizes could dissipate."""
    step = np.diff(x)
    middle = (force[1:] + force[:-1]) / 2
    size = float(np.sqrt(np.sum((middle - middle.mean()) ** 2) * np.sum(step**2)))
    # Without its linear elastic part, whose energy is only stored.
    slope, offset = np.polyfit(x, force, 1)
    lost = middle - slope * (x[1:] + x[:-1]) / 2 - offset
    return float(np.sum(lost * step)) / size if size > 0 else 0.0


def _force_is_rougher(recordings: Sequence[Recording]) -> bool:
    """In every recording: force sensors are noisier, so that a lag and not swapped columns is at work."""
    return all(_rough(force) > _ROUGHER * _rough(x) for x, force in map(_scored, recordings))


def _rough(series: NDArray[np.float64]) -> float:
    """Size of the noise over that of the series: differences of a high order leave little of a motion."""
    return float(np.std(np.diff(series, _SMOOTH)) / np.std(series)) if series.size > _SMOOTH else 0.0


def _has_cycle(x: NDArray[np.float64]) -> bool:
    """Two reversals, or one between ends on both sides of zero from which the motion comes back."""
    swing = _SWING * float(np.ptp(x))
    reversals, way, extreme = 0, 0, float(x[0])
    for value in x.tolist():
        if way == 0 and abs(value - extreme) > swing:
            way, extreme = (1 if value > extreme else -1), value
        elif way * (value - extreme) > 0:
            extreme = value
        elif way * (extreme - value) > swing:
            reversals, way, extreme = reversals + 1, -way, value
    if reversals != 1:
        return reversals > 1
    both = float(x.min()) < -2 * swing and float(x.max()) > 2 * swing
    return both and abs(float(x[-1] - x[0])) < 2 * swing


def _wrong(recording: Recording, problem: str, wanted: str) -> InputError:
    name = f"recording '{recording.name}': " if recording.name else ""
    return InputError(name + problem, wanted=wanted)
