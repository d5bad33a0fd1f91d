"""How well the parameters of a fit are determined."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._core import Problem
from .checks import whole, workers
from .minimise import draw_seed
from .stored import number

MOST_REPLICATES = 1_000_000
"""More say no more about an interval, and their parameters would fill the memory."""


@dataclass(frozen=True)
class Estimate:
    """A parameter or a combination of parameters with its uncertainty."""

    name: str
    unit: str
    value: float
    standard_error: float | None
    """None where the recordings say nothing about it, or the box fixes it."""
    low: float | None
    """Lower end of the interval. None where an interval would pretend: see `determined`, and for a
    parameter on a bound that is no physical limit."""
    high: float | None
    determined: bool
    """False where the interval reaches zero (unless a standard error of the parameter hardly moves the
    force); for a parameter also where it is wider than the box, or tied to such a one."""

    @property
    def interval(self) -> str:
        """The interval in words."""
        if self.low is not None and self.high is not None:
            return f"{self.low:.5g} to {self.high:.5g}"
        return "" if self.determined else "not determined"


@dataclass(frozen=True)
class Uncertainty:
    """Uncertainty of a fit, from the tangents of the force at its parameters."""

    level: float
    """Probability with which an interval is to hold the truth."""
    parameters: tuple[Estimate, ...]
    derived: tuple[Estimate, ...]
    """Stiffness about the origin and cubic stiffness, and effective stiffness (force at the displacement
    extremes) and energy per cycle of steady sines with `amplitude` and `frequency`."""
    correlation: NDArray[np.float64] = field(repr=False)
    """Of the parameters, shape (d, d)."""
    condition_number: float
    """Of the tangents with columns of unit length."""
    amplitude: float
    """Largest tested amplitude, mm."""
    frequency: float
    """Frequency at which it was tested, Hz: of a sine, or the mean frequency of another motion."""
    words: tuple[str, ...]
    """What is not determined, and what would determine it; empty where everything is."""


@dataclass(frozen=True)
class Profile:
    """Profile-likelihood interval of a parameter."""

    name: str
    unit: str
    value: float
    low: float | None
    """Lower end; None where the cost stays low down to the bound."""
    high: float | None
    """Upper end; None where the cost stays low up to the bound."""
    points: NDArray[np.float64] = field(repr=False)
    """Values at which all others were fitted again, and their fitness in N^2, shape (n, 2)."""

    @property
    def interval(self) -> str:
        """The interval in words."""
        low = "bound" if self.low is None else f"{self.low:.5g}"
        high = "bound" if self.high is None else f"{self.high:.5g}"
        return f"{low} to {high}"


@dataclass(frozen=True)
class Bootstrap:
    """Fits of simulated repetitions of the recordings."""

    level: float
    seed: int
    units: Mapping[str, str]
    """Unit of every parameter, then of every derived quantity."""
    replicates: NDArray[np.float64] = field(repr=False)
    """Parameters, then derived quantities, one row a replicate."""
    intervals: Mapping[str, tuple[float, float]]
    """Percentile intervals."""
    blocks: tuple[int, ...]
    """Samples of a block in each recording."""


def uncertainty(problem: Problem, x: ArrayLike, *, level: float = 0.95) -> Uncertainty:
    """Estimate the uncertainty of a fit from the tangents of the force.

    The covariance is the sandwich of weighted least squares; the noise of every recording is an
    autoregression of its residuals, up to 0.3 s long, corrected for what the fit has taken from it.
    The intervals are by Student's t with the degrees of freedom of that estimate, and symmetric: where
    they are wide, `profile` is better. Samples are taken as evenly spaced.

    Parameters
    ----------
    problem : Problem
        Recordings and a model.
    x : array, shape (d,)
        Parameters at or near the optimum.
    level : float
        Probability with which an interval is to hold the truth.

    Returns
    -------
    Uncertainty
        For parameters and combinations of them.

    Raises
    ------
    MreError
        A level outside (0, 1), parameters that cannot be simulated, fewer samples than parameters, or a
        problem from `Problem.streamed`, which keeps no samples.

    References
    ----------
    Worsley et al. 2002, https://doi.org/10.1006/nimg.2001.0933 (correction of the residuals)
    """
    found = _core.fit_uncertainty(problem, x, number(level, "level"))
    return Uncertainty(
        level,
        tuple(Estimate(*row) for row in found["parameters"]),
        tuple(Estimate(*row) for row in found["derived"]),
        found["correlation"],
        found["condition_number"],
        found["amplitude"],
        found["frequency"],
        tuple(found["words"]),
    )


def profile(
    problem: Problem, x: ArrayLike, *, level: float = 0.95, threads: int | None = None
) -> tuple[Profile, ...]:
    """Profile-likelihood intervals: hold a parameter, fit the others again, see how the fitness rises.

    The rise that ends an interval respects correlated residuals as `uncertainty` does.

    Parameters
    ----------
    problem : Problem
        Recordings and a model.
    x : array, shape (d,)
        Parameters at the optimum.
    level : float
        Probability with which an interval is to hold the truth.
    threads : int, optional
        All cores by default. The result does not depend on it.

    Returns
    -------
    tuple of Profile
        For every parameter that its box does not fix.

    Raises
    ------
    MreError
        As `uncertainty`.
    """
    level = number(level, "level")
    rows = _core.fit_profile(problem, x, level, threads=workers(threads))
    return tuple(Profile(*row) for row in rows)


def bootstrap(
    problem: Problem,
    x: ArrayLike,
    replicates: int = 1000,
    *,
    seed: int | None = None,
    level: float = 0.95,
    threads: int | None = None,
) -> Bootstrap:
    """Fit simulated repetitions of the recordings: the force of the fit, and noise like theirs.

    The noise is made of blocks of the whitened residuals, drawn at random and given their
    autocorrelation again.

    Parameters
    ----------
    problem : Problem
        Recordings and a model.
    x : array, shape (d,)
        Parameters at the optimum.
    replicates : int
        How many.
    seed : int, optional
        Same seed, same result. Drawn and reported where not given.
    level : float
        Probability with which an interval is to hold the truth.
    threads : int, optional
        All cores by default. The result does not depend on it.

    Returns
    -------
    Bootstrap
        Replicates and percentile intervals.

    Raises
    ------
    MreError
        As `uncertainty`, and fewer than two replicates.

    References
    ----------
    Davison and Hinkley 1997, https://doi.org/10.1017/CBO9780511802843, section 8.2.3
    """
    seed, level = draw_seed(seed), number(level, "level")
    replicates = whole(replicates, "replicates", 2, MOST_REPLICATES)
    names, rows, intervals, blocks = _core.fit_bootstrap(
        problem, x, replicates, seed, level, threads=workers(threads)
    )
    by_name = dict(zip((name for name, _ in names), intervals, strict=True))
    return Bootstrap(level, seed, dict(names), rows, by_name, tuple(blocks))
