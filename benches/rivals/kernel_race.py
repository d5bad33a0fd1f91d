"""Fitness kernels side by side on one core."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import kernels_c
import kernels_numpy
import numpy as np
from machine import Rivals
from problems import Array, Case, Kernel, case
from race import interleaved, short

WIDE = {"beta": (0.01, 40.0)}  # leaves the compressed kernel; the candidates are the same
AGREE = 1e-9


@dataclass(frozen=True)
class Entry:
    """A kernel and the candidates that it gets in one call."""

    name: str
    kernel: Kernel
    rows: Array
    reference: bool = False
    """Whether the others are compared with it."""


def ours(case: Case) -> Kernel:
    """`Problem.fitness` on one thread."""
    return lambda rows: np.asarray(case.problem.fitness(rows, threads=1))


def singly(kernel: Kernel, rows: Array) -> Array:
    """One call a candidate."""
    return np.array([kernel(row[None])[0] for row in rows])


def check(entry: Entry, wanted: Kernel) -> None:
    """Refuse to time what computes something else.

    Raises
    ------
    RuntimeError
        A relative difference above 1e-9.
    """
    rows = entry.rows[:200]
    worst = float(np.max(np.abs(entry.kernel(rows) / wanted(rows) - 1)))
    if not worst <= AGREE:
        raise RuntimeError(f"{entry.name} differs from mre-core by {worst:.2g}: wanted at most {AGREE:g}")


def sinh(rivals: Rivals, size: int) -> list[Entry]:
    """The direct kernel first: it is the reference."""
    compressed, direct = case("sinh"), case("sinh", WIDE)
    rows = compressed.candidates(size)
    plain = kernels_numpy.sinh(compressed)
    entries = [
        Entry("mre-core, direct", ours(direct), rows, reference=True),
        Entry("mre-core, compressed", ours(compressed), np.tile(rows, (20, 1)), reference=True),
        Entry("mre-core, one candidate a call", lambda rows: singly(ours(compressed), rows), rows[:100]),
        Entry("NumPy, one candidate a call", lambda rows: singly(plain, rows), rows[:100]),
    ]
    for chunk in kernels_numpy.CHUNKS:
        entries.append(Entry(f"NumPy, {chunk} candidates", kernels_numpy.sinh(compressed, chunk), rows))
    if rivals.has("numba"):
        import kernels_numba

        forms = kernels_numba.sinh(compressed)
        entries += [Entry(f"Numba, {name}", kernel, rows) for name, kernel in forms.items()]
    if rivals.c is not None:
        entries.append(Entry("C, lanes over samples", kernels_c.sinh(rivals.c, compressed), rows))
    return entries


def bouc_wen(rivals: Rivals, size: int, spread: float) -> list[Entry]:
    """Candidates of the whole box, or about the truth (most with one step a sample)."""
    problem = case("bouc_wen")
    rows = problem.candidates(size, spread=spread)
    entries = [Entry("mre-core, 16 lanes", ours(problem), rows, reference=True)]
    if rivals.has("numba"):
        import kernels_numba

        forms = kernels_numba.bouc_wen(problem)
        entries += [Entry(f"Numba, {name}", kernel, rows) for name, kernel in forms.items()]
    if rivals.c is not None:
        entries.append(Entry("C, 16 lanes", kernels_c.bouc_wen(rivals.c, problem), rows))
    return entries


def table(entries: list[Entry], rounds: int) -> Iterator[str]:
    """Check and time the entries; of several forms of a rival's kernel the fastest is shown."""
    reference, *others = entries
    for entry in others:
        check(entry, reference.kernel)

    def job(entry: Entry) -> Callable[[], Array]:
        return lambda: entry.kernel(entry.rows)

    own, times, ratios = interleaved(job(reference), [job(entry) for entry in others], rounds)
    size = len(reference.rows)
    shown = [(reference.name, own / size, 1.0)]
    for entry, taken, ratio in zip(others, times, ratios, strict=True):
        shown.append((entry.name, taken / len(entry.rows), ratio * size / len(entry.rows)))
    bases = {row[0]: row[2] for row, entry in zip(shown, entries, strict=True) if entry.reference}
    columns = [f"time over {name}" for name in bases]
    yield "| " + " | ".join(["kernel", "us per evaluation", "evaluations per second", *columns]) + " |"
    yield "|---|---:|---:|" + "---:|" * len(bases)
    for name, each, ratio in best_forms(shown):
        cells = [
            name,
            f"{1e6 * each:.3g}",
            f"{1 / each:,.0f}",
            *(short(ratio / base) for base in bases.values()),
        ]
        yield "| " + " | ".join(cells) + " |"


def best_forms(rows: list[tuple[str, float, float]]) -> list[tuple[str, float, float]]:
    """Of the batched forms of NumPy and of all of Numba, the one with the smallest ratio."""
    kept = []
    for row in rows:
        alike = [r for r in rows if _family(r[0]) == _family(row[0])]
        if row == min(alike, key=lambda r: r[2]):
            kept.append(row)
    return kept


def _family(name: str) -> str:
    first = name.split(",")[0]
    return first if first in ("NumPy", "Numba") and "a call" not in name else name
