"""Compare mre_core with other packages, and print the tables.

Writes benches/README.md, unless `--quick`: a smoke test of everything, whose figures mean nothing.
"""

import argparse
import os
import tempfile
from pathlib import Path

README = Path(__file__).resolve().parents[1] / "README.md"


def main() -> None:
    """Read the command line and run."""
    parser = argparse.ArgumentParser(prog="python benches/rivals", description=__doc__)
    parser.add_argument("--quick", action="store_true", help="a smoke test; nothing is written")
    quick = parser.parse_args().quick
    for library in ("OPENBLAS", "OMP", "MKL", "NUMBA"):
        os.environ[f"{library}_NUM_THREADS"] = "1"  # read when NumPy is imported
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)  # pyswarms leaves a log where it is imported
        from report import lines

        text = []
        for line in lines(quick):
            print(line, flush=True)
            text.append(line)
        os.chdir(README.parent)
    if not quick:
        README.write_text("\n".join(text) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
