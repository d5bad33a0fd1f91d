"""Time contestants against a reference run between them."""

import statistics
import time
from collections.abc import Callable


def seconds(job: Callable[[], object]) -> float:
    """Wall-clock time of one call."""
    start = time.perf_counter()
    job()
    return time.perf_counter() - start


def interleaved(
    reference: Callable[[], object], others: list[Callable[[], object]], rounds: int
) -> tuple[float, list[float], list[float]]:
    """Median seconds of the reference and of the others, and the median ratios of these to it.

    A ratio is taken to the mean of the two runs of the reference around it, so that a change of the
    machine's speed strikes both.
    """
    own: list[float] = []
    times: list[list[float]] = [[] for _ in others]
    ratios: list[list[float]] = [[] for _ in others]
    reference()
    for other in others:
        other()
    for _ in range(rounds):
        before = seconds(reference)
        own.append(before)
        for k, other in enumerate(others):
            taken, after = seconds(other), seconds(reference)
            times[k].append(taken)
            ratios[k].append(2 * taken / (before + after))
            own.append(after)
            before = after
    median = statistics.median
    return median(own), [median(t) for t in times], [median(r) for r in ratios]


def short(ratio: float) -> str:
    """Three digits, and no exponent for large ones."""
    return f"{ratio:.3g}" if ratio < 999 else f"{ratio:,.0f}"
