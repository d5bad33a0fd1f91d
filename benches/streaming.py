"""Stream samples of the sinh model that are made chunk by chunk, and print what that takes.

Usage: streaming.py [SAMPLES], 10^8 by default. Prints the time and the peak memory of the pass, the fit,
and how long one evaluation takes on 10^3 to 10^7 samples, in memory and streamed.
"""

import resource
import sys
import time
from collections.abc import Iterator

import mre_core
import numpy as np
from numpy.typing import NDArray

CHUNK = 1_000_000
RATE = 256.0
STROKE = 8.0
TRUTH = {"c0": 0.278, "k0": 3.479, "alpha": 1.35, "beta": 0.302, "F0": 0.5}
NOISE = 0.2

Chunk = tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]


def chunks(samples: int) -> Iterator[Chunk]:
    """Two tones, and the force of the model with white noise of `NOISE` in N."""
    rng = np.random.default_rng(1)
    for first in range(0, samples, CHUNK):
        t = np.arange(first, min(first + CHUNK, samples)) / RATE
        x, v = np.zeros(len(t)), np.zeros(len(t))
        for share, frequency in ((0.7, 1.0), (0.3, 2.37)):
            turn = 2 * np.pi * frequency
            x += share * STROKE * np.sin(turn * t)
            v += share * STROKE * turn * np.cos(turn * t)
        force = TRUTH["c0"] * v + TRUTH["k0"] * x + TRUTH["alpha"] * np.sinh(TRUTH["beta"] * x) + TRUTH["F0"]
        yield x, v, force + rng.normal(0, NOISE, len(t))


def peak() -> float:
    """Peak memory of this process in MB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def evaluation(problem: mre_core.Problem) -> float:
    """Microseconds of one evaluation on one thread, the best of five."""
    rows = problem.lower + np.random.default_rng(2).random((20_000, 5)) * (problem.upper - problem.lower)
    best = np.inf
    for _ in range(5):
        start = time.perf_counter()
        problem.fitness(rows, threads=1)
        best = min(best, time.perf_counter() - start)
    return float(1e6 * best / len(rows))


def main() -> int:
    """Print the tables."""
    samples = int(float(sys.argv[1])) if len(sys.argv) > 1 else 100_000_000
    before = peak()
    start = time.perf_counter()
    problem = mre_core.Problem.streamed(chunks(samples), STROKE)
    print(f"{samples:.0e} samples streamed in {time.perf_counter() - start:.1f} s, making them included")
    print(f"peak memory {peak():.0f} MB, of which {before:.0f} MB before")
    start = time.perf_counter()
    found = mre_core.exact(problem)
    print(
        f"exact fit in {1e3 * (time.perf_counter() - start):.2f} ms: rms {found.rms:.6f} N, noise {NOISE} N"
    )
    proof = mre_core.certificate(problem, found)
    print(proof)
    print("; ".join(f"{p.name} {p.value:.5g} (truth {TRUTH[p.name]:g})" for p in found.parameters))
    print("\n| samples | streamed, us an evaluation | in memory, us an evaluation |\n|---:|---:|---:|")
    for power in range(3, 8):
        streamed = mre_core.Problem.streamed(chunks(10**power), STROKE)
        memory = "-"
        if power <= 6:
            x, v, force = (np.concatenate(parts) for parts in zip(*chunks(10**power), strict=True))
            recording = mre_core.Recording(np.arange(10**power) / RATE, x, force, velocity=v)
            memory = f"{evaluation(mre_core.Problem(recording)):.3f}"
        print(f"| 10^{power} | {evaluation(streamed):.3f} | {memory} |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
