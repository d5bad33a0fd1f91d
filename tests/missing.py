"""Recordings of a sinh device with physics that the sinh model lacks, made without the core."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from mre_core import Recording
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline  # type: ignore[import-untyped]

SINES = ((0.2, 4.0), (0.5, 4.0), (1.0, 2.0), (1.0, 4.0), (2.0, 4.0), (3.0, 2.0), (3.0, 4.0))
"""Hz and mm."""
K_M, TAU = 3.0, 0.4
"""N/mm and s of the Maxwell branch, where there is one."""
NOISE = 0.3
"""N."""


def maxwell(time: NDArray[np.float64], velocity: NDArray[np.float64], tau: float) -> NDArray[np.float64]:
    """z' = v - z/tau from rest, by Gauss's quadrature of the natural cubic spline through the velocity."""
    places, weights = np.polynomial.legendre.leggauss(6)
    h = np.diff(time)
    within = time[:-1, None] + 0.5 * h[:, None] * (1 + places)
    spline = CubicSpline(time, velocity, bc_type="natural")
    entering = 0.5 * h * ((np.exp(-(time[1:, None] - within) / tau) * spline(within)) @ weights)
    z = np.zeros_like(time)
    for i, kept in enumerate(np.exp(-h / tau)):
        z[i + 1] = kept * z[i] + entering[i]
    return z


def record(
    frequency: float,
    amplitude: float,
    k_m: float = 0.0,
    *,
    seed: int = 0,
    seconds: float = 12.0,
    current: float | None = None,
    name: str = "",
) -> Recording:
    """A sine that swells in one second from rest."""
    time = np.arange(round(200 * seconds)) / 200
    s, turn = np.clip(time, 0, 1), 2 * np.pi * frequency
    swell, growth = s**2 * (3 - 2 * s), 6 * s * (1 - s)
    x = amplitude * swell * np.sin(turn * time)
    v = amplitude * (growth * np.sin(turn * time) + swell * turn * np.cos(turn * time))
    force = 0.4 * v + 8 * x + 10 * np.sinh(0.3 * x) + k_m * maxwell(time, v, TAU)
    force += NOISE * np.random.default_rng(seed).normal(size=len(time))
    return Recording(
        time, x, force, velocity=v, current=current, name=name or f"{frequency:g}Hz_{amplitude:g}mm"
    )


def campaign(k_m: float = K_M, *, current: float | None = None, seed: int = 0) -> list[Recording]:
    return [record(*sine, k_m, seed=100 * seed + i, current=current) for i, sine in enumerate(SINES)]


def write_all(folder: Path, recordings: Sequence[Recording]) -> list[Path]:
    """A file a recording, with all digits."""
    folder.mkdir(parents=True, exist_ok=True)
    paths = []
    for r in recordings:
        paths.append(folder / f"{r.name}.csv")
        columns = {
            "time_s": r.time,
            "displacement_mm": r.displacement,
            "velocity_mm_s": r.velocity,
            "force_N": r.force,
            "simulated_force_N": r.simulated,
        }
        columns = {header: values for header, values in columns.items() if values is not None}
        rows = zip(*(values.tolist() for values in columns.values() if values is not None), strict=True)
        lines = [",".join(columns), *(",".join(map(repr, row)) for row in rows)]
        paths[-1].write_text("\n".join(lines) + "\n", encoding="utf-8")
    return paths


def with_series(
    r: Recording,
    *,
    displacement: NDArray[np.float64] | None = None,
    force: NDArray[np.float64] | None = None,
    simulated: NDArray[np.float64] | None = None,
    current: float | None = None,
    name: str | None = None,
) -> Recording:
    """The same recording with other columns; the velocity is derived where the displacement is another."""
    return Recording(
        r.time,
        r.displacement if displacement is None else displacement,
        r.force if force is None else force,
        velocity=r.velocity if displacement is None else None,
        simulated=r.simulated if simulated is None else simulated,
        current=r.current if current is None else current,
        name=r.name if name is None else name,
    )
