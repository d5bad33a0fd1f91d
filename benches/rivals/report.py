"""The tables with what they mean."""

import time
from collections.abc import Iterator

import kernel_race
import optimizer_race
import size_race
from machine import Rivals, describe
from optimizer_race import Effort
from problems import SAMPLES, case

HEAD = f"""# Benchmarks

`cargo bench` times the parts of the core by themselves. Below, `python benches/rivals` compares mre_core with
other packages; it writes this file, and needs `pip install '.[rivals]'` and a C compiler. Every rival runs
between two runs of the reference, the first row of its table, and ratios are medians of its time over theirs:
trust ratios, not seconds.

Recording: {SAMPLES:,} samples of a 4 mm, 1 Hz test at 256 Hz with 1 % noise; default box.
"""
KERNELS = """
## Fitness kernels, one core

Mean squared error (eq. 5) of a batch of candidates, called from Python. Each kernel agreed with mre_core to
1e-9 before it was timed; of several forms of a NumPy or Numba kernel the fastest is shown. mre_core
compresses the samples of `sinh` where the box of beta allows. No option turns that off: "direct" is the
kernel that a box with beta up to 40 leaves.
"""
SINH = "\n### sinh\n"
SIZES = """
### sinh, compressed, over the number of samples

A longer recording is compressed once ("set-up"); an evaluation then costs the same. "Largest difference" is
relative, to the direct kernel, over candidates of the whole box.
"""
BOX = "\n### Bouc-Wen, candidates from the whole box\n\nStiff ones take many sub-steps of RK4 a sample.\n"
TRUTH = "\n### Bouc-Wen, candidates about the truth\n\nWithin 5 % of the box: mostly one step a sample.\n"
OPTIMIZERS = """
## Optimisers

50 members and 300 iterations where an optimiser asks for them, else its own defaults; pyswarms, which has
none, with the coefficients of its documentation. All move in the unit box (rho and n logarithmic). "own" is
the fitness in the core; "batch" gives a generation in one call, "single" one candidate a call. A run is
stopped after {limit:g} s; an optimiser that has spent {spent:g} s gets no further seed.

`hybrid`, `exact` and the projection by SciPy know that coefficients are linear, and the first two count
shapes as evaluations; the others know only the cost. Gaps are above the best fitness that any run found.
"""


def lines(quick: bool) -> Iterator[str]:
    """Run everything and describe it, line by line."""
    start = time.perf_counter()
    rivals = Rivals()
    rounds, size = (1, 200) if quick else (9, 10_000)
    effort = Effort(seeds=1, limit=0.2) if quick else Effort(seeds=5, limit=40.0)
    yield from HEAD.splitlines()
    yield ""
    yield f"- {describe()}"
    yield f"- {', '.join(rivals.versions())}"
    yield from (f"- {line}" for line in rivals.missing())
    yield from KERNELS.splitlines()
    for text, rows in (
        (SINH, kernel_race.table(kernel_race.sinh(rivals, size), rounds)),
        (SIZES, size_race.table(10_000 if quick else 10_000_000, rounds)),
        (BOX, kernel_race.table(kernel_race.bouc_wen(rivals, max(size // 40, 32), 1.0), rounds)),
        (TRUTH, kernel_race.table(kernel_race.bouc_wen(rivals, max(size // 20, 32), 0.1), rounds)),
    ):
        yield from text.splitlines()
        yield ""
        yield from rows
    yield from OPTIMIZERS.format(limit=effort.limit, spent=optimizer_race.SPENT).splitlines()
    for model in ("sinh", "bouc_wen"):
        yield ""
        yield f"### {model}"
        yield ""
        yield from optimizer_race.table(case(model), effort, rivals)
    yield ""
    yield f"All of it took {time.perf_counter() - start:.0f} s."
