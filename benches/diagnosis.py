"""Time and memory of a diagnosis over the number of samples; writes diagnosis.md beside this file.

    python benches/diagnosis.py [SAMPLES ...]

Seven recordings of a sinh device with a Maxwell branch (sines that swell from rest, 1 % noise), base sinh,
all cores. Each size runs in a process of its own, so that its memory is its own.
"""

import os
import resource
import subprocess
import sys
import time
from pathlib import Path

import mre_core
import numpy as np
from mre_core import Level, Model, Recording

SIZES = (10_000, 33_000, 100_000, 330_000, 1_000_000)
SINES = ((0.2, 4.0), (0.5, 4.0), (1.0, 2.0), (1.0, 4.0), (2.0, 4.0), (3.0, 2.0), (3.0, 4.0))
"""Hz and mm."""
RATE = 200.0
ARRAYS = 4
"""Time, displacement, velocity and force, 8 bytes each."""
HEAD = """# Time and memory of a diagnosis

Printed by `python benches/diagnosis.py` on {cores} cores, load {load:.1f}. Memory is the peak of the process
above what it had when the recordings were made, over the size of the recordings.

| samples | seconds | seconds per 1,000 samples | memory / recordings | named |
|---:|---:|---:|---:|---|"""


def campaign(samples: int) -> list[Recording]:
    """A device with memory, recorded."""
    each = samples // len(SINES)
    device = Model(
        "sinh",
        (Level(None, {"c0": 0.4, "k0": 8.0, "alpha": 10.0, "beta": 0.3, "F0": 0.0}),),
    )
    found = []
    for k, (frequency, amplitude) in enumerate(SINES):
        t = np.arange(each) / RATE
        swell, growth, turn = np.minimum(t, 1.0), (t < 1.0).astype(float), 2 * np.pi * frequency
        x = amplitude * swell * np.sin(turn * t)
        v = amplitude * (growth * np.sin(turn * t) + swell * turn * np.cos(turn * t))
        force = mre_core.simulate(device, Recording(t, x, np.zeros_like(t), velocity=v))
        z, kept = np.zeros_like(t), np.exp(-1 / RATE / 0.4)
        for i in range(1, each):
            z[i] = kept * z[i - 1] + 0.4 * (1 - kept) * 0.5 * (v[i] + v[i - 1])
        force += 3.0 * z
        force += 0.01 * np.std(force) * np.random.default_rng(k).normal(size=each)
        found.append(Recording(t, x, force, velocity=v, name=f"{frequency:g}Hz_{amplitude:g}mm"))
    return found


def measure(samples: int) -> str:
    """One row of the table."""
    recordings = campaign(samples)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    start = time.perf_counter()
    found = mre_core.diagnose(recordings, "sinh", seed=1)
    seconds = time.perf_counter() - start
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
    times = 1024 * peak / (8 * ARRAYS * samples)
    named = ", ".join(effect.id for effect in found.effects) or found.verdict
    return f"| {samples:,} | {seconds:.1f} | {1000 * seconds / samples:.3f} | {times:.0f} | {named} |"


def main() -> None:
    """Every size in a process of its own."""
    if sys.argv[1:2] == ["--one"]:
        print(measure(int(sys.argv[2])))
        return
    sizes = [int(size) for size in sys.argv[1:]] or SIZES
    lines = [HEAD.format(cores=os.cpu_count(), load=os.getloadavg()[0])]
    for size in sizes:
        done = subprocess.run(
            [sys.executable, __file__, "--one", str(size)], capture_output=True, text=True, check=True
        )
        lines.append(done.stdout.strip())
        print(lines[-1], flush=True)
    Path(__file__).with_suffix(".md").write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
