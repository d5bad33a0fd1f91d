"""Joint fits of many recordings: time and peak memory against their number.

Usage: joint.py [RECORDINGS], 1000 by default. Recordings of 10,000 samples at five currents are made one
after the other and fitted together, with beta shared; a quarter, half, and all of them.
"""

import resource
import sys
import time
from collections.abc import Iterator

import mre_core
import numpy as np

SAMPLES = 10_000
RATE = 256.0
CURRENTS = (0.0, 0.5, 1.0, 2.0, 3.0)
LAWS = {"c0": "linear", "k0": "linear", "alpha": "saturating", "F0": "constant"}
NOISE = 0.2


def recordings(count: int) -> Iterator[mre_core.Recording]:
    """Two tones of different size, at one current each."""
    t = np.arange(SAMPLES) / RATE
    for i in range(count):
        rng = np.random.default_rng(i)
        current = CURRENTS[i % len(CURRENTS)]
        stroke = rng.uniform(2, 8)
        x = stroke * (0.7 * np.sin(2 * np.pi * t) + 0.3 * np.sin(2 * np.pi * 2.37 * t))
        v = stroke * 2 * np.pi * (0.7 * np.cos(2 * np.pi * t) + 0.711 * np.cos(2 * np.pi * 2.37 * t))
        alpha = 8 + 20 * (1 - np.exp(-current / 0.8))
        force = (0.3 + 0.5 * current) * v + (4 + 3 * current) * x + alpha * np.sinh(0.3 * x) + 0.5
        force += rng.normal(0, NOISE, SAMPLES)
        yield mre_core.Recording(t, x, force, velocity=v, current=current, name=str(i))


def peak() -> float:
    """Peak memory of this process in MB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def main() -> int:
    """Print the table."""
    most = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
    mre_core.fit_laws(recordings(10), "sinh", LAWS, ["beta"])
    before = peak()
    print(f"recordings of {SAMPLES} samples; {before:.0f} MB are taken by ten of them\n")
    print(
        "| recordings | seconds, making them | seconds in all | more memory, MB | rms error, N | beta, 1/mm |"
    )
    print("|---:|---:|---:|---:|---:|---:|")
    for count in (most // 4, most // 2, most):
        start = time.process_time()
        for _ in recordings(count):
            pass
        made = time.process_time() - start
        start = time.process_time()
        found = mre_core.fit_laws(recordings(count), "sinh", LAWS, ["beta"])
        seconds = time.process_time() - start
        beta = found.model.laws["beta"].values[0]
        more = peak() - before
        cells = f"{made:.1f} | {seconds:.1f} | {more:.0f} | {found.rms:.4f} | {beta:.5f}"
        print(f"| {count} | {cells} |", flush=True)
    print(f"\nprocessor time of one core; truth: rms error {NOISE} N, beta 0.3 1/mm")
    return 0


if __name__ == "__main__":
    sys.exit(main())
