"""An identification as JSON."""

from dataclasses import asdict
from typing import Any

from .certificate import Certificate
from .identify import Identification


def describe(found: Identification) -> dict[str, Any]:
    """Content of ``identification.json``: runs with their history, and the fit of every recording."""
    runs = []
    for run in found.runs:
        runs.append(
            {
                "algorithm": run.algorithm,
                "parameters": [asdict(parameter) for parameter in run.parameters],
                "fitness": run.fitness,
                "unit": run.unit,
                "rms_N": run.rms,
                "gap": run.gap,
                "certificate": _certificate(run.certificate),
                "reason": str(run.reason),
                "iterations": run.n_iterations,
                "evaluations": run.n_evaluations,
                "failures": run.n_failures,
                "behaviours": dict(run.behaviours),
                "settings": dict(run.settings),
                "history": {name: run.history[name].tolist() for name in run.history.dtype.names or ()},
            }
        )
    return {
        "schema": "mre-core/identification/1",
        "model": found.model.name,
        "optimizer": found.optimizer,
        "seed": found.seed,
        "interrupted": found.interrupted,
        "runs": runs,
        "fits": [asdict(fit) for fit in found.fits],
    }


def _certificate(found: Certificate | None) -> dict[str, Any] | None:
    return None if found is None else asdict(found) | {"statement": str(found)}
