"""What an optimisation returns."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from math import sqrt
from textwrap import wrap
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ._core import Problem, Swarm
from .certificate import Certificate
from .words import number_of

if TYPE_CHECKING:
    from .uncertainty import Uncertainty


_FAR = 100.0
"""Times the fitness above which a gap in per cent says nothing."""


class StopReason(StrEnum):
    """Why an optimisation stopped."""

    MAX_ITERATIONS = "max_iterations"
    MAX_EVALUATIONS = "max_evaluations"
    TIME_LIMIT = "time_limit"
    TARGET = "target"
    CALLBACK = "callback"
    INTERRUPTED = "interrupted"


@dataclass(frozen=True)
class Parameter:
    """A parameter with its value, unit and the box it was searched in."""

    name: str
    value: float
    unit: str
    lower: float
    upper: float
    on_bound: str | None = None
    """``"lower"`` or ``"upper"`` where the value lies on that bound."""
    at_limit: bool = False
    """True where that bound is the limit of what is physically admissible."""

    @property
    def note(self) -> str:
        """A remark where the box was active; empty otherwise."""
        if self.on_bound is None:
            return ""
        return "at its physical limit" if self.at_limit else f"on its {self.on_bound} bound: widen it"


@dataclass(frozen=True)
class SwarmResult:
    """Outcome of an optimiser, with SciPy's names `x`, `fun`, `nfev`, `nit` beside ours."""

    algorithm: str
    parameters: tuple[Parameter, ...]
    fitness: float
    """Best fitness ever evaluated: mean squared error in N^2 (eq. 5), or the user's function."""
    unit: str
    """Unit of the fitness; empty for a user's function."""
    reason: StopReason
    seed: int
    n_iterations: int
    n_evaluations: int
    n_failures: int
    """Evaluations that cost infinity, such as simulations that cannot be computed."""
    history: NDArray[Any] = field(repr=False)
    """One row an iteration, the initial swarm first: best, mean, evaluations, range, step."""
    behaviours: Mapping[str, int]
    """How often each behaviour of the fish decided a move; zeros for particles."""
    settings: Mapping[str, Any] = field(repr=False)
    optimum: float | None = None
    """Best fitness known for the same problem, by `exact`; None where it was not looked for."""
    certificate: Certificate | None = None
    """Proof that nothing in the box is better; None where it was not asked for."""

    uncertainty: "Uncertainty | None" = field(default=None, repr=False)
    """By `identify`, where there are more samples than parameters."""

    @property
    def gap(self) -> float | None:
        """How far the fitness is above the best known one, as a share of it; None where no share is known."""
        if self.optimum is not None and self.fitness <= self.optimum:
            return 0.0
        if self.optimum is None or self.optimum <= 0:
            return None
        return self.fitness / self.optimum - 1

    @property
    def standing(self) -> str:
        """How far the fitness is above the best known one, in words; empty for a function's."""
        if self.optimum is None:
            return "not compared with the best known optimum" if self.unit else ""
        if self.fitness <= self.optimum:
            return "at the best known optimum"
        if self.gap is not None and self.gap < _FAR:
            return f"{100 * self.gap:.2g} % above the best known optimum"
        rms, least = sqrt(self.fitness), sqrt(max(self.optimum, 0.0))
        return f"far above the best known optimum (rms error {rms:.3g} N instead of {least:.2g} N)"

    @property
    def x(self) -> NDArray[np.float64]:
        """Best parameters, shape (d,)."""
        return np.array([parameter.value for parameter in self.parameters])

    @property
    def fun(self) -> float:
        """Same as `fitness`."""
        return self.fitness

    @property
    def nfev(self) -> int:
        """Same as `n_evaluations`."""
        return self.n_evaluations

    @property
    def nit(self) -> int:
        """Same as `n_iterations`."""
        return self.n_iterations

    @property
    def success(self) -> bool:
        """True where a finite fitness was found and nobody interrupted."""
        return bool(np.isfinite(self.fitness)) and self.reason is not StopReason.INTERRUPTED

    @property
    def rms(self) -> float:
        """Root of the fitness in N (eq. 9)."""
        return float(np.sqrt(self.fitness))

    @property
    def values(self) -> dict[str, float]:
        """Parameters by name."""
        return {parameter.name: parameter.value for parameter in self.parameters}

    def __str__(self) -> str:
        rows = [f"{self.algorithm}: fitness {self.fitness:.6g} {self.unit}".rstrip()]
        found = self.uncertainty
        intervals = [e.interval for e in found.parameters] if found else [""] * len(self.parameters)
        for p, interval in zip(self.parameters, intervals, strict=True):
            rows.append(f"  {p.name:<12} {p.value:>14.6g} {p.unit:<7} {interval:<22} {p.note}".rstrip())
        if found is not None:
            for d in found.derived:
                rows.append(f"  {d.name:<20} {d.value:>6.5g} {d.unit:<7} {d.interval}".rstrip())
            for sentence in found.words:
                rows += wrap(sentence, 98, initial_indent="  ", subsequent_indent="    ")
        if self.standing:
            rows.append(f"  {self.standing}")
        if self.certificate is not None:
            rows.append(f"  {self.certificate}")
        rows.append(
            f"  {number_of(self.n_iterations, 'iteration')}, {number_of(self.n_evaluations, 'evaluation')}"
            f" ({self.n_failures} failed), stopped by {self.reason}, seed {self.seed}"
        )
        return "\n".join(rows)


def collect(
    algorithm: str,
    swarm: Swarm,
    reason: StopReason,
    *,
    problem: Problem | None,
    box: tuple[list[str], NDArray[np.float64], NDArray[np.float64]],
    seed: int,
    settings: Mapping[str, Any],
) -> SwarmResult:
    """Put together the result of a swarm that has run."""
    x, cost = swarm.best
    parameters = parameters_at(x, problem, box)
    history = to_records(swarm.history)
    evaluations, failures = swarm.evaluations
    return SwarmResult(
        algorithm=algorithm,
        parameters=parameters,
        fitness=cost,
        unit="N^2" if problem is not None else "",
        reason=reason,
        seed=seed,
        n_iterations=max(len(history) - 1, 0),
        n_evaluations=evaluations,
        n_failures=failures,
        history=history,
        behaviours=swarm.behaviours,
        settings=dict(settings),
    )


def to_records(columns: Mapping[str, NDArray[Any]]) -> NDArray[Any]:
    """Join the columns of a history."""
    history = np.empty(len(columns["best"]), dtype=[(name, c.dtype) for name, c in columns.items()])
    for column, content in columns.items():
        history[column] = content
    history.setflags(write=False)
    return history


def parameters_at(
    x: NDArray[np.float64],
    problem: Problem | None,
    box: tuple[list[str], NDArray[np.float64], NDArray[np.float64]],
) -> tuple[Parameter, ...]:
    """Parameters with their units, bounds, and which of the bounds were active."""
    names, lower, upper = box
    units = problem.units if problem is not None else [""] * len(names)
    sides = problem.on_bound(x) if problem is not None else _on_bound(x, lower, upper)
    limits = problem.limits if problem is not None else [(-np.inf, np.inf)] * len(names)
    parameters = []
    for name, value, unit, low, high, side, limit in zip(
        names, x.tolist(), units, lower.tolist(), upper.tolist(), sides, limits, strict=True
    ):
        on_bound = {-1: "lower", 0: None, 1: "upper"}[side]
        at_limit = (side < 0 and low == limit[0]) or (side > 0 and high == limit[1])
        parameters.append(Parameter(name, value, unit, low, high, on_bound, at_limit))
    return tuple(parameters)


def _on_bound(x: NDArray[np.float64], lower: NDArray[np.float64], upper: NDArray[np.float64]) -> list[int]:
    unit = (x - lower) / (upper - lower)
    return [-1 if u < 1e-6 else int(u > 1 - 1e-6) for u in unit]
