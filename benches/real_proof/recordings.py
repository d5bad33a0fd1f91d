"""Real recordings as they lie in the folder MRE_DATA (default ../shared/data beside the repository)."""

import os
from collections.abc import Sequence
from pathlib import Path

import mre_core
import numpy as np
from mre_core import Recording
from numpy.typing import NDArray

DATA = Path(os.environ.get("MRE_DATA", Path(__file__).resolve().parents[3] / "shared" / "data"))
PATTERN = "{amplitude}mm{frequency}Hz{current}A"
BUILDING = {
    "displacement": "isolator_disp_m",
    "velocity": "isolator_vel_m_s",
    "force": "base_shear_kN[kN]",
}


def building(names: Sequence[str], every: int = 1) -> list[Recording]:
    """Earthquakes of the isolated building; one of `every` samples."""
    found = []
    for name in names:
        whole = mre_core.load(DATA / "isolated-building-bncs" / f"BI-BNCS_{name}.csv", map=BUILDING)
        here = slice(None, None, every)
        found.append(
            Recording(
                whole.time[here],
                whole.displacement[here],
                np.asarray(whole.force)[here],
                velocity=np.asarray(whole.velocity)[here],
                name=name,
            )
        )
    return found


def damper(names: Sequence[str], *, current: bool = True) -> list[Recording]:
    """Tests of the damper without their transients; `current` says whether the tool is told it."""
    found = []
    for name in names:
        path = DATA / "mr-damper-usm" / f"{name}.csv"
        loaded = mre_core.load(path, name_pattern=PATTERN) if current else mre_core.load(path)
        found.append(loaded.exclude("start_transient", "stop_transient"))
    return found


def with_force(recording: Recording, force: NDArray[np.float64]) -> Recording:
    """The same test of the damper with another force channel."""
    changed = Recording(
        recording.time,
        recording.displacement,
        force,
        current=recording.current_level,
        name=recording.name,
    )
    return changed.exclude("start_transient", "stop_transient")
