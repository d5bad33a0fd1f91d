"""95 % intervals of the values of laws, from a second reading of the recordings."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .. import _core
from .._core import Recording
from ..grouping import each_of
from .bounds import bound_of, box_of, is_fixed, physical_of
from .campaign import Campaign, weight_of
from .joint import Joint
from .tangents import Value, slopes, tangents, values_of

Array = NDArray[np.float64]
Interval = tuple[float, float]

LEVEL = 0.95
_LITTLE = 0.02
"""An uncertainty that moves the force by less than this share of its rms matters little, as in `identify`."""
_TIED = 0.9
"""Correlation with a value that is not determined above which another is not either, as in `identify`."""
_DEPENDENT = 1e-14
"""Eigenvalues of the tangents' products below this share of the largest are taken as that."""


@dataclass(frozen=True)
class Spread:
    """Values of the laws with their intervals, and the covariance behind them."""

    values: tuple[Value, ...]
    intervals: tuple[Interval | None, ...]
    """One a value; None where the recordings do not determine it, or a bound holds it."""
    covariance: Array
    """Of the values, shape (p, p)."""
    quantile: float
    """Of Student's t."""
    limits: Mapping[str, Interval]
    """What is physically admissible, by parameter: no interval goes beyond."""

    def at(self, joint: Joint, level: float) -> dict[str, Interval]:
        """Intervals of parameters at a level of what the laws run over, where their laws are determined."""
        found, first = {}, 0
        for name, p in joint.parameters.items():
            slope = slopes(p, np.array([level]))[0]
            part = slice(first, first + len(slope))
            first = part.stop
            known = all(i is not None for i, s in zip(self.intervals[part], slope, strict=True) if s != 0)
            if known:
                reach = self.quantile * float(np.sqrt(slope @ self.covariance[part, part] @ slope))
                value = float(p.at(level)[0])
                found[name] = _within(self.limits[name], (value - reach, value + reach))
        return found


def read_spread(
    recordings: Recording | Iterable[Recording],
    campaign: Campaign,
    joint: Joint,
    over: str,
    *,
    by_force: bool,
) -> Spread:
    """Read the recordings again, one after the other, for how certain the values of a joint fit are.

    The covariance is the sandwich of weighted least squares; the noise of every recording is the
    autoregression of its residuals that `mre_core.uncertainty` takes. What the fit has taken from the
    residuals is given back as one factor, from the number of values among the independent samples that
    the noise amounts to.
    """
    from scipy.special import stdtrit  # type: ignore[import-untyped]  # scipy.stats takes a second to come

    units = dict(zip(campaign.structure.names, campaign.structure.units, strict=True))
    values = values_of(joint.parameters, units, over)
    size = len(values)
    plain, noisy = np.zeros((size, size)), np.zeros((size, size))
    independent = first = second = total = 0.0  # of the force: sums for its rms about the mean
    for recording in each_of(recordings):
        columns, residual = tangents(campaign, joint, recording, over)
        assert recording.force is not None  # seen to by the first reading
        force = recording.force[slice(*recording.scored)]
        weight = weight_of(force, by_force=by_force)
        used = np.flatnonzero(np.any(columns != 0, axis=0))
        tangent = columns[:, used]
        products, certain = _core.noise_products(list(tangent.T), residual, recording.sampling_rate)
        place = np.ix_(used, used)
        plain[place] += weight * (tangent.T @ tangent)
        noisy[place] += weight**2 * products
        independent += certain
        total += weight * len(force)
        first += weight * float(np.sum(force))
        second += weight * float(np.sum(force**2))
    open_ = np.array([not is_fixed(campaign, value) for value in values])
    free = np.flatnonzero(open_ & (np.diag(plain) > 0))
    freedom = max(independent - len(free), 1.0)
    covariance = np.zeros((size, size))
    place = np.ix_(free, free)
    covariance[place] = _sandwich(plain[place], noisy[place]) * independent / freedom
    quantile = float(stdtrit(freedom, 0.5 + LEVEL / 2))
    about_mean = np.sqrt(max(second / total - (first / total) ** 2, 0.0))
    # By how much a value may be off without the force telling.
    little = np.full(size, np.inf)
    little[free] = _LITTLE * about_mean / np.sqrt(np.diag(plain)[free] / total)
    intervals = _intervals(campaign, values, covariance, quantile, little, set(free.tolist()))
    limits = {name: physical_of(campaign, name) for name in campaign.structure.names}
    return Spread(values, intervals, covariance, quantile, limits)


def independent_samples(
    recordings: Recording | Iterable[Recording], campaign: Campaign, joint: Joint, over: str
) -> float:
    """Count the independent samples that the noise around a joint fit amounts to, over all recordings."""
    count = 0.0
    for recording in each_of(recordings):
        _, residual = tangents(campaign, joint, recording, over)
        count += _core.noise_products([], residual, recording.sampling_rate)[1]
    return count


def _sandwich(plain: Array, noisy: Array) -> Array:
    scale = 1 / np.sqrt(np.diag(plain))
    roots, vectors = np.linalg.eigh(plain * np.outer(scale, scale))
    inverse = (vectors / np.maximum(roots, _DEPENDENT * roots[-1])) @ vectors.T
    found: Array = inverse @ (noisy * np.outer(scale, scale)) @ inverse
    return found * np.outer(scale, scale)


def _intervals(
    campaign: Campaign,
    values: tuple[Value, ...],
    covariance: Array,
    quantile: float,
    little: Array,
    free: set[int],
) -> tuple[Interval | None, ...]:
    """Intervals of what is determined, by the rules of `mre_core.uncertainty`."""
    errors = np.sqrt(np.maximum(np.diag(covariance), 0.0))
    loose = []
    for i, value in enumerate(values):
        low, high = box_of(campaign, value)
        reach = quantile * errors[i]
        small = (reach < abs(value.value) or errors[i] < little[i]) and 2 * reach < high - low
        loose.append(
            not small and not is_fixed(campaign, value) if i in free else not is_fixed(campaign, value)
        )
    scale = np.where(errors > 0, errors, 1.0)
    correlation = np.abs(covariance / np.outer(scale, scale))
    found: list[Interval | None] = []
    for i, value in enumerate(values):
        tied = any(loose[j] and correlation[i, j] > _TIED for j in range(len(values)) if j != i)
        bound = bound_of(campaign, value)
        held = bound is not None and not bound.physical
        if i not in free or loose[i] or tied or held:
            found.append(None)
            continue
        reach = quantile * float(errors[i])
        reached = (value.value - reach, value.value + reach)
        found.append(_within(physical_of(campaign, value.parameter), reached))
    return tuple(found)


def _within(limits: Interval, interval: Interval) -> Interval:
    return max(interval[0], limits[0]), min(interval[1], limits[1])
