"""What the base model cannot explain: its best fit to noise-free data by variable projection."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares, minimize_scalar  # type: ignore[import-untyped]

from .devices import SHAPE, Device, basis
from .kinematics import Array
from .paths import Path


@dataclass(frozen=True)
class Sampled:
    """What the recording shows of the motion, without noise."""

    path: Path
    current: Array


def _misfit(device: Device, shape: dict[str, float], seen: Sequence[Sampled], force: Array) -> Array:
    """Residual of the best linear parameters for the given shape parameters."""
    columns = [basis(device.base, shape, one.path, one.path.x) for one in seen]
    matrix = np.column_stack([np.concatenate([c[name] for c in columns]) for name in columns[0]])
    current = np.concatenate([one.current for one in seen])
    if np.ptp(current) > 0:
        matrix = np.column_stack([matrix, matrix[:, :-1] * current[:, None]])
    matrix /= np.linalg.norm(matrix, axis=0)
    q, _ = np.linalg.qr(matrix)
    residual: Array = force - q @ (q.T @ force)
    return residual


def _best(device: Device, seen: Sequence[Sampled], force: Array) -> Array:
    names = SHAPE[device.base]
    if not names:
        return _misfit(device, {}, seen, force)
    if device.base == "sinh":
        stroke = max(float(np.max(np.abs(one.path.x))) for one in seen)

        def cost(logarithm: float) -> float:
            residual = _misfit(device, {"beta": float(np.exp(logarithm))}, seen, force)
            return float(residual @ residual)

        grid = np.log(np.array([0.2, 0.5, 1.0, 1.6, 2.2, 3.0, 4.0, 6.0, 9.0]) / stroke)
        near = int(np.argmin([cost(g) for g in grid]))
        bounds = (grid[max(near - 1, 0)], grid[min(near + 1, len(grid) - 1)])
        found = minimize_scalar(cost, bounds=bounds, method="bounded", options={"xatol": 1e-4})
        return _misfit(device, {"beta": float(np.exp(found.x))}, seen, force)
    start = np.log([device.shape[name] for name in names])
    fit = least_squares(
        lambda p: _misfit(device, dict(zip(names, np.exp(p).tolist(), strict=True)), seen, force),
        start,
        bounds=(np.log([1e-3, 0.5, 1.0]) - 1e-9, np.log([1e3, 20.0, 10.0])),
        x_scale=0.3,
        diff_step=1e-4,
        ftol=1e-6,
        xtol=1e-5,
        max_nfev=25,
    )
    residual: Array = fit.fun
    return residual


def unexplained(device: Device, seen: Sequence[Sampled], forces: Sequence[Array]) -> float:
    """Root mean square (N) of what is left; parameters are separate for each constant current."""
    varied = any(np.ptp(one.current) > 0 for one in seen)
    levels = [None] if varied else sorted({float(one.current[0]) for one in seen})
    square, count = 0.0, 0
    for level in levels:
        chosen = [i for i, one in enumerate(seen) if level is None or float(one.current[0]) == level]
        residual = _best(device, [seen[i] for i in chosen], np.concatenate([forces[i] for i in chosen]))
        square, count = square + float(residual @ residual), count + len(residual)
    return float(np.sqrt(square / count))
