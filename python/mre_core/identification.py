"""An identified model and how it was found."""

from dataclasses import dataclass, field

from ._core import Problem
from .fits import exact
from .measure import Fit
from .model import Model
from .results import StopReason, SwarmResult
from .uncertainty import Bootstrap, Profile, bootstrap, profile


@dataclass(frozen=True)
class Identification:
    """An identified model and how it was found."""

    model: Model
    runs: tuple[SwarmResult, ...]
    """One run for each group of recordings with the same constant current."""
    fits: tuple[Fit, ...]
    optimizer: str
    seed: int
    problems: tuple[Problem, ...] = field(repr=False)
    """What each run solved."""

    def profile(self, *, level: float = 0.95, threads: int | None = None) -> list[tuple[Profile, ...]]:
        """Profile-likelihood intervals of every run: see `mre_core.profile`.

        They are about the best known optimum, also of a run that stopped short of it.
        """
        found = []
        for problem, run in zip(self.problems, self.runs, strict=True):
            at_best = run.optimum is not None and run.fitness <= run.optimum
            x = run.x if at_best else min(run, exact(problem, threads=threads), key=lambda one: one.fitness).x
            found.append(profile(problem, x, level=level, threads=threads))
        return found

    def bootstrap(
        self,
        replicates: int = 1000,
        *,
        seed: int | None = None,
        level: float = 0.95,
        threads: int | None = None,
    ) -> list[Bootstrap]:
        """Bootstrap of every run, by default with the same seed: see `mre_core.bootstrap`."""
        seed = self.seed if seed is None else seed
        pairs = zip(self.problems, self.runs, strict=True)
        return [
            bootstrap(problem, run.x, replicates, seed=seed, level=level, threads=threads)
            for problem, run in pairs
        ]

    @property
    def interrupted(self) -> bool:
        """True where Ctrl-C ended a run early."""
        return any(run.reason is StopReason.INTERRUPTED for run in self.runs)

    @property
    def result(self) -> SwarmResult:
        """The only run.

        Raises
        ------
        ValueError
            There are several.
        """
        if len(self.runs) != 1:
            raise ValueError(f"there are {len(self.runs)} runs, one a current: see runs")
        return self.runs[0]

    def __str__(self) -> str:
        return "\n".join(str(run) for run in self.runs)
