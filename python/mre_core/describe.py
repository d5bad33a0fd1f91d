"""What ``identification.json`` holds."""

from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

from .certificate import Certificate
from .identification import Identification
from .results import SwarmResult
from .uncertainty import Bootstrap, Profile, Uncertainty


def describe(
    found: Identification,
    profiles: Sequence[Sequence[Profile]] = (),
    bootstraps: Sequence[Bootstrap] = (),
) -> dict[str, Any]:
    """Content of ``identification.json``: runs with their history and uncertainty, and every fit.

    Profiles and bootstraps are one a run, or none.
    """
    runs = []
    for i, run in enumerate(found.runs):
        runs.append(
            {
                "algorithm": run.algorithm,
                "parameters": _parameters(run),
                **_uncertainty(run.uncertainty),
                **({"profile": [_profile(p) for p in profiles[i]]} if profiles else {}),
                **({"bootstrap": _bootstrap(bootstraps[i])} if bootstraps else {}),
                "fitness": run.fitness,
                "unit": run.unit,
                "rms_N": run.rms,
                "gap": run.gap,
                "standing": run.standing,
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


def _parameters(run: SwarmResult) -> list[dict[str, Any]]:
    """Parameters, with their uncertainty where there is one."""
    rows = [asdict(parameter) for parameter in run.parameters]
    if run.uncertainty is not None:
        rows = [row | asdict(e) for row, e in zip(rows, run.uncertainty.parameters, strict=True)]
    return rows


def _uncertainty(found: Uncertainty | None) -> dict[str, Any]:
    if found is None:
        return {"derived": [], "identifiability": None}
    return {
        "derived": [asdict(estimate) for estimate in found.derived],
        "identifiability": {
            "level": found.level,
            "condition_number": found.condition_number,
            "correlation": found.correlation.tolist(),
            "amplitude_mm": found.amplitude,
            "frequency_Hz": found.frequency,
            "words": list(found.words),
        },
    }


def _profile(found: Profile) -> dict[str, Any]:
    return {"name": found.name, "unit": found.unit, "low": found.low, "high": found.high}


def _bootstrap(found: Bootstrap) -> dict[str, Any]:
    return {
        "replicates": len(found.replicates),
        "seed": found.seed,
        "blocks": list(found.blocks),
        "level": found.level,
        "intervals": [
            {"name": name, "unit": found.units[name], "low": low, "high": high}
            for name, (low, high) in found.intervals.items()
        ],
    }
