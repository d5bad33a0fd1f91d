"""The base model of the rivals: its best fit, and how its force changes with each parameter."""

from dataclasses import dataclass

import mre_core
import numpy as np
from mre_core import Level, Model, Recording
from problem import Array, force_of


@dataclass(frozen=True)
class Base:
    """A fitted base model; the Jacobian lets it be refitted beside what is added to it."""

    model: Model

    def force(self, recordings: list[Recording]) -> Array:
        """Force of the fit, all recordings in one row."""
        return np.concatenate([mre_core.simulate(self.model, r) for r in recordings])

    def jacobian(self, recordings: list[Recording]) -> Array:
        """Derivatives by all parameters of all levels, shape (samples, parameters)."""
        here = self.force(recordings)
        columns = []
        for i, level in enumerate(self.model.levels):
            for name, value in level.parameters.items():
                step = 1e-5 * max(abs(value), 1e-3)
                moved = Level(level.current, dict(level.parameters) | {name: value + step})
                levels = (*self.model.levels[:i], moved, *self.model.levels[i + 1 :])
                there = Base(Model(self.model.name, levels)).force(recordings)
                columns.append((there - here) / step)
        return np.column_stack(columns)


def fitted(recordings: list[Recording], name: str) -> Base:
    """Fit by the exact method, which is the best that the base can do."""
    found = mre_core.identify(recordings, name, optimizer="exact", seed=1, threads=1)
    return Base(Model(name, found.model.levels))


def left_over(recordings: list[Recording], base: Base) -> tuple[Array, Array]:
    """What is left of the force, and the Jacobian."""
    return force_of(recordings) - base.force(recordings), base.jacobian(recordings)
