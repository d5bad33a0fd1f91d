"""RMS errors of both models on every test of several campaigns: by swarms, and the best that is known."""

from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np

from .._core import Problem
from ..crew import Crew
from ..fits import exact, hybrid
from ..results import SwarmResult
from ..swarms import mafsa, pso
from .campaign import Campaign, Case
from .classical_search import classical_pso
from .effort import Effort
from .swarm_runs import seeds

BETTER = 0.01
"""Share of the rms error by which a model has to be better to count as better."""
_ROUNDING = 1e-6
"""Share of the force's rms below which an error is rounding."""
SEARCHES = {"pso": "PSO", "classical_pso": "PSO, eq. 1 and 2 as written", "mafsa": "MAFSA"}
_SWARMS: dict[str, Callable[..., SwarmResult]] = {"pso": pso, "classical_pso": classical_pso, "mafsa": mafsa}


def rms_errors(campaigns: Mapping[str, Campaign], effort: Effort, seed: int, crew: Crew) -> dict[str, Any]:
    """Fit both models to every test of every campaign, by swarms and as well as is known."""
    jobs = [
        (device, case, search, one)
        for device, campaign in campaigns.items()
        for case in campaign.cases
        for search, one in _searches(case, campaign, effort, seed)
    ]

    def work(job: tuple[str, Case, str, int]) -> float:
        _, case, search, one = job
        return _rms(case, search, one, effort, crew.options)

    errors = crew.run("Figure 11", work, jobs)
    found: dict[tuple[str, str], dict[str, list[float]]] = {}
    for (device, case, search, _), rms in zip(jobs, errors, strict=True):
        found.setdefault((device, case.name), {}).setdefault(search, []).append(rms)
    return {
        device: [_row(case, found[device, case.name]) for case in campaign.cases]
        for device, campaign in campaigns.items()
    }


def _searches(case: Case, campaign: Campaign, effort: Effort, seed: int) -> Iterable[tuple[str, int]]:
    yield from (("sinh exact", seed), ("sinh mafsa", seed), ("exact", seed), ("hybrid", seed))
    for one in seeds(seed, effort.bouc_wen_seeds):
        yield "pso", one
        yield "classical_pso", one
    if case in campaign.by_current:  # an evaluation costs what an integration costs: these tests only
        yield "mafsa", seed


def _rms(case: Case, search: str, seed: int, effort: Effort, options: dict[str, Any]) -> float:
    iterations = effort.bouc_wen_iterations
    if search == "sinh exact":
        return exact(Problem(case.recording, "sinh"), threads=1).rms
    if search == "sinh mafsa":
        return mafsa(Problem(case.recording, "sinh"), seed=seed, **options).rms
    problem = Problem(case.recording, "bouc_wen")
    if search == "exact":
        return exact(problem, threads=1).rms
    if search == "hybrid":
        return hybrid(problem, seed=seed, **options).rms
    return _SWARMS[search](problem, seed=seed, max_iterations=iterations, **options).rms


def _row(case: Case, found: dict[str, list[float]]) -> dict[str, Any]:
    assert case.recording.force is not None  # a Case has one
    force = float(np.std(case.recording.force[slice(*case.recording.scored)]))
    sinh = {"mafsa": found.pop("sinh mafsa"), "exact": found.pop("sinh exact")}
    return {
        "test": case.name,
        "current_A": case.current,
        "amplitude_mm": case.amplitude,
        "force_rms_N": force,
        "sinh": {**sinh, "best": _best(sinh, force)},
        "bouc_wen": {**found, "best": _best(found, force)},
    }


def _best(found: dict[str, list[float]], force: float) -> float:
    """Smallest error that is known, or where that is as good as zero, what rounding makes of it."""
    return max(min(min(rms) for rms in found.values()), _ROUNDING * force)


def summarise_errors(rows: list[dict[str, Any]]) -> dict[str, Any]:
    """How often each model is better, and what each search costs Bouc-Wen."""
    sinh = np.array([row["sinh"]["best"] for row in rows])
    by_mafsa = np.array([row["sinh"]["mafsa"][0] for row in rows])
    best = np.array([row["bouc_wen"]["best"] for row in rows])
    summary: dict[str, Any] = {
        "tests": len(rows),
        "sinh_better": int(np.sum(sinh < (1 - BETTER) * best)),
        "bouc_wen_better": int(np.sum(best < (1 - BETTER) * sinh)),
        "largest_relative_rms": {
            model: max(row[model]["best"] / row["force_rms_N"] for row in rows)
            for model in ("sinh", "bouc_wen")
        },
        "median_ratio": float(np.median(best / sinh)),
        "searches": {},
    }
    for search in SEARCHES:
        tried = [i for i, row in enumerate(rows) if search in row["bouc_wen"]]
        runs = [np.array(rows[i]["bouc_wen"][search]) for i in tried]
        excess = np.concatenate([run / best[i] - 1 for i, run in zip(tried, runs, strict=True)])
        typical = np.array([np.median(run) for run in runs])
        summary["searches"][search] = {
            "runs": len(excess),
            "tests": len(tried),
            "median_excess": float(np.median(excess)),
            "largest_excess": float(excess.max()),
            "largest_rms_N": float(max(run.max() for run in runs)),
            "found": float(np.mean(excess <= BETTER)),
            "sinh_better": int(np.sum(by_mafsa[tried] < (1 - BETTER) * typical)),
        }
    return summary
