"""Which parameters of a model are coefficients, which are shapes, and their physical limits."""

from dataclasses import dataclass

import numpy as np

from .._core import parameters
from ..checks import choice

_SHAPES = {"kelvin_voigt": (), "sinh": ("beta",), "bouc_wen": ("rho", "sigma", "n")}
_SHAPED = {"sinh": "alpha", "bouc_wen": "kw"}
"""The coefficient whose column follows the shapes."""
_NOT_NEGATIVE = {"c0", "k0", "kx", "kw"}


@dataclass(frozen=True)
class Structure:
    """Parameters of a model: the force is linear in its coefficients, for given shapes."""

    model: str
    names: tuple[str, ...]
    """All, in the order of the equation."""
    units: tuple[str, ...]
    coefficients: tuple[str, ...]
    shapes: tuple[str, ...]

    @property
    def shaped(self) -> str | None:
        """The coefficient whose column follows the shapes; None where there are no shapes."""
        return _SHAPED.get(self.model)

    @classmethod
    def of(cls, model: str) -> "Structure":
        """Look a model up.

        Raises
        ------
        InputError
            There is no such model.
        """
        choice(model, "model", _SHAPES)
        rows = parameters(model)
        names = tuple(name for name, _ in rows)
        shapes = _SHAPES[model]
        coefficients = tuple(name for name in names if name not in shapes)
        return cls(model, names, tuple(unit for _, unit in rows), coefficients, shapes)

    def limits(self, largest_force: float) -> dict[str, tuple[float, float]]:
        """Limits of the coefficients; alpha is held as in the default box of `Problem`."""
        limits = {}
        for name in self.coefficients:
            low = 0.0 if name in _NOT_NEGATIVE else -np.inf
            limits[name] = (low, np.inf)
            if name == "alpha":
                limits[name] = (-2 * largest_force, 2 * largest_force)
        return limits
