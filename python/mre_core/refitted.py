"""What a base model whose parameters were kept would leave with fitted ones."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import sqrt
from typing import Literal

from ._core import MreError, Recording
from .identify import identify
from .measure import measure_fit
from .model import Model


@dataclass(frozen=True)
class Refitted:
    """Rms errors over all samples that count, in N."""

    rms_as_given: float
    rms_fitted: float
    unit: str = "N"


def refitted(
    model: Model,
    recordings: Sequence[Recording],
    seed: int,
    threads: int | None,
    on_interrupt: Literal["raise", "return"],
) -> tuple[Refitted | None, bool]:
    """Fit the parameters of a model, and say whether that was interrupted: then there is no result."""
    try:
        found = identify(recordings, model, seed=seed, threads=threads, on_interrupt=on_interrupt)
    except MreError:  # parameters that are kept need less of a recording than those that are fitted
        return None, False
    if found.interrupted:
        return None, True
    return Refitted(_rms(model, recordings), _rms(found.model, recordings)), False


def _rms(model: Model, recordings: Sequence[Recording]) -> float:
    fits = [measure_fit(model, recording) for recording in recordings]
    return sqrt(sum(fit.rms**2 * fit.samples for fit in fits) / sum(fit.samples for fit in fits))
