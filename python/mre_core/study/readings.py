"""Every reading of the passages in which the paper contradicts itself, on one test."""

from itertools import product
from typing import TYPE_CHECKING, Any

import numpy as np

from .._core import Problem
from ..crew import Crew
from ..results import SwarmResult
from ..swarms import afsa, mafsa, pso
from .campaign import Case
from .effort import Effort
from .section import Claim, Section, Table, Verdict
from .style import figure
from .swarm_runs import GAP_HEADER, best_known, in_words, seeds, summarise

if TYPE_CHECKING:
    from matplotlib.figure import Figure

# Each passage: readings by their name, the literal one first and unnamed.
_CROWD = {
    "": {},
    "crowd within sight": {"crowd": "visual"},
    "no crowd test": {"crowd": "none"},
    "within sight": {"neighbourhood": "visual"},
    "within sight, no crowd test": {"neighbourhood": "visual", "crowd": "none"},
}
_SEARCH = {"": {}, "one step": {"search": "step"}}
_SCHEDULE = {"": {}, "eq. 8 as an assignment": {"schedule": "recursive"}}
_AFSA_READINGS: dict[str, dict[str, Any]] = {
    "AFSA": {},
    "AFSA, no crowd test": {"crowd": "none"},
    "AFSA, jump to the best look": {"search": "best"},
    "AFSA, no crowd test, jump to the best look": {"crowd": "none", "search": "best"},
}


def _named() -> dict[str, dict[str, Any]]:
    readings = {}
    for parts in product(_CROWD.items(), _SEARCH.items(), _SCHEDULE.items()):
        name = ", ".join(name for name, _ in parts if name) or "literal"
        readings[name] = {key: value for _, settings in parts for key, value in settings.items()}
    return readings


MAFSA_READINGS: dict[str, dict[str, Any]] = _named()
"""Settings of `mafsa` by the name of the reading. Who looks only at those in sight counts the crowd there."""


def measure(case: Case, effort: Effort, seed: int, crew: Crew) -> dict[str, Any]:
    """Run every reading from every seed."""
    problem = Problem(case.recording, "sinh")
    optimum = best_known(problem)
    settings: dict[str, tuple[Any, dict[str, Any]]] = {
        **{name: (mafsa, options) for name, options in MAFSA_READINGS.items()},
        **{name: (afsa, options) for name, options in _AFSA_READINGS.items()},
        "PSO": (pso, {}),
    }
    jobs = [(name, one) for name in settings for one in seeds(seed, effort.seeds)]

    def work(job: tuple[str, int]) -> SwarmResult:
        algorithm, options = settings[job[0]]
        run: SwarmResult = algorithm(problem, seed=job[1], **options, **crew.options)
        return run

    done = list(zip(jobs, crew.run("readings of the paper", work, jobs), strict=True))
    return {
        "test": case.name,
        "optimum_N2": optimum,
        "readings": {
            name: summarise([run for (of, _), run in done if of == name], optimum) for name in settings
        },
    }


def draw(data: dict[str, Any]) -> "dict[str, Figure]":
    """Draw the gap of every reading: median, and from the smallest to the largest."""
    rows = list(data["readings"].items())[::-1]
    fig = figure(8.0, 0.8 + 0.24 * len(rows))
    axis = fig.subplots()
    at = np.arange(len(rows))
    gaps = {name: np.array([100 * row["gap"][name] for _, row in rows]) for name in rows[0][1]["gap"]}
    floor = 1e-4
    axis.hlines(at, np.maximum(gaps["smallest"], floor), np.maximum(gaps["largest"], floor), color="0.75")
    axis.hlines(
        at, np.maximum(gaps["lower"], floor), np.maximum(gaps["upper"], floor), color="0.5", linewidth=3
    )
    axis.plot(np.maximum(gaps["median"], floor), at, "ko", markersize=4)
    axis.set_xscale("log")
    axis.set_title("point: median; thick: 80 % of the runs; thin: all", fontsize="medium")
    axis.set_yticks(at, [name for name, _ in rows], fontsize="small")
    axis.set_xlabel("gap to the exact optimum / %")
    return {"readings_gap": fig}


def section(case: Case, effort: Effort, seed: int, crew: Crew) -> Section:
    """All readings."""
    data = measure(case, effort, seed, crew)
    rows = []
    for name, row in data["readings"].items():
        fired = row["behaviours"]
        rows.append((name, *in_words(row), *(f"{fired.get(b, 0):.0f}" for b in _BEHAVIOURS)))
    header = ("reading", *GAP_HEADER, *_BEHAVIOURS)
    return Section(
        name="readings",
        title=f"Readings of the contradictory passages: {case.name}",
        data=data,
        figures=draw(data),
        tables=(Table(f"{effort.seeds} seeds each; behaviours in the mean", header, tuple(rows)),),
        claims=_claims(data),
        notes=(
            "Literal: centre and best of the whole swarm, all of it counted in the crowd test, a searching"
            " fish jumps to the best of its looks, eq. 8 from the initial values. The other names say what"
            " differs.",
        ),
    )


_BEHAVIOURS = ("search", "swarm", "follow", "random")
_RARE = 0.01
"""Share of the moves below which a behaviour counts as never chosen."""


def _claims(data: dict[str, Any]) -> tuple[Claim, ...]:
    """Say what each modification does, from pairs of readings that differ in nothing else."""
    rows = data["readings"]
    literal = rows["literal"]
    swarms, moves = literal["behaviours"]["swarm"], sum(literal["behaviours"].values())
    gaps = {name: rows[name]["gap"]["median"] for name in MAFSA_READINGS}
    best, worst = min(gaps, key=lambda name: gaps[name]), max(gaps, key=lambda name: gaps[name])
    jump = _pairs(rows, "search", "step")
    whole = _pairs(rows, "neighbourhood", "visual")
    return (
        Claim(
            "Fish choose between searching, swarming and following.",
            "contradicted" if swarms < _RARE * moves else "reproduced",
            f"Read literally, MAFSA swarms in {swarms:.1f} of {moves:.0f} moves: the crowd test of the whole"
            " swarm all but forbids it. Over all readings the median gap lies between"
            f" {100 * gaps[best]:.3f} % ({best}) and {100 * gaps[worst]:.1f} % ({worst}); the literal one"
            f" has {100 * gaps['literal']:.3f} %.",
        ),
        Claim(
            "Moving directly to the best location in sight makes the search better.",
            _verdict(jump, "gap"),
            f"The median gap is smaller than with one step in {jump['gap']} of {jump['pairs']} pairs of"
            f" readings, the evaluations are fewer in {jump['evaluations']}.",
        ),
        Claim(
            "Centre and best of the whole swarm, instead of those within sight, cost less.",
            _verdict(whole, "evaluations"),
            f"Evaluations are fewer in {whole['evaluations']} of {whole['pairs']} pairs of readings, the"
            f" median gap is smaller in {whole['gap']}. What is saved for certain are the distances between"
            " fish, which cost less than evaluations.",
        ),
    )


def _pairs(rows: dict[str, Any], option: str, otherwise: str) -> dict[str, int]:
    """Compare readings that have an option at its default with those that differ in it alone."""
    found = {"pairs": 0, "gap": 0, "evaluations": 0}
    for name, settings in MAFSA_READINGS.items():
        changed = {**settings, option: otherwise}
        twins = [other for other, of in MAFSA_READINGS.items() if of == changed]
        if option in settings or not twins:
            continue
        found["pairs"] += 1
        for what in ("gap", "evaluations"):
            found[what] += rows[name][what]["median"] < rows[twins[0]][what]["median"]
    return found


def _verdict(pairs: dict[str, int], what: str) -> Verdict:
    return "reproduced" if pairs[what] == pairs["pairs"] else "depends" if pairs[what] else "contradicted"
