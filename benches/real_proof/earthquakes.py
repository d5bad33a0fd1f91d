"""Rubber isolators of a building: each earthquake in turn shown to neither model, base sinh.

    python benches/real_proof/earthquakes.py [--out docs/real]

Writes earthquakes.md: names and held-out errors of every split, of the whole band and below 2 Hz, and pooled.
"""

import argparse
import warnings
from pathlib import Path

import mre_core
import numpy as np
from numpy.typing import NDArray
from recordings import building
from scipy.signal import butter, sosfiltfilt

EARTHQUAKES = ("CNP100", "ICA100", "ICA140", "SP100")
EVERY = 4
"""One sample of so many: 50 Hz are enough for an isolator."""
BAND = 2.0
"""Hz; above it the higher modes of the building ride on the force, which no isolator model should explain."""

HEAD = """# Rubber isolators of a building: every earthquake held out

Base `sinh`, seed 1, one sample of {every}. The models are fitted to three earthquakes and judged on the
fourth. Errors are rms as a share of the rms of the force, of the whole band and below {band:g} Hz.

| held out | verdict | named | base | with effects | base, < {band:g} Hz | with effects, < {band:g} Hz |
|---|---|---|---:|---:|---:|---:|"""


def squares(series: NDArray[np.float64], rate: float) -> NDArray[np.float64]:
    """Sum of squares of the whole band and below the limit."""
    low = sosfiltfilt(butter(4, BAND, fs=rate, output="sos"), series)
    return np.array([series @ series, low @ low])


def split(held_out: str) -> tuple[str, NDArray[np.float64]]:
    """Start of a row of the table, and squares of the force, of the error of the base and of the model."""
    known = building([name for name in EARTHQUAKES if name != held_out], every=EVERY)
    (unseen,) = building([held_out], every=EVERY)
    found = mre_core.diagnose(known, "sinh", seed=1)
    force, rate = np.asarray(unseen.force), unseen.sampling_rate
    errors = [force - mre_core.simulate(model, unseen) for model in (found.base_model, found.model)]
    named = ", ".join(effect.id for effect in found.effects) or "nothing"
    return f"| {held_out} | {found.verdict} | {named} |", np.array(
        [squares(series, rate) for series in (force, *errors)]
    )


def shares(of: NDArray[np.float64]) -> str:
    """Errors over the force: whole band, then below the limit."""
    rms = np.sqrt(of[1:] / of[0])
    return " ".join(f"{value:.3f} |" for value in rms.T.ravel())


def main() -> None:
    """Run every split."""
    parser = argparse.ArgumentParser(
        prog="earthquakes.py", description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("--out", type=Path, default=Path(__file__).resolve().parents[2] / "docs" / "real")
    out = parser.parse_args().out
    warnings.simplefilter("ignore")
    rows, total = [], np.zeros((3, 2))
    for name in EARTHQUAKES:
        start, of = split(name)
        rows.append(f"{start} {shares(of)}")
        total += of
        print(rows[-1], flush=True)
    rows.append(f"| pooled | | | {shares(total)}")
    print(rows[-1])
    text = "\n".join([HEAD.format(every=EVERY, band=BAND), *rows]) + "\n"
    (out / "earthquakes.md").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
