"""Results of one item as the cells of one row."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from .._core import Recording
from ..diagnosis import Diagnosis
from ..identification import Identification
from ..model import Model
from ..tested import largest_motion
from ..uncertainty import Bootstrap

Row = dict[str, Any]


def row_of_identification(
    found: Identification, bootstraps: Sequence[Bootstrap], recordings: Sequence[Recording]
) -> Row:
    """Parameters with intervals, fit, and how it was found; bootstraps are one a run, or none."""
    samples = sum(fit.samples for fit in found.fits)
    squares = sum(fit.rms**2 * fit.samples for fit in found.fits)
    spread = sum((fit.rms / fit.relative_rms) ** 2 * fit.samples for fit in found.fits if fit.relative_rms)
    on_bound = {p.name for run in found.runs for p in run.parameters if p.on_bound and not p.at_limit}
    doubts = [e.name for run in found.runs if run.uncertainty for e in run.uncertainty.parameters]
    known = {
        e.name for run in found.runs if run.uncertainty for e in run.uncertainty.parameters if e.determined
    }
    row = _conditions(recordings) | parameters_of(found.model)
    for i, boot in enumerate(bootstraps):
        at = _at(found.model.levels[i].current if len(found.runs) > 1 else None)
        for name in found.runs[i].values:
            low, high = boot.intervals[name]
            row |= {f"{name}_bootstrap_low{at}": low, f"{name}_bootstrap_high{at}": high}
    return row | {
        "rms_N": math.sqrt(squares / samples),
        "relative_rms": math.sqrt(squares / spread) if spread > 0 else None,
        "on_bound": ", ".join(sorted(on_bound)),
        "not_determined": ", ".join(sorted(set(doubts) - known)),
        "evaluations": sum(run.n_evaluations for run in found.runs),
        "reason": ", ".join(dict.fromkeys(str(run.reason) for run in found.runs)),
    }


def row_of_diagnosis(found: Diagnosis, recordings: Sequence[Recording]) -> Row:
    """Verdict, effects with their parameters, held-out errors, and parameters of the final model."""
    row = _conditions(recordings) | {
        "verdict": found.verdict,
        "effects": ", ".join(effect.id for effect in found.effects),
        "p_base": found.p_values["base"],
    }
    row |= parameters_of(found.model)
    for effect in found.effects:
        for name, p in effect.parameters.items():
            if "(" not in name:  # those of single recordings stand in the model's own results
                row |= _cells(f"{effect.id}.{name}", None, p.value, (p.low, p.high))
    fit = found.fit
    return row | {
        "train_rms_before_N": fit.train_rms_before,
        "train_rms_after_N": fit.train_rms_after,
        "held_out_rms_before_N": fit.held_out_rms_before,
        "held_out_rms_after_N": fit.held_out_rms_after,
        "noise_rms_N": fit.noise_rms,
        "velocity_derived": ", ".join(found.velocity_derived),
    }


def parameters_of(model: Model) -> Row:
    """``NAME``, ``NAME_low`` and ``NAME_high``; with ``(0.5 A)`` behind it where there are several levels."""
    row: Row = {}
    for level in model.levels:
        current = level.current if len(model.levels) > 1 else None
        for name in model.units:
            row |= _cells(name, current, level.parameters[name], level.intervals.get(name, (None, None)))
    return row


def _cells(
    name: str, current: float | None, value: float, interval: tuple[float | None, float | None]
) -> Mapping[str, float | None]:
    at = _at(current)
    return {f"{name}{at}": value, f"{name}_low{at}": interval[0], f"{name}_high{at}": interval[1]}


def _at(current: float | None) -> str:
    # Levels of one item differ by more than 0.02 A.
    return "" if current is None else f"({round(current, 2):g} A)"


def _conditions(recordings: Sequence[Recording]) -> Row:
    """Count the recordings, and tell what they share and how far they move."""
    currents = {r.current_level for r in recordings}
    temperatures = [float(np.mean(r.temperature)) for r in recordings if r.temperature is not None]
    motion = largest_motion(recordings)
    return {
        "recordings": len(recordings),
        "samples": sum(len(r) for r in recordings),
        "current": currents.pop() if len(currents) == 1 else None,
        "temperature": float(np.mean(temperatures)) if temperatures else None,
        "amplitude": motion["displacement_mm"],
        "velocity": motion["velocity_mm_s"],
    }
