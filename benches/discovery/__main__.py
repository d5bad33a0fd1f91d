"""Other methods on the cases of a trial: who names what is concealed, and who predicts best.

    python benches/discovery [--cases 40] [--seed 1] [--out FILE.md]

Seeds below 1000 are for development, those from 1000 on for judging. Methods whose package is not installed
are left out and named. All get the noise-free velocity; one recording of each
case is kept for the prediction.
"""

import argparse
import os
import sys
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from multiprocessing import get_context
from pathlib import Path


def main() -> None:
    """Run all methods on all cases, and print one table."""
    parser = argparse.ArgumentParser(
        prog="python benches/discovery", description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("--cases", type=int, default=40)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--samples", type=int, default=6000, help="of each case, shorter than in a trial")
    parser.add_argument("--workers", type=int, default=os.cpu_count())
    parser.add_argument("--out", type=Path, help="write the table to this file, too")
    options = parser.parse_args()
    for library in ("OPENBLAS", "OMP", "MKL"):
        os.environ[f"{library}_NUM_THREADS"] = "1"  # read when NumPy is imported
    from mre_core.trial import standard
    from race import quiet, raced
    from table import table, versions

    planned = standard(options.cases, options.seed)
    cases = [replace(case, samples=min(case.samples or options.samples, options.samples)) for case in planned]
    rows = []
    with ProcessPoolExecutor(options.workers, mp_context=get_context("spawn"), initializer=quiet) as pool:
        for i, found in enumerate(pool.map(raced, cases), 1):
            rows += found
            print(f"{i} of {len(cases)}", file=sys.stderr, flush=True)
    text = (
        f"{len(cases)} cases of the standard trial, seed {options.seed}, {options.samples} samples each;"
        f" {versions()}.\n\n{table(rows)}\n"
    )
    print(text)
    if options.out:
        options.out.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
