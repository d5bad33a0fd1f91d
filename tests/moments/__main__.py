"""Stop every command many times: ``python -m moments 200`` in the folder of the tests; prints a table."""

import random
import sys
import tempfile
from pathlib import Path

from .jobs import JOBS
from .stop import SIGNALS, check, stop


def main(times: int, seed: int) -> None:
    draw = random.Random(seed)
    print("| command | stopped | ended before | slowest end / s |")
    print("|---|---:|---:|---:|")
    for name, job in JOBS.items():
        stopped, slowest = 0, 0.0
        for i in range(times):
            with tempfile.TemporaryDirectory() as place:
                folder = Path(place).resolve()
                job.prepare(folder)
                found = stop(job.arguments, folder, draw.uniform(0, job.span), SIGNALS[i % len(SIGNALS)])
                check(found, folder)
                stopped += found.status == 130
                slowest = max(slowest, found.seconds)
        print(f"| {name} | {stopped} | {times - stopped} | {slowest:.2f} |", flush=True)


if __name__ == "__main__":
    main(int(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 1)
