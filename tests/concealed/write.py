"""Write a campaign as canonical CSV files and its truth as JSON."""

import argparse
import json
from dataclasses import asdict
from pathlib import Path

import numpy as np

from .campaign import Campaign, make_campaign


def write_campaign(campaign: Campaign, folder: Path) -> list[Path]:
    """One CSV for each recording; nothing in them tells the truth."""
    folder.mkdir(parents=True, exist_ok=True)
    written = []
    for one in campaign.recordings:
        columns = {
            "time_s": one.time,
            "displacement_mm": one.displacement,
            "velocity_mm_s": one.velocity,
            "force_N": one.force,
            "current_A": one.current,
            "temperature_C": one.temperature,
        }
        present = {name: column for name, column in columns.items() if column is not None}
        path = folder / f"{one.name}.csv"
        table = np.column_stack(list(present.values()))
        np.savetxt(path, table, delimiter=",", header=",".join(present), comments="", fmt="%.9g")
        written.append(path)
    return written


def truth(campaign: Campaign) -> dict[str, object]:
    """Everything but the arrays."""
    return {
        "ids": campaign.ids,
        "effects": [asdict(one) for one in campaign.effects],
        "base": campaign.base,
        "base_parameters": campaign.base_parameters,
        "noise": campaign.noise,
        "noise_rms": campaign.noise_rms,
        "unexplained_rms": campaign.unexplained_rms,
        "force_rms": campaign.force_rms,
        "reached": campaign.reached,
        "excitation": campaign.excitation,
        "seed": campaign.seed,
        "unit": "N",
    }


def main() -> None:
    parser = argparse.ArgumentParser(description="Write recordings with concealed physics.")
    parser.add_argument("folder", type=Path)
    parser.add_argument("truth", type=Path)
    parser.add_argument("--effect", action="append", help="repeat for several; none for the bare device")
    parser.add_argument("--law", action="append")
    parser.add_argument("--base", default="sinh")
    parser.add_argument("--strength", type=float, default=3.0)
    parser.add_argument("--noise", default="white")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--excitation")
    parser.add_argument("--samples", type=int)
    parser.add_argument("--velocity", default="given")
    parser.add_argument("--rate", type=float, action="append")
    parser.add_argument("--displacement-noise", type=float, default=0.0)
    given = parser.parse_args()
    campaign = make_campaign(
        given.effect,
        given.law or "textbook",
        given.base,
        given.strength,
        given.noise,
        given.seed,
        given.excitation,
        given.samples,
        given.velocity,
        rate=given.rate or 200.0,
        displacement_noise=given.displacement_noise,
    )
    write_campaign(campaign, given.folder)
    given.truth.write_text(json.dumps(truth(campaign), indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
