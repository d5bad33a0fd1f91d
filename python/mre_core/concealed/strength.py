"""The size of an effect at which it leaves a wanted mismatch."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Solved:
    """Size and the mismatch it leaves; `reached` is false where no size leaves what was wanted."""

    size: float
    left: float
    reached: bool


def solved(left: Callable[[float], float], wanted: float, typical: float, largest: float) -> Solved:
    """Secant steps on logarithms, within a bracket as soon as there is one; half a percent is near enough."""
    low, high = (0.0, 0.0), (largest, np.inf)
    size, power = min(typical, largest), 1.0
    best = Solved(size, 0.0, False)
    last: tuple[float, float] | None = None
    for _ in range(30):
        found = left(size)
        if best.left == 0 or abs(np.log(max(found, 1e-300) / wanted)) < abs(np.log(best.left / wanted)):
            best = Solved(size, max(found, 1e-300), False)
        if abs(found / wanted - 1) < 0.005:
            return Solved(size, found, True)
        if found < wanted:
            if size >= largest:
                return best
            low = max(low, (size, found))
        else:
            high = min(high, (size, found))
        if last and last[0] != size and found > 0 and last[1] > 0:
            power = float(np.clip(np.log(found / last[1]) / np.log(size / last[0]), 0.3, 4.0))
        last = (size, found)
        ratio = float(np.clip((wanted / max(found, 1e-300)) ** (1 / power), 1e-3, 1e3))
        step = size * ratio
        if not low[0] < step < high[0]:
            step = float(np.sqrt(max(low[0], 1e-3 * size) * high[0])) if np.isfinite(high[0]) else 2 * low[0]
            step = largest if high[1] == np.inf and step < low[0] * 1.5 else step
        size = min(step, largest)
        if high[0] < np.inf and high[1] < np.inf and high[0] - low[0] < 1e-9 * high[0]:
            break
    return best
