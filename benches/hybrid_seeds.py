"""How near the best known optimum `hybrid` stops, seed by seed, on every recording of the benches: hybrid.md.

The recordings of dampers and buildings are read from the folder MRE_DATA (default ../shared/data beside the
repository).
"""

import argparse
import sys
from collections.abc import Iterator
from pathlib import Path

import mre_core
from mre_core.study.campaign import replica
from real_fits import BUILDING, DATA, PATTERN

OUT = Path(__file__).with_name("hybrid.md")
HEAD = """# `hybrid`, seed by seed

Printed by `python benches/hybrid_seeds.py --seeds {seeds}`: runs within 1e-9 of the best cost that any seed
or `exact` found on the same recording.

| data set | model | recordings | runs | within 1e-9 | largest gap |
|---|---|---:|---:|---:|---:|"""
MODELS = ("kelvin_voigt", "sinh", "bouc_wen")
REACHED = 1e-9


def campaigns() -> Iterator[tuple[str, list[mre_core.Recording]]]:
    """Data sets by name."""
    yield "the paper's tests, simulated", [case.recording for case in replica(1).cases]
    damper = sorted((DATA / "mr-damper-usm").glob("*.csv"))
    loaded = (mre_core.load(path, name_pattern=PATTERN) for path in damper)
    yield "MR damper", [one.exclude("start_transient", "stop_transient") for one in loaded]
    building = sorted((DATA / "isolated-building-bncs").glob("*.csv"))
    yield "isolated building", [mre_core.load(path, map=BUILDING) for path in building]


def gaps(problem: mre_core.Problem, seeds: int) -> list[float]:
    """Gap of each seed to the best that any of them or `exact` found."""
    found = [mre_core.hybrid(problem, seed=seed).fun for seed in range(seeds)]
    best = min([*found, mre_core.exact(problem).fun])
    return [cost / best - 1 for cost in found]


def main() -> int:
    """One line a data set and model; recordings that are missed by some seed below."""
    given = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    given.add_argument("--seeds", type=int, default=100)
    seeds = given.parse_args().seeds
    if not DATA.is_dir():
        print(f"no recordings at {DATA}: set MRE_DATA", file=sys.stderr)
        return 2
    rows, missed = [HEAD.format(seeds=seeds)], []
    print(rows[0])
    for name, recordings in campaigns():
        for model in MODELS:
            of_model: list[float] = []
            for recording in recordings:
                own = gaps(mre_core.Problem(recording, model), seeds)
                late = sum(gap > REACHED for gap in own)
                if late:
                    missed.append(f"{recording.name}, {model}: {late} of {seeds}, at most {max(own):.2g}")
                of_model += own
            reached = sum(gap <= REACHED for gap in of_model)
            cells = (name, model, len(recordings), len(of_model), reached, f"{max(of_model):.2g}")
            rows.append("| " + " | ".join(map(str, cells)) + " |")
            print(rows[-1], flush=True)
    rows.append("\nMissed: " + ("; ".join(missed) or "none") + ".")
    print(rows[-1])
    OUT.write_text("\n".join(rows) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
