"""A test with what the identified sinh model makes of it: what Figures 4 to 10 draw."""

from typing import Any

import numpy as np

from ..crew import Crew
from ..identification import Identification
from ..identify import identify
from ..model import simulate
from .campaign import Case
from .paper import RELATIVE_ERROR


def identified(case: Case, seed: int, crew: Crew) -> Identification:
    """Identify the sinh model by MAFSA with the paper's settings, as the paper did."""
    return identify(case.recording, "sinh", optimizer="mafsa", seed=seed, **crew.options)


def loop(case: Case, found: Identification) -> dict[str, Any]:
    """Measured and predicted force over one cycle, and how far they are apart.

    Parameters
    ----------
    case : Case
        A test.
    found : Identification
        Of that test alone.

    Returns
    -------
    dict
        One cycle about the largest force: time (s, from its start), displacement (mm), velocity (mm/s),
        measured and predicted force (N); over all that is scored: rms error (N), its share of the force's,
        largest error and largest force (N), share of samples within the bound of Figure 5, parameters, gap to
        the exact optimum.
    """
    recording, run, fit = case.recording, found.result, found.fits[0]
    assert recording.force is not None  # a Case has one
    predicted = simulate(found.model, recording)
    scored = np.zeros(len(recording), bool)
    scored[slice(*recording.scored)] = True
    error = (predicted - recording.force)[scored]
    largest = float(np.abs(recording.force[scored]).max())
    shown = _cycle(recording.time, np.abs(recording.force) * scored, scored, found)
    time = recording.time[shown]
    return {
        "test": case.name,
        "current_A": case.current,
        "amplitude_mm": case.amplitude,
        "parameters": run.values,
        "rms_N": fit.rms,
        "relative_rms": fit.relative_rms,
        "within_bound": float(np.mean(np.abs(error) <= RELATIVE_ERROR * largest)),
        "largest_error_N": float(np.abs(error).max()),
        "largest_force_N": largest,
        "fitness_N2": run.fitness,
        "gap": run.gap,
        "time_s": (time - time[0]).tolist(),
        "displacement_mm": recording.displacement[shown].tolist(),
        "velocity_mm_s": recording.velocity[shown].tolist(),
        "measured_N": recording.force[shown].tolist(),
        "predicted_N": predicted[shown].tolist(),
    }


def _cycle(time: Any, force: Any, scored: Any, found: Identification) -> Any:
    """Choose one cycle about the largest force, or all that is scored where no frequency is known."""
    about = found.result.uncertainty
    if about is None or not about.frequency > 0:
        return scored
    period = 1 / about.frequency
    start = max(time[scored][0], min(time[np.argmax(force)] - period / 2, time[scored][-1] - period))
    return scored & (time >= start) & (time <= start + period)
