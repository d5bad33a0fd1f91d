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
    """The motion without noise, from the start of the run-in, and the current of the recorded samples.

    The base model is refitted with its true history, so that an unknown initial state is no mismatch.
    """

    path: Path
    run_in: int
    current: Array

    @property
    def x(self) -> Array:
        return self.path.x[self.run_in :]

    @property
    def v(self) -> Array:
        return self.path.v[self.run_in :]


class Refit:
    """Best fits of a base model, each started from the one before."""

    def __init__(self, device: Device) -> None:
        self.base, self.names = device.base, SHAPE[device.base]
        self.start = [device.shape[name] for name in self.names]

    def unexplained(self, seen: Sequence[Sampled], forces: Sequence[Array]) -> float:
        """Root mean square (N) of what is left; parameters are separate for each constant current."""
        varied = any(np.ptp(one.current) > 0 for one in seen)
        levels = [None] if varied else sorted({float(one.current[0]) for one in seen})
        square, count = 0.0, 0
        for level in levels:
            chosen = [i for i, one in enumerate(seen) if level is None or float(one.current[0]) == level]
            residual = self._best([seen[i] for i in chosen], np.concatenate([forces[i] for i in chosen]))
            square, count = square + float(residual @ residual), count + len(residual)
        return float(np.sqrt(square / count))

    def _misfit(self, shape: Sequence[float], seen: Sequence[Sampled], force: Array) -> Array:
        """Residual of the best linear parameters for the given shape parameters."""
        named = dict(zip(self.names, shape, strict=True))
        blocks = []
        for one in seen:
            columns = basis(self.base, named, one.path, one.path.x)
            blocks.append(np.column_stack(list(columns.values()))[one.run_in :])
        matrix = np.concatenate(blocks)
        current = np.concatenate([one.current for one in seen])
        if np.ptp(current) > 0:
            matrix = np.column_stack([matrix, matrix[:, :-1] * current[:, None]])
        matrix /= np.linalg.norm(matrix, axis=0)
        q, _ = np.linalg.qr(matrix)
        residual: Array = force - q @ (q.T @ force)
        return residual

    def _best(self, seen: Sequence[Sampled], force: Array) -> Array:
        if self.base == "kelvin_voigt":
            return self._misfit([], seen, force)
        if self.base == "sinh":
            return self._best_sinh(seen, force)
        fit = least_squares(
            lambda p: self._misfit(np.exp(p).tolist(), seen, force),
            np.log(self.start),
            bounds=(np.log([1e-3, 0.5, 1.0]) - 1e-9, np.log([1e3, 20.0, 10.0])),
            x_scale=0.3,
            diff_step=1e-4,
            ftol=1e-5,
            xtol=1e-4,
            max_nfev=25,
        )
        self.start = np.exp(fit.x).tolist()
        residual: Array = fit.fun
        return residual

    def _best_sinh(self, seen: Sequence[Sampled], force: Array) -> Array:
        """The whole range of the one shape parameter, from a cubic term to a wall."""
        stroke = max(float(np.max(np.abs(one.x))) for one in seen)

        def cost(logarithm: float) -> float:
            residual = self._misfit([float(np.exp(logarithm))], seen, force)
            return float(residual @ residual)

        grid = np.log(np.array([0.2, 0.6, 1.2, 2.0, 3.0, 5.0, 9.0]) / stroke)
        near = int(np.argmin([cost(g) for g in grid]))
        bounds = (grid[max(near - 1, 0)], grid[min(near + 1, len(grid) - 1)])
        found = minimize_scalar(cost, bounds=bounds, method="bounded", options={"xatol": 1e-3})
        return self._misfit([float(np.exp(found.x))], seen, force)
