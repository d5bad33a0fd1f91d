"""Figure 13: AFSA, PSO and MAFSA, by iterations as in the paper, and by evaluations.

An iteration of 50 fish with 50 looks each costs thousands of evaluations, one of 50 particles costs 50.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from ..crew import Crew
from .budgets import run_budgets
from .campaign import Case
from .effort import Effort
from .paper import ITERATIONS
from .section import Claim, Section, Table
from .style import LINES, figure
from .swarm_runs import CLOSE, CONVERGED, GAP_HEADER, SETTLED, in_words

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_ENDS = ("settled", "converged")
_TITLES = {
    "iterations": f"{ITERATIONS} iterations each, as in the paper",
    "evaluations_of_mafsa": "as many evaluations as MAFSA takes in the median",
    "evaluations_of_pso": "as many evaluations as PSO takes",
}


def draw(data: dict[str, Any]) -> "dict[str, Figure]":
    """Draw the medians by iteration and by evaluations."""
    fig = figure(9.0, 4.0)
    left, right = fig.subplots(1, 2, sharey=True)
    for line, (name, row) in zip(LINES, data["budgets"]["iterations"]["algorithms"].items(), strict=False):
        curve = row["curve"]
        left.plot(curve["iteration"], curve["median"], color="black", linestyle=line, label=name)
        left.fill_between(
            curve["iteration"], curve["lower"], curve["upper"], color="0.5", alpha=0.2, linewidth=0
        )
    left.set_xlabel("iteration")
    left.set_ylabel("fitness / N²: median and 80 % of the runs")
    by_name = data["budgets"]["evaluations_of_mafsa"]["algorithms"]
    for line, name in zip(LINES, ("AFSA", "PSO", "MAFSA"), strict=False):
        curve = by_name[name]["curve_by_evaluations"]
        right.plot(curve["evaluations"], curve["median"], color="black", linestyle=line, label=name)
        right.fill_between(
            curve["evaluations"], curve["lower"], curve["upper"], color="0.5", alpha=0.2, linewidth=0
        )
    right.set_xscale("log")
    right.set_xlabel("evaluations, the same for all")
    for axis in (left, right):
        axis.axhline(data["optimum_N2"], color="0.5", linewidth=0.8)
        axis.set_yscale("log")
        axis.legend()
    return {"figure13_algorithms": fig}


def section(case: Case, effort: Effort, seed: int, crew: Crew) -> Section:
    """Figure 13."""
    data = run_budgets(case, effort, seed, crew)
    tables = []
    for budget, found in data["budgets"].items():
        rows = tuple(
            (
                name,
                *in_words(row),
                *(f"{row[end][by]['median']:.0f}" for end in _ENDS for by in ("iteration", "evaluations")),
            )
            for name, row in found["algorithms"].items()
        )
        header = (
            "algorithm",
            *GAP_HEADER,
            *(f"{end}: {by}" for end in _ENDS for by in ("iteration", "evaluation")),
        )
        tables.append(Table(f"{_TITLES[budget]}; {effort.seeds} seeds", header, rows))
    return Section(
        name="figure13",
        title=f"Figure 13: algorithms, {case.name}",
        data=data,
        figures=draw(data),
        tables=tuple(tables),
        claims=tuple(_claims(data["budgets"])),
        notes=(
            f"Settled: {100 * SETTLED:g} % of the whole descent is left, which is what a linear plot shows."
            f" Converged: the fitness is within {100 * CONVERGED:g} % of its final value. Both in the"
            " median.",
        ),
    )


def _claims(budgets: dict[str, Any]) -> Sequence[Claim]:
    by_iteration = budgets["iterations"]["algorithms"]
    large, small = budgets["evaluations_of_mafsa"], budgets["evaluations_of_pso"]

    def gap(of: dict[str, Any], name: str, which: str = "median") -> str:
        return f"{round(100 * of[name]['gap'][which], 3):.4g} %"

    def when(name: str, end: str, by: str) -> float:
        return float(by_iteration[name][end][by]["median"])

    ways = [(end, by) for end in _ENDS for by in ("iteration", "evaluations")]
    names = ("AFSA", "MAFSA", "PSO")
    moments = "; ".join(
        f"{end}, {by}: " + ", ".join(f"{name} {when(name, end, by):.0f}" for name in names)
        for end, by in ways
    )
    first = [when("AFSA", *way) < min(when("MAFSA", *way), when("PSO", *way)) for way in ways]
    quicker = [when("MAFSA", *way) < when("PSO", *way) for way in ways]
    worst = max(by_iteration, key=lambda name: by_iteration[name]["gap"]["median"])
    ahead = [
        share > 0.5
        for budget in budgets.values()
        for name, share in budget["lower_than_pso"].items()
        if name.startswith("MAFSA")
    ]
    surer = [
        row["found"] > budget["algorithms"]["PSO"]["found"]
        for budget in budgets.values()
        for name, row in budget["algorithms"].items()
        if name.startswith("MAFSA")
    ]

    def compared(budget: dict[str, Any]) -> str:
        rows = budget["algorithms"]
        return "; ".join(
            f"{name} comes within {100 * CLOSE:g} % of the optimum in {100 * row['found']:.0f} % of the"
            f" runs, gap {gap(rows, name)} in the median, {gap(rows, name, 'largest')} at most"
            + (
                f", ends below PSO in {100 * budget['lower_than_pso'][name]:.0f} % of pairs"
                if name != "PSO"
                else ""
            )
            for name, row in rows.items()
            if name != "AFSA"
        )

    return (
        Claim(
            "AFSA converges first.",
            _verdict(first),
            f"Medians: {moments}.",
        ),
        Claim(
            "AFSA converges prematurely.",
            "reproduced" if worst == "AFSA" else "contradicted",
            f"After {ITERATIONS} iterations its median gap to the exact optimum is"
            f" {gap(by_iteration, 'AFSA')}; MAFSA's is {gap(by_iteration, 'MAFSA')}, PSO's"
            f" {gap(by_iteration, 'PSO')}. With MAFSA's evaluations AFSA comes to"
            f" {gap(large['algorithms'], 'AFSA')}.",
        ),
        Claim(
            "MAFSA reaches its optimum more quickly than PSO.",
            _verdict(quicker),
            f"It is ahead in {sum(quicker)} of {len(quicker)} ways to count: settled or converged, by"
            " iterations or by evaluations.",
        ),
        Claim(
            "MAFSA identifies more accurately than PSO.",
            _verdict([*ahead, *surer]),
            f"{ITERATIONS} iterations each: {compared(budgets['iterations'])}. MAFSA's evaluations for both:"
            f" {compared(large)}. PSO's evaluations for both: {compared(small)}.",
        ),
    )


def _verdict(holds: Sequence[bool]) -> Any:
    return "reproduced" if all(holds) else "depends" if any(holds) else "contradicted"
