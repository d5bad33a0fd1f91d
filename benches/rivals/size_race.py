"""The sinh fitness over the number of samples: compressed, beside the direct kernel."""

from collections.abc import Iterator

import mre_core
import numpy as np
from kernel_race import WIDE, ours
from problems import case
from race import interleaved, seconds, short

CANDIDATES = 20_000
CHECKED = 20  # candidates on which the direct kernel is asked as well


def table(most: int, rounds: int) -> Iterator[str]:
    """One row for each power of ten up to `most` samples; ratios are to the first row."""
    yield (
        "| samples | set-up, s | us per evaluation | over 1,000 samples | direct, us per evaluation "
        "| largest difference |"
    )
    yield "|---:|---:|---:|---:|---:|---:|"
    reference = case("sinh")
    rows = reference.candidates(CANDIDATES)
    few = rows[:CHECKED]
    samples = 1_000
    while samples <= most:
        compressed, direct = case("sinh", samples=samples), case("sinh", WIDE, samples)
        recording = compressed.problem.recordings[0]
        set_up = seconds(lambda recording=recording: mre_core.Problem(recording, "sinh"))
        _, (each,), (ratio,) = interleaved(
            lambda: ours(reference)(rows), [lambda case=compressed: ours(case)(rows)], rounds
        )
        wanted = ours(direct)(few)
        slow = min(seconds(lambda case=direct: ours(case)(few)) for _ in range(3))
        worst = float(np.max(np.abs(ours(compressed)(few) / wanted - 1)))
        yield (
            f"| {samples:,} | {set_up:.2g} | {1e6 * each / CANDIDATES:.3g} | {short(ratio)} "
            f"| {1e6 * slow / CHECKED:.3g} | {worst:.1g} |"
        )
        samples *= 10
