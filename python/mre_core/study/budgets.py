"""AFSA, PSO and MAFSA on one test under three budgets: iterations as in the paper, and evaluations."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from .._core import Problem
from ..crew import Crew
from ..results import SwarmResult
from ..swarms import afsa, mafsa, pso
from .campaign import Case
from .effort import Effort
from .paper import ITERATIONS
from .swarm_runs import best_known, curve_by_evaluations, curve_by_iteration, lower_share, seeds, summarise

Runs = dict[str, list[SwarmResult]]

_PARTICLES = 50
_SMALL = {"n_fish": 10, "try_number": 8}
"""A MAFSA whose iteration costs about what one of 50 particles costs."""
_ENDLESS = 100_000
"""Iterations of a run that its budget of evaluations ends."""


def run_budgets(case: Case, effort: Effort, seed: int, crew: Crew) -> dict[str, Any]:
    """Run all algorithms from every seed under three budgets."""
    problem = Problem(case.recording, "sinh")
    optimum = best_known(problem)
    first = seeds(seed, effort.seeds)

    def together(what: str, settings: Mapping[str, tuple[Any, dict[str, Any]]]) -> Runs:
        jobs = [(name, one) for name in settings for one in first]

        def work(job: tuple[str, int]) -> SwarmResult:
            algorithm, options = settings[job[0]]
            run: SwarmResult = algorithm(problem, seed=job[1], **options, **crew.options)
            return run

        done = list(zip(jobs, crew.run(what, work, jobs), strict=True))
        return {name: [run for (of, _), run in done if of == name] for name in settings}

    same = {"max_iterations": ITERATIONS}
    by_iterations = together("Figure 13", {"AFSA": (afsa, same), "PSO": (pso, same), "MAFSA": (mafsa, same)})
    large = round(float(np.median([run.n_evaluations for run in by_iterations["MAFSA"]])))
    small = by_iterations["PSO"][0].n_evaluations
    spent = np.median([run.history["evaluations"] for run in by_iterations["MAFSA"]], axis=0)
    short = max(1, int(np.argmax(spent >= small)))
    afsa_on = {"max_iterations": _ENDLESS}
    by_large = {
        "MAFSA": by_iterations["MAFSA"],
        **together(
            "Figure 13, evaluations of MAFSA",
            {
                "AFSA": (afsa, {**afsa_on, "max_evaluations": large}),
                "PSO": (pso, {"max_iterations": large // _PARTICLES - 1}),
            },
        ),
    }
    by_small = {
        "PSO": by_iterations["PSO"],
        **together(
            "Figure 13, evaluations of PSO",
            {
                "AFSA": (afsa, {**afsa_on, "max_evaluations": small}),
                f"MAFSA, {short} iterations": (mafsa, {"max_iterations": short, "max_evaluations": small}),
                "MAFSA, 10 fish, 8 looks": (mafsa, {**same, **_SMALL, "max_evaluations": small}),
            },
        ),
    }
    budgets = {
        "iterations": _describe(by_iterations, optimum),
        "evaluations_of_mafsa": _describe(by_large, optimum),
        "evaluations_of_pso": _describe(by_small, optimum),
    }
    for name, runs in by_iterations.items():
        budgets["iterations"]["algorithms"][name]["curve"] = curve_by_iteration(runs)
    return {"test": case.name, "optimum_N2": optimum, "budgets": budgets}


def _describe(runs: Runs, optimum: float) -> dict[str, Any]:
    return {
        "algorithms": {
            name: summarise(of, optimum) | {"curve_by_evaluations": curve_by_evaluations(of)}
            for name, of in runs.items()
        },
        "lower_than_pso": {name: lower_share(of, runs["PSO"]) for name, of in runs.items() if name != "PSO"},
    }
