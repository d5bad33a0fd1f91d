"""Figure 12 and Table 3: MAFSA with 30 to 70 fish, under three readings of the paper."""

import time
from typing import TYPE_CHECKING, Any

import numpy as np

from .._core import Problem
from ..crew import Crew
from ..results import SwarmResult
from ..swarms import mafsa
from .campaign import Case
from .effort import Effort
from .paper import POPULATIONS, TABLE_3_FITNESS, TABLE_3_SECONDS
from .readings import MAFSA_READINGS
from .section import Claim, Section, Table
from .style import LINES, figure
from .swarm_runs import GAP_HEADER, best_known, curve_by_iteration, in_words, seeds, summarise

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_SHOWN = ("literal", "no crowd test", "one step")
"""Readings: the default, and two that leave the swarm further from the optimum."""
_FLAT = 0.15
"""Change of the fitness that the paper calls very slight: its own is 13 %."""
_LITTLE = 0.01
"""Share of the fitness by which a change counts as one."""


def measure(case: Case, effort: Effort, seed: int, crew: Crew) -> tuple[dict[str, Any], dict[str, Any]]:
    """Run every population from every seed; numbers, and seconds apart from them."""
    problem = Problem(case.recording, "sinh")
    optimum = best_known(problem)
    jobs = [(r, n, s) for r in _SHOWN for n in POPULATIONS for s in seeds(seed, effort.seeds)]

    def work(job: tuple[str, int, int]) -> tuple[SwarmResult, float]:
        reading, fish, one = job
        start = time.perf_counter()
        run = mafsa(problem, seed=one, n_fish=fish, **MAFSA_READINGS[reading], **crew.options)
        return run, time.perf_counter() - start

    done = dict(zip(jobs, crew.run("Figure 12 and Table 3", work, jobs), strict=True))
    data: dict[str, Any] = {"test": case.name, "optimum_N2": optimum, "readings": {}}
    times: dict[str, Any] = {}
    for reading in _SHOWN:
        runs = {n: [r for (a, b, _), (r, _) in done.items() if (a, b) == (reading, n)] for n in POPULATIONS}
        finals = np.array([[run.fitness for run in runs[n]] for n in POPULATIONS])
        data["readings"][reading] = {
            "populations": {
                str(n): summarise(runs[n], optimum) | {"curve": curve_by_iteration(runs[n])}
                for n in POPULATIONS
            },
            "each_better_than_the_smaller": float(np.mean(np.all(np.diff(finals, axis=0) < 0, axis=0))),
        }
        times[reading] = {
            str(n): float(np.median([s for (a, b, _), (_, s) in done.items() if (a, b) == (reading, n)]))
            for n in POPULATIONS
        }
    return data, {"median_seconds": times}


def draw(data: dict[str, Any]) -> "dict[str, Figure]":
    """Draw the median curves, one panel a reading, and the band of 80 % of the runs with the fewest fish."""
    fig = figure(4.0 * len(data["readings"]), 4.0)
    panels = fig.subplots(1, len(data["readings"]), sharey=True, squeeze=False)[0]
    for axis, (reading, found) in zip(panels, data["readings"].items(), strict=True):
        for line, (n, summary) in zip(LINES, found["populations"].items(), strict=True):
            curve = summary["curve"]
            axis.plot(curve["iteration"], curve["median"], color="black", linestyle=line, label=f"{n} fish")
        curve = found["populations"][str(POPULATIONS[0])]["curve"]
        axis.fill_between(curve["iteration"], curve["lower"], curve["upper"], color="0.88", linewidth=0)
        axis.axhline(data["optimum_N2"], color="0.5", linewidth=0.8)
        axis.set_yscale("log")
        axis.set_title(reading, fontsize="medium")
        axis.set_xlabel("iteration")
    panels[0].set_ylabel("fitness / N²")
    panels[-1].legend(
        handlelength=4,
        fontsize="small",
        title=f"grey: 80 % of runs, {POPULATIONS[0]} fish",
        title_fontsize="small",
    )
    return {"figure12_population": fig}


def section(case: Case, effort: Effort, seed: int, crew: Crew) -> Section:
    """Figure 12 and Table 3."""
    data, times = measure(case, effort, seed, crew)
    tables = [_paper()]
    for reading, found in data["readings"].items():
        rows = tuple(
            (
                n,
                f"{s['fitness']['median']:.5g}",
                *in_words(s),
                f"{1000 * times['median_seconds'][reading][n]:.0f}",
            )
            for n, s in found["populations"].items()
        )
        header = ("fish", "median fitness / N²", *GAP_HEADER, "median time / ms")
        tables.append(Table(f"{reading}: {effort.seeds} seeds each", header, rows))
    return Section(
        name="figure12",
        title=f"Figure 12 and Table 3: population, {case.name}",
        data=data,
        figures=draw(data),
        tables=tuple(tables),
        claims=tuple(_claims(data)),
        notes=(f"The exact optimum is {data['optimum_N2']:.6g} N². Times differ from run to run.",),
        times=times,
    )


def _paper() -> Table:
    last = TABLE_3_FITNESS[-1]
    rows = tuple(
        (str(n), f"{fitness:.3f}", f"{fitness / last:.2f}", f"{seconds:.1f}")
        for n, fitness, seconds in zip(POPULATIONS, TABLE_3_FITNESS, TABLE_3_SECONDS, strict=True)
    )
    header = ("fish", "fitness", f"over that of {POPULATIONS[-1]} fish", "time / s")
    return Table("the paper's Table 3: one run each on its own recording", header, rows)


def _claims(data: dict[str, Any]) -> list[Claim]:
    """Accuracy with the number of fish, and the choice of 50."""

    def medians(reading: str) -> dict[int, float]:
        rows = data["readings"][reading]["populations"]
        return {n: rows[str(n)]["fitness"]["median"] for n in POPULATIONS}

    def gained(reading: str, few: int) -> float:
        of = medians(reading)
        return of[few] / of[POPULATIONS[-1]] - 1

    def verdict(large: dict[str, bool]) -> Any:
        return "reproduced" if all(large.values()) else "depends" if any(large.values()) else "contradicted"

    first, last = POPULATIONS[0], POPULATIONS[-1]
    gains = {reading: gained(reading, first) for reading in data["readings"]}
    ordered = {r: found["each_better_than_the_smaller"] for r, found in data["readings"].items()}
    late = {reading: gained(reading, 50) for reading in data["readings"]}
    literal = data["readings"][_SHOWN[0]]["populations"]
    grows = literal[str(last)]["evaluations"]["median"] / literal[str(first)]["evaluations"]["median"]
    return [
        Claim(
            "More fish give a higher accuracy.",
            verdict({r: gain > _LITTLE for r, gain in gains.items()}),
            f"The median fitness with {first} fish is above that with {last} by "
            + "; ".join(f"{100 * gain:.2f} % ({r})" for r, gain in gains.items())
            + f"; in the paper by {100 * (TABLE_3_FITNESS[0] / TABLE_3_FITNESS[-1] - 1):.0f} %. Runs with"
            " the same seed fall at every step from 30 to 70 fish, as the paper's do, in "
            + "; ".join(f"{100 * share:.0f} % ({r})" for r, share in ordered.items())
            + " of the seeds.",
        ),
        Claim(
            "Beyond 50 fish the fitness hardly varies.",
            verdict({r: abs(gain) <= _FLAT for r, gain in late.items()}),
            "From 50 to 70 fish the median falls by "
            + "; ".join(f"{100 * gain / (1 + gain):.2f} % ({r})" for r, gain in late.items())
            + f"; in the paper by {100 * (1 - TABLE_3_FITNESS[-1] / TABLE_3_FITNESS[2]):.0f} %.",
        ),
        Claim(
            "More fish take more time.",
            "reproduced" if grows > 1 + _LITTLE else "contradicted",
            f"Evaluations grow by a factor of {grows:.2f} from {first} to {last} fish"
            f" ({last / first:.2f} times as many); the paper's time grows by"
            f" {TABLE_3_SECONDS[-1] / TABLE_3_SECONDS[0]:.2f}.",
        ),
    ]
