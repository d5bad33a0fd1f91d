"""The three base devices with realistic parameters, solved without a time-stepping formula."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import lru_cache

import numpy as np

from .kinematics import Array
from .paths import Flow, Path, followed

BASES = ("kelvin_voigt", "sinh", "bouc_wen")
LINEAR = {
    "kelvin_voigt": ("c0", "k0", "F0"),
    "sinh": ("c0", "k0", "alpha", "F0"),
    "bouc_wen": ("c0", "kx", "kw", "F0"),
}
SHAPE = {"kelvin_voigt": (), "sinh": ("beta",), "bouc_wen": ("rho", "sigma", "n")}


@dataclass(frozen=True)
class Parts:
    """Forces of the base device at each sample; `extra` is what effects added."""

    elastic: Array
    viscous: Array
    hysteretic: Array
    offset: Array
    extra: Array

    @property
    def total(self) -> Array:
        return self.elastic + self.viscous + self.hysteretic + self.offset + self.extra

    def scaled(self, elastic: Array, rest: Array) -> "Parts":
        return replace(
            self,
            elastic=elastic * self.elastic,
            viscous=rest * self.viscous,
            hysteretic=rest * self.hysteretic,
        )


@lru_cache(maxsize=64)
def bouc_wen_flow(sigma: float, n: float, pinch: tuple[float, float, float] = (0.0, 0.0, 1.0)) -> Flow:
    """The normalised Bouc-Wen law along a monotone motion; `pinch` is Baber-Noori's depth, place, width."""
    depth, place, width = pinch

    def g(u: Array) -> Array:
        power = np.abs(u) ** n
        bare = np.where(u > 0, 1 - power, 1 + (2 * sigma - 1) * power)
        slope: Array = bare * (1 - depth * np.exp(-(((u - place) / width) ** 2)))
        return slope

    nodes = np.concatenate([np.linspace(-1.0, 0.0, 601), -np.expm1(-np.linspace(0, 28, 1401)[1:])])
    point, weight = np.polynomial.legendre.leggauss(4)
    half = np.diff(nodes) / 2
    inside = nodes[:-1, None] + half[:, None] * (1 + point)
    return Flow(nodes, g(nodes), half * ((1 / g(inside)) @ weight))


@dataclass(frozen=True)
class Device:
    """A base model whose linear parameters are affine in the current: value = p[0] + p[1] I."""

    base: str
    linear: Mapping[str, tuple[float, float]]
    shape: Mapping[str, float]
    pinch: tuple[float, float, float] = field(default=(0.0, 0.0, 1.0))

    def value(self, name: str, current: Array) -> Array:
        at_zero, slope = self.linear[name]
        return at_zero + slope * current

    def parts(self, path: Path, current: Array, spring: Array) -> Parts:
        """`spring` is the displacement that reaches the elastic part."""
        columns = basis(self.base, self.shape, path, spring, self.pinch)
        force = {name: self.value(name, current) * column for name, column in columns.items()}
        zero = np.zeros_like(spring)
        elastic = force.get("k0", zero) + force.get("kx", zero) + force.get("alpha", zero)
        return Parts(elastic, force["c0"], force.get("kw", zero), force["F0"], zero)

    def at(self, current: float) -> dict[str, float]:
        """All parameters at one current."""
        here = {name: float(self.value(name, np.array(current))) for name in self.linear}
        return here | dict(self.shape)


def basis(
    base: str,
    shape: Mapping[str, float],
    path: Path,
    spring: Array,
    pinch: tuple[float, float, float] = (0.0, 0.0, 1.0),
) -> dict[str, Array]:
    """What each linear parameter multiplies."""
    one = np.ones_like(spring)
    if base == "kelvin_voigt":
        return {"c0": path.v, "k0": spring, "F0": one}
    if base == "sinh":
        return {"c0": path.v, "k0": spring, "alpha": np.sinh(shape["beta"] * spring), "F0": one}
    flow = bouc_wen_flow(shape["sigma"], shape["n"], pinch)
    return {"c0": path.v, "kx": spring, "kw": followed(flow, path, shape["rho"]), "F0": one}


def drawn(base: str, rng: np.random.Generator, stroke: float) -> Device:
    """A random isolator; `stroke` (mm) is the largest displacement it will see."""
    k = float(np.exp(rng.uniform(np.log(5.0), np.log(50.0))))
    growth = float(rng.uniform(0.5, 1.5))
    offset = float(rng.uniform(-0.01, 0.01)) * k * stroke

    def affine(at_one_ampere: float) -> tuple[float, float]:
        at_zero = at_one_ampere / (1 + growth)
        return at_zero, at_one_ampere - at_zero

    linear = {"c0": affine(k * float(rng.uniform(0.03, 0.07))), "F0": (offset, 0.0)}
    if base == "kelvin_voigt":
        return Device(base, linear | {"k0": affine(k)}, {})
    if base == "sinh":
        beta = float(rng.uniform(1.4, 2.8)) / stroke
        share = float(rng.uniform(0.15, 0.5))
        return Device(
            base, linear | {"k0": affine((1 - share) * k), "alpha": affine(share * k / beta)}, {"beta": beta}
        )
    if base == "bouc_wen":
        rho = 1 / (stroke * float(rng.uniform(0.08, 0.3)))
        share = float(rng.uniform(0.3, 0.7))
        shape = {"rho": rho, "sigma": float(rng.uniform(0.6, 1.5)), "n": float(rng.uniform(1.0, 2.5))}
        return Device(base, linear | {"kx": affine((1 - share) * k), "kw": affine(share * k / rho)}, shape)
    raise ValueError(f"base is {base!r}, wanted one of {', '.join(BASES)}")
