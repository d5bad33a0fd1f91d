"""How one parameter depends on the current: values at a few currents, and weights between them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import InputError
from ..stored import number

LAWS = ("constant", "linear", "saturating", "quadratic", "free")
"""Simple ones first."""
FEWEST = {"constant": 1, "linear": 2, "quadratic": 3, "saturating": 3, "free": 1}
"""Levels of the current that a law needs to be determined."""


@dataclass(frozen=True)
class Law:
    """A law without its values, over the current in A or what else a model says (`Model.over`).

    Between the lowest current ``a`` and the highest ``b``, with ``u = (I - a) / (b - a)``:

    | law | values at | weight of the last value |
    |---|---|---|
    | constant | a | 1 |
    | linear | a, b | u |
    | quadratic | a, (a + b) / 2, b | u (2 u - 1), those of Lagrange |
    | saturating | a, b | (1 - exp(-(I - a) / s)) / (1 - exp(-(b - a) / s)) |
    | free | every level | linear from level to level |

    The weights sum to one, so that the values have the unit and the bounds of the parameter. Outside, the
    nearest of ``a`` and ``b`` is taken.
    """

    kind: str
    nodes: tuple[float, ...]
    """Currents of the values, A."""
    saturation: float | None = None
    """s in A, of a saturating law."""

    @classmethod
    def of(cls, kind: str, levels: Sequence[float], saturation: float | None = None) -> Self:
        """Make the law of a kind over tested levels of the current, in rising order."""
        low, high = levels[0], levels[-1]
        nodes = {
            "constant": (low,),
            "linear": (low, high),
            "quadratic": (low, (low + high) / 2, high),
            "saturating": (low, high),
            "free": tuple(levels),
        }[kind]
        return cls(kind, nodes, saturation)

    def weights(self, current: ArrayLike) -> NDArray[np.float64]:
        """Weights of the values at currents in A, shape (n, number of values)."""
        low, high = self.nodes[0], self.nodes[-1]
        inside = np.clip(np.atleast_1d(np.asarray(current, dtype=np.float64)), low, high)
        if len(self.nodes) == 1:
            return np.ones((len(inside), 1))
        u = (inside - low) / (high - low)
        if self.kind == "quadratic":
            return np.stack([(1 - u) * (1 - 2 * u), 4 * u * (1 - u), u * (2 * u - 1)], axis=1)
        if self.kind == "free":
            rows = np.eye(len(self.nodes))
            return np.stack([np.interp(inside, self.nodes, row) for row in rows], axis=1)
        if self.kind == "saturating" and self.saturation is not None:
            u = np.expm1(-(inside - low) / self.saturation) / np.expm1(-(high - low) / self.saturation)
        return np.stack([1 - u, u], axis=1)


@dataclass(frozen=True)
class Dependence:
    """A law with its values: a parameter over the current."""

    law: Law
    values: tuple[float, ...]

    def at(self, current: ArrayLike) -> NDArray[np.float64]:
        """Values at currents in A, shape (n,)."""
        found: NDArray[np.float64] = self.law.weights(current) @ np.array(self.values)
        return found

    def to_dict(self) -> dict[str, Any]:
        """Content of a model file."""
        content = {
            "law": self.law.kind,
            "at": list(self.law.nodes),
            "value": list(self.values),
        }
        return content | ({} if self.law.saturation is None else {"saturation": self.law.saturation})

    @classmethod
    def from_dict(cls, content: Mapping[str, Any]) -> Self:
        """Read the content of a model file.

        Raises
        ------
        InputError
            An unknown law, currents that do not rise, another number of values, or one that is not finite.
        """
        kind = str(content["law"])
        nodes = tuple(number(value, f"a current of a {kind} law") for value in content["at"])
        values = tuple(number(value, f"a value of a {kind} law") for value in content["value"])
        saturation = content.get("saturation")
        saturation = None if saturation is None else number(saturation, "saturation")
        if kind not in LAWS:
            raise InputError(f"the law is {kind!r}", wanted=f"one of {', '.join(LAWS)}")
        if len(nodes) != len(values) or not nodes or list(nodes) != sorted(set(nodes)):
            raise InputError(
                f"a law with {len(values)} values at {list(nodes)} A", wanted="one a rising current"
            )
        count = {"constant": 1, "linear": 2, "quadratic": 3, "saturating": 2}.get(kind, len(nodes))
        numbers = [*nodes, *values, *([] if saturation is None else [saturation])]
        if len(nodes) != count or not np.isfinite(numbers).all():
            raise InputError(f"a {kind} law with values {list(values)}", wanted=f"{count} finite values")
        if (saturation is not None) != (kind == "saturating") or (saturation is not None and saturation <= 0):
            wanted = "a positive one for a saturating law, none for others"
            raise InputError(f"saturation is {saturation} in a {kind} law", wanted=wanted)
        return cls(Law(kind, nodes, saturation), values)
