"""Figures of one closed loop."""

from dataclasses import dataclass
from typing import Final, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .cycles import Cycle

Series = NDArray[np.float64]
Convention = Literal["displacement_extremes", "peak_force"]

CONVENTIONS: Final[dict[str, str]] = {
    "displacement_extremes": "forces at the largest and smallest displacement",
    "peak_force": "largest and smallest force",
}
"""Which two forces make the effective stiffness, and through it the damping ratio."""

_LINE = 0.5
"""Share of the amplitude about the middle over which the post-yield line is laid."""
_EXTREME = 0.005
"""Depth, as a share of the stroke, of the tip through which a parabola is laid."""


class Quantity(NamedTuple):
    """A figure of a loop: its attribute, symbol, unit and column in a file."""

    name: str
    symbol: str
    unit: str
    column: str


QUANTITIES: Final = (
    Quantity("effective_stiffness", "K_eff", "N/mm", "effective_stiffness_N_per_mm"),
    Quantity("energy", "W_D", "N mm", "energy_N_mm"),
    Quantity("damping_ratio", "h", "1", "damping_ratio"),
    Quantity("characteristic_strength", "Q_d", "N", "characteristic_strength_N"),
    Quantity("post_yield_stiffness", "K_d", "N/mm", "post_yield_stiffness_N_per_mm"),
    Quantity("storage_stiffness", "K'", "N/mm", "storage_stiffness_N_per_mm"),
    Quantity("loss_stiffness", "K''", "N/mm", "loss_stiffness_N_per_mm"),
    Quantity("loss_factor", "K''/K'", "1", "loss_factor"),
    Quantity("largest_force", "F_max", "N", "largest_force_N"),
    Quantity("smallest_force", "F_min", "N", "smallest_force_N"),
)


@dataclass(frozen=True)
class Loop:
    """Figures of one closed loop; the formulas are those of isolator test standards."""

    start: float
    """s, where the displacement passes the middle of its stroke upwards."""
    frequency: float
    """Hz, inverse of the duration."""
    amplitude: float
    """X in mm: half the stroke."""
    largest_force: float
    """N, of all samples."""
    smallest_force: float
    effective_stiffness: float
    """K_eff in N/mm: difference of two forces, chosen by the convention, over the stroke."""
    energy: float
    """W_D in N mm: the area of the loop, positive where the device dissipates."""
    damping_ratio: float
    """h = W_D / (2 pi K_eff X^2)."""
    characteristic_strength: float
    """Q_d in N: half the height of the loop at the middle of the stroke."""
    post_yield_stiffness: float
    """K_d in N/mm: mean slope of least-squares lines through both branches, within X / 2 of the middle."""
    storage_stiffness: float
    """K' in N/mm: fundamental of the force in phase with that of the displacement."""
    loss_stiffness: float
    """K'' in N/mm: a quarter of a period ahead of it."""

    @property
    def loss_factor(self) -> float:
        """K'' / K'."""
        return self.loss_stiffness / self.storage_stiffness if self.storage_stiffness else float("nan")


def measure_loop(
    time: Series, displacement: Series, force: Series, cycle: Cycle, convention: str = "displacement_extremes"
) -> Loop:
    """Measure one loop.

    Parameters
    ----------
    time, displacement, force : (n,) ndarray
        Samples in s, mm and N.
    cycle : Cycle
        Where the loop begins and ends.
    convention : {"displacement_extremes", "peak_force"}
        Forces that make the effective stiffness.

    Returns
    -------
    Loop
        Its figures.
    """
    inside = (time > cycle.start) & (time < cycle.stop)
    at = [cycle.start, cycle.turn, cycle.stop]
    ends = np.interp(at, time, force)
    t = np.concatenate([[cycle.start], time[inside], [cycle.stop]])
    x = np.concatenate([[cycle.middle], displacement[inside], [cycle.middle]])
    f = np.concatenate([ends[:1], force[inside], ends[2:]])
    top, bottom = _extreme(t, x), _extreme(t, -x)
    stroke = top[1] + bottom[1]
    largest, smallest = float(f.max()), float(f.min())
    if convention == "peak_force":
        difference = largest - smallest
    else:
        difference = float(np.interp(top[0], t, f) - np.interp(bottom[0], t, f))
    stiffness = difference / stroke
    energy = float(np.sum((f[1:] + f[:-1]) * np.diff(x)) / 2 + (f[-1] + f[0]) * (x[0] - x[-1]) / 2)
    amplitude = stroke / 2
    storage, loss = _complex_stiffness(t, x, f)
    return Loop(
        start=cycle.start,
        frequency=1 / (cycle.stop - cycle.start),
        amplitude=amplitude,
        largest_force=largest,
        smallest_force=smallest,
        effective_stiffness=stiffness,
        energy=energy,
        damping_ratio=energy / (2 * np.pi * stiffness * amplitude**2) if stiffness else float("nan"),
        characteristic_strength=float(ends[0] + ends[2] - 2 * ends[1]) / 4,
        post_yield_stiffness=_post_yield(t, x, f, top, bottom),
        storage_stiffness=storage,
        loss_stiffness=loss,
    )


def _extreme(t: Series, x: Series) -> tuple[float, float]:
    """Time and value of the largest x: the tip of a parabola through the samples around it."""
    peak = int(np.argmax(x))
    below = np.flatnonzero(x < x[peak] - _EXTREME * np.ptp(x))
    first = max(0, min(peak - 1, int(below[below < peak].max(initial=-1)) + 1))
    last = min(len(x) - 1, max(peak + 1, int(below[below > peak].min(initial=len(x))) - 1))
    near, far = t[first] - t[peak], t[last] - t[peak]
    scale = max(-near, far) or 1.0
    s = (t[first : last + 1] - t[peak]) / scale
    if len(s) < 3:
        return float(t[peak]), float(x[peak])
    curve, slope, value = np.polynomial.polynomial.polyfit(s, x[first : last + 1], 2)[::-1]
    at = -slope / (2 * curve) if curve < 0 else 0.0
    if not s[0] <= at <= s[-1]:
        return float(t[peak]), float(x[peak])
    return float(t[peak] + at * scale), float(value + slope * at / 2)


def _post_yield(
    t: Series, x: Series, f: Series, top: tuple[float, float], bottom: tuple[float, float]
) -> float:
    middle, half = (top[1] - bottom[1]) / 2, _LINE * (top[1] + bottom[1]) / 2
    near = np.abs(x - middle) <= half
    falling = (t > min(top[0], bottom[0])) & (t < max(top[0], bottom[0]))
    slopes = []
    for branch in (near & falling, near & ~falling):
        if len(part := x[branch]) < 2 or np.ptp(part) == 0:
            return float("nan")
        slopes.append(float(np.polynomial.polynomial.polyfit(part - middle, f[branch], 1)[1]))
    return sum(slopes) / 2


def _complex_stiffness(t: Series, x: Series, f: Series) -> tuple[float, float]:
    """Quotient of the fundamentals of force and displacement over one period, by the trapezoid rule."""
    turn = np.exp(-2j * np.pi * (t - t[0]) / (t[-1] - t[0]))
    step = np.diff(t)

    def fundamental(y: Series) -> complex:
        z = (y - y.mean()) * turn
        return complex(np.sum((z[1:] + z[:-1]) / 2 * step))

    quotient = fundamental(f) / fundamental(x)
    return quotient.real, quotient.imag
