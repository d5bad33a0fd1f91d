"""Work for some minutes: ``python -m endurance 60`` in the folder of the tests; prints a table."""

import random
import sys
import tempfile
import time
import warnings
from pathlib import Path

from .health import Health, leaks
from .jobs import JOBS

TENTHS = 10


def main(minutes: float, seed: int) -> int:
    draw = random.Random(seed)
    with tempfile.TemporaryDirectory() as folder:

        def work() -> None:
            with warnings.catch_warnings():  # of random data there is much to say
                warnings.simplefilter("ignore")
                for job in JOBS.values():
                    job(draw, Path(folder))

        work()  # libraries are loaded, pools and caches made
        print("| after / min | rounds | memory / MiB | open files | threads | processes |")
        print("|---:|---:|---:|---:|---:|---:|")
        told = [Health.now()]
        print(f"| 0 | 0 | {told[0]} |", flush=True)
        began, rounds = time.monotonic(), 0
        for tenth in range(1, TENTHS + 1):
            seen: list[Health] = []
            while not seen or time.monotonic() - began < tenth / TENTHS * 60 * minutes:
                work()
                rounds += 1
                seen.append(Health.now())
            told.append(min(seen))
            print(f"| {(time.monotonic() - began) / 60:.1f} | {rounds} | {told[-1]} |", flush=True)
    found = leaks(told)
    print("\n".join(found) or f"\nnothing is kept after {rounds} rounds of {', '.join(JOBS)}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(float(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 1))
