"""Identify models from real recordings, all files together and one by one, and print the fits.

The recordings are read from the folder MRE_DATA (default ../shared/data beside the repository).
"""

import os
import sys
import time
from collections.abc import Sequence
from pathlib import Path

import mre_core
import numpy as np

DATA = Path(os.environ.get("MRE_DATA", Path(__file__).resolve().parents[2] / "shared" / "data"))
BUILDING = {
    "displacement": "isolator_disp_m",
    "velocity": "isolator_vel_m_s",
    "force": "base_shear_kN[kN]",
}
PATTERN = "{amplitude}mm{frequency}Hz{current}A"
SEED = 1


def row(recordings: Sequence[mre_core.Recording], model: str) -> tuple[float, list[mre_core.Fit], str]:
    """Identify; relative rms over all samples, the fits, and parameters that ended on a bound."""
    found = mre_core.identify(list(recordings), model, seed=SEED)
    errors = sum(fit.rms**2 * fit.samples for fit in found.fits)
    spread = sum((fit.rms / fit.relative_rms) ** 2 * fit.samples for fit in found.fits)
    active = {p.name for run in found.runs for p in run.parameters if p.on_bound and not p.at_limit}
    return float(np.sqrt(errors / spread)), list(found.fits), ", ".join(sorted(active)) or "-"


def study(title: str, recordings: Sequence[mre_core.Recording], models: Sequence[str]) -> None:
    """Print one table of a data set."""
    print(f"\n{title}: rms error as a share of the force's rms, seed {SEED}\n")
    print("| recording | " + " | ".join(f"{m}, together | {m}, alone" for m in models) + " |")
    print("|---|" + "---:|" * (2 * len(models)))
    columns: list[list[str]] = []
    notes = []
    for model in models:
        start = time.perf_counter()
        whole, together, active = row(recordings, model)
        alone = [row([recording], model)[0] for recording in recordings]
        by_name = {fit.recording: fit.relative_rms for fit in together}
        columns.append([f"{100 * by_name[r.name]:.1f} %" for r in recordings] + [f"{100 * whole:.1f} %"])
        columns.append([f"{100 * value:.1f} %" for value in alone] + [""])
        seconds = time.perf_counter() - start
        notes.append(f"{model}: bounds active in the fit together: {active}; {seconds:.0f} s in all")
    for name, *cells in zip([*(r.name for r in recordings), "all"], *columns, strict=True):
        print(f"| {name} | " + " | ".join(cells) + " |")
    print("\n" + "\n".join(notes), flush=True)


def main() -> int:
    """Both data sets."""
    if not DATA.is_dir():
        print(f"no recordings at {DATA}: set MRE_DATA", file=sys.stderr)
        return 2
    damper = [
        mre_core.load(path, name_pattern=PATTERN).exclude("start_transient", "stop_transient")
        for path in sorted((DATA / "mr-damper-usm").glob("*.csv"))
    ]
    study("MR damper", damper, ["bouc_wen"])
    building = [
        mre_core.load(path, map=BUILDING) for path in sorted((DATA / "isolated-building-bncs").glob("*.csv"))
    ]
    study("Isolated building", building, ["sinh", "bouc_wen"])
    return 0


if __name__ == "__main__":
    sys.exit(main())
