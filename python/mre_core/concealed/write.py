"""A campaign as canonical CSV files, and its truth as an object for JSON."""

from dataclasses import asdict
from pathlib import Path

import numpy as np

from .campaign import Campaign


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
