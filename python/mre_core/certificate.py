"""Proof that nothing in the box is better than what was found."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from . import _core
from ._core import Problem
from .checks import workers
from .errors import shown
from .stored import number

if TYPE_CHECKING:
    from .results import SwarmResult


@dataclass(frozen=True)
class Certificate:
    """How much better than a result any other parameters in the box can be at most."""

    tolerance: float
    """Gap that was asked for, as a share of the fitness."""
    lower: float
    """Fitness in N^2 that nothing in the box goes below."""
    gap: float
    """How far `lower` is below the fitness of the result, as a share of it."""
    certified: bool
    """True where the gap is within the tolerance."""
    n_evaluations: int
    """Intervals of beta that were bounded."""

    def __str__(self) -> str:
        if self.certified:
            return f"no better optimum exists in the box beyond {self.tolerance:g} of the fitness"
        return f"a fitness that is up to {100 * self.gap:.2g} % lower is not ruled out in the box"


def certificate(
    problem: Problem, result: "SwarmResult", tolerance: float = 1e-9, *, threads: int | None = None
) -> Certificate:
    """Bound the fitness from below over the whole box of a problem.

    The whole interval of beta is covered by pieces on each of which a linear bound holds for all
    coefficients in their box; pieces are halved until the bound reaches the fitness of the result. It is
    true to rounding, about 1e-12 of the fitness.

    Parameters
    ----------
    problem : Problem
        Of `kelvin_voigt` or `sinh`, with a current that is constant within each recording.
    result : SwarmResult
        Found for this problem by any optimizer.
    tolerance : float
        Gap that counts as none, as a share of the fitness; above 0 and below 1.
    threads : int, optional
        All cores by default. The result does not depend on it.

    Returns
    -------
    Certificate
        It is `certified` where no parameters in the box are better by more than the tolerance.

    Raises
    ------
    MreError
        No certificate exists for the model (`bouc_wen`) or for its changing current, or the tolerance is
        not allowed (a ValueError).
    """
    from .results import SwarmResult  # which holds a Certificate

    if not isinstance(result, SwarmResult):
        raise TypeError(f"result is {shown(result)}: wanted the SwarmResult of an optimizer")
    tolerance = number(tolerance, "tolerance")
    lower, gap, certified, evaluations = _core.certify(problem, result.x, tolerance, threads=workers(threads))
    return Certificate(tolerance, lower, gap, certified, evaluations)
