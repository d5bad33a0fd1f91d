"""Optimisers side by side: time, evaluations, and how far from the best known optimum they stop."""

import ctypes
import math
import os
import statistics
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import partial

import kernels_numpy
import mre_core
from kernel_race import ours
from machine import Rivals
from objective import Objective, TimeIsUp
from others import BATCHED, SINGLE, Optimizer
from problems import Case, Kernel
from race import short

SPENT = 10.0  # seconds after which an optimiser gets no further seed


@dataclass(frozen=True)
class Effort:
    """How much is run."""

    seeds: int
    limit: float
    """Seconds after which a run is stopped."""


@dataclass(frozen=True)
class Outcome:
    """One run."""

    seconds: float
    evaluations: int | None
    """None where nobody counted."""
    fitness: float
    stopped: bool
    """By the limit."""


@dataclass
class Contestant:
    """An optimiser on a fitness."""

    name: str
    fitness: str
    threads: int
    run: Callable[[int], Outcome]
    outcomes: list[Outcome] = field(default_factory=list)
    ratios: list[float] = field(default_factory=list)

    def wants_more(self, effort: Effort) -> bool:
        spent = sum(outcome.seconds for outcome in self.outcomes)
        return len(self.outcomes) < effort.seeds and spent < SPENT


def own(case: Case, effort: Effort) -> list[Contestant]:
    """Those of mre_core, hybrid first: it is the default and the reference."""
    cores = os.cpu_count() or 1

    def entry(name: str, threads: int, solve: Callable[[int], mre_core.SwarmResult]) -> Contestant:
        def run(seed: int) -> Outcome:
            start = time.perf_counter()
            found = solve(seed)
            stopped = found.reason is mre_core.StopReason.TIME_LIMIT
            return Outcome(time.perf_counter() - start, found.n_evaluations, found.fitness, stopped)

        return Contestant(f"mre-core {name}", "own", threads, run)

    def seeded(algorithm: Callable[..., mre_core.SwarmResult], threads: int) -> Contestant:
        limits = {"time_limit": effort.limit, "threads": threads}
        return entry(algorithm.__name__, threads, lambda seed: algorithm(case.problem, seed=seed, **limits))

    swarms = [seeded(a, 1) for a in (mre_core.mafsa, mre_core.afsa, mre_core.pso)]
    exact = entry("exact", 1, lambda seed: mre_core.exact(case.problem, threads=1))
    return [seeded(mre_core.hybrid, 1), exact, *swarms, seeded(mre_core.mafsa, cores)]


def others(case: Case, effort: Effort, rivals: Rivals) -> Iterator[Contestant]:
    """Those of other packages; each on the fitness that its kind of objective gets in practice."""

    def entry(name: str, label: str, optimizer: Optimizer, kernel: Kernel) -> Contestant:
        def run(seed: int) -> Outcome:
            objective = Objective(case, kernel, effort.limit)
            start = time.perf_counter()
            stopped = False
            try:
                optimizer(objective, seed)
            except TimeIsUp:
                stopped = True
            seconds = time.perf_counter() - start
            return Outcome(seconds, objective.evaluations, objective.best, stopped)

        return Contestant(name, label, 1, run)

    batched = {"mre-core, batch": ours(case)}
    single = {"mre-core, single": ours(case)}
    if case.model == "sinh":
        batched = {"NumPy, batch": kernels_numpy.sinh(case, 64)} | batched
        single = {"NumPy, single": kernels_numpy.sinh(case)}
    elif rivals.has("numba"):
        import kernels_numba

        single = {"Numba, single": kernels_numba.bouc_wen(case)["scalar, fastmath"]}
    if case.model == "sinh" and rivals.has("scipy"):
        yield projection(case)
    if case.model == "sinh" and rivals.c is not None:
        yield projection_in_c(case, rivals.c)
    for optimizers, kernels in ((BATCHED, batched), (SINGLE, single)):
        for name, (module, optimizer) in optimizers.items():
            if rivals.has(module):
                for label, kernel in kernels.items():
                    yield entry(name, label, optimizer, kernel)


def seedless(name: str, fitness: str, solve: Callable[[], float]) -> Contestant:
    """One that finds the same fitness with every seed, and counts no evaluations."""

    def run(_seed: int) -> Outcome:
        start = time.perf_counter()
        found = solve()
        return Outcome(time.perf_counter() - start, None, found, False)

    return Contestant(name, fitness, 1, run)


def projection(case: Case) -> Contestant:
    """What SciPy can do with the structure of the model: least squares for every beta."""
    from projection import exact_optimum

    solve = partial(exact_optimum, case.problem, case.problem.recordings[0])
    return seedless("SciPy lsq_linear in minimize_scalar", "NumPy", solve)


def projection_in_c(case: Case, kernels: ctypes.CDLL) -> Contestant:
    """The same in C: linear coefficients without bounds, a grid of beta and golden sections."""
    import kernels_c

    return seedless("C, golden sections", "C", partial(kernels_c.exact, kernels, case))


def table(case: Case, effort: Effort, rivals: Rivals) -> Iterator[str]:
    """Run all and print one row each."""
    reference, *entries = [*own(case, effort), *others(case, effort, rivals)]
    compile_kernels(case, entries)
    for seed in range(effort.seeds):
        before = reference.run(seed)
        reference.outcomes.append(before)
        for entry in entries:
            if entry.wants_more(effort):
                outcome, after = entry.run(seed), reference.run(seed)
                entry.outcomes.append(outcome)
                entry.ratios.append(2 * outcome.seconds / (before.seconds + after.seconds))
                before = after
    reference.ratios.append(1.0)
    everyone = [reference, *entries]
    optimum = min(outcome.fitness for entry in everyone for outcome in entry.outcomes)
    yield f"Best known optimum {optimum:.10g} N^2."
    yield ""
    yield (
        "| optimiser | fitness | threads | seconds | time, hybrid = 1 | evaluations | median gap | worst gap "
        "| seeds |"
    )
    yield "|---|---|---:|---:|---:|---:|---:|---:|---:|"
    for entry in everyone:
        yield row(entry, optimum)


def compile_kernels(case: Case, entries: list[Contestant]) -> None:
    """Compilation at the first call is no part of a run."""
    for entry in entries:
        if entry.fitness.startswith("Numba"):
            entry.run(0)
            break
    case.problem.fitness(case.candidates(2))


def row(entry: Contestant, optimum: float) -> str:
    """One line of the table."""
    median = statistics.median
    counted = [outcome.evaluations for outcome in entry.outcomes if outcome.evaluations is not None]
    gaps = [outcome.fitness / optimum - 1 for outcome in entry.outcomes]
    seconds = median(outcome.seconds for outcome in entry.outcomes)
    stopped = " (stopped)" if any(outcome.stopped for outcome in entry.outcomes) else ""
    cells = [
        f"{seconds:.3g}{stopped}",
        short(median(entry.ratios)),
        f"{median(counted):,.0f}" if counted else "",
        percent(median(gaps)),
        percent(max(gaps)),
        str(len(entry.outcomes)),
    ]
    return f"| {entry.name} | {entry.fitness} | {entry.threads} | " + " | ".join(cells) + " |"


def percent(share: float) -> str:
    """Two significant digits."""
    if not math.isfinite(share):
        return "none found"
    if share < 1e-5:
        return "< 0.001 %"
    return f"{100 * share:.2g} %" if share < 1 else f"{100 * share:,.0f} %"
