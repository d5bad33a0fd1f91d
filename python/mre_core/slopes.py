"""Recorded velocities that are no slopes: difference quotients of the displacement, or smoothed.

They are not what the device felt: they bias the damping, and look like an effect that the device has not. One
that a simulation took for the velocity itself is right. The fit tells which.
"""

import warnings
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from math import log
from typing import NamedTuple

from ._core import Problem, Recording, with_slopes
from .checks import workers
from .errors import ExtrapolationWarning, VelocityWarning, listed
from .fits import exact
from .grouping import group_by_current, labels
from .measure import measure_fit
from .model import Model
from .suitable import samples_of

_PLAINLY = 10.0
"""Twice the logarithm of the likelihood, of white errors, by which derived velocities have to fit better."""

Left = Callable[[Sequence[Recording]], float]
"""Sum of squared errors that a model leaves of recordings, N^2."""


class Derived(NamedTuple):
    """Recordings, some of them with a derived velocity."""

    recordings: list[Recording]
    """In the order given."""
    names: tuple[str, ...]
    """Of those whose velocity is another one now."""


def derived_where_better(recordings: Sequence[Recording], left: Left, threads: int | None = None) -> Derived:
    """Derive velocities anew that are no slopes, where that plainly fits better.

    Parameters
    ----------
    recordings : sequence of Recording
        With force.
    left : callable
        What a model leaves of recordings.
    threads : int, optional
        All cores by default.
    """
    found = with_slopes(recordings, threads=workers(threads))
    if not any(other is not None for other in found):
        return Derived(list(recordings), ())
    anew = [given if other is None else other for given, other in zip(recordings, found, strict=True)]
    before, after = left(recordings), left(anew)
    if not 0 < after < before or samples_of(recordings) * log(before / after) < _PLAINLY:
        return Derived(list(recordings), ())
    names = labels([recording.name for recording in recordings])
    return Derived(anew, tuple(name for name, other in zip(names, found, strict=True) if other is not None))


def warn_of_velocities(recordings: Sequence[Recording], left: Left, threads: int | None) -> None:
    """Warn of velocities that are no slopes, where derived ones plainly fit better.

    Warns
    -----
    VelocityWarning
        A fit takes the velocity as it is recorded.
    """
    names: tuple[str, ...] = ()
    with suppress(KeyboardInterrupt):  # what is warned of is done
        _, names = derived_where_better(recordings, left, threads)
    if names:
        text = (
            f"the velocity of {listed(list(names))} is a difference quotient of the displacement or smoothed,"
            " and one that is derived by local polynomials fits better: leave the column out"
        )
        warnings.warn(text, VelocityWarning, stacklevel=3)


def left_by_fit(
    model: str,
    recordings: Sequence[Recording],
    threads: int | None,
    bounds: Mapping[str, tuple[float, float]] | None = None,
) -> float:
    """Sum of squared errors in N^2 of a model that is fitted to recordings, current by current.

    Of a model with effects it is that of its equation alone.
    """

    def squares(own: list[Recording]) -> float:
        return exact(Problem(own, model, bounds), threads=threads).fitness * samples_of(own)

    return sum(squares(own) for _, own in group_by_current(recordings))


def left_by(model: Model, recordings: Sequence[Recording]) -> float:
    """Sum of squared errors in N^2 of a model as it is."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ExtrapolationWarning)
        fits = [measure_fit(model, recording) for recording in recordings]
    return sum(fit.rms**2 * fit.samples for fit in fits)
