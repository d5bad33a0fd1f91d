"""Withhold a known effect from real recordings, and see whether the diagnosis finds it.

    python benches/real_proof [--out docs/real] [CASE ...]

Writes one page a case with a figure, and table.txt with one line a case. Nothing is simulated; the last three
cases alter the force channel of a real recording. The recordings are read from the folder MRE_DATA.
"""

import argparse
import sys
import time
import warnings
from pathlib import Path

from cases import CASES
from page import answered, write
from recordings import DATA

OUT = Path(__file__).resolve().parents[2] / "docs" / "real"
TABLE = "table.txt"
HEAD = (
    "| case | answered | named | verdict | held out before / N | after / N |",
    "|---|---|---|---|---:|---:|",
)


def main() -> int:
    """Run the cases that are asked for."""
    parser = argparse.ArgumentParser(
        prog="python benches/real_proof", description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("case", nargs="*", metavar="CASE", help=f"of {', '.join(CASES)}; all by default")
    parser.add_argument("--out", type=Path, default=OUT)
    options = parser.parse_args()
    if unknown := set(options.case) - set(CASES):
        parser.error(f"no case {', '.join(sorted(unknown))}")
    if not DATA.is_dir():
        print(f"no recordings at {DATA}: set MRE_DATA", file=sys.stderr)
        return 2
    options.out.mkdir(parents=True, exist_ok=True)
    warnings.simplefilter("ignore")
    rows = _rows(options.out / TABLE)
    for name in options.case or CASES:
        start = time.perf_counter()
        proof = CASES[name]()
        write(proof, options.out)
        named = ", ".join(effect.id for effect in proof.diagnosis.effects) or "nothing"
        fit = proof.diagnosis.fit
        rows[name] = (
            f"| [{proof.title}]({options.out.name}/{name}.md) | {answered(proof)} | {named}"
            f" | {proof.diagnosis.verdict} | {fit.held_out_rms_before:.4g} | {fit.held_out_rms_after:.4g} |"
        )
        lines = [*HEAD, *(rows[name] for name in CASES if name in rows)]
        (options.out / TABLE).write_text("\n".join(lines) + "\n", encoding="utf-8")
        print(f"{name}: {answered(proof)}, {named}, {time.perf_counter() - start:.0f} s", flush=True)
    return 0


def _rows(table: Path) -> dict[str, str]:
    """Lines of cases that were run before, by case."""
    lines = table.read_text(encoding="utf-8").splitlines() if table.exists() else []
    return {name: line for line in lines for name in CASES if f"/{name}.md)" in line}


if __name__ == "__main__":
    sys.exit(main())
