"""Viscoelastic memory: Maxwell branches, fractional elements, creep."""

from collections.abc import Callable

import numpy as np

from ..devices import Parts
from ..filters import convolved, lag
from ..kinematics import Array
from ..law import Law, Rig, added, law, softening
from ..track import Track


@law("maxwell_relaxation", "branch")
def branch(rng: np.random.Generator, rig: Rig) -> Law:
    tau = rig.log(rng, 0.02, 0.5)
    return added("k_m", "N/mm", {"tau": tau}, lambda track, parts: lag(track.v, track.h, tau))


@law("maxwell_relaxation", "two_branches")
def two_branches(rng: np.random.Generator, rig: Rig) -> Law:
    fast = rig.log(rng, 0.01, 0.05)
    slow = fast * float(rng.uniform(6, 20))
    share = float(rng.uniform(0.35, 0.65))

    def act(track: Track, parts: Parts) -> Array:
        return share * lag(track.v, track.h, fast) + (1 - share) * lag(track.v, track.h, slow)

    return added("k_m", "N/mm", {"tau_fast": fast, "tau_slow": slow, "share_fast": share}, act)


@law("maxwell_relaxation", "quasi_linear")
def quasi_linear(rng: np.random.Generator, rig: Rig) -> Law:
    """Fung's form: the elastic force relaxes, not the displacement (a standard solid in stress form)."""
    tau = rig.log(rng, 0.02, 0.5)

    def act(track: Track, parts: Parts) -> Array:
        return lag(np.gradient(parts.elastic, track.h, edge_order=2), track.h, tau)

    return added("share", "1", {"tau": tau}, act)


class Springpot:
    """s^order; an object with equality, so that the weights of one step are computed once."""

    def __init__(self, order: float, tau: float = 0.0) -> None:
        self.key = (order, tau)

    def __hash__(self) -> int:
        return hash(self.key)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Springpot) and self.key == other.key

    def __call__(self, s: Array) -> Array:
        order, tau = self.key
        if tau == 0.0:
            return s**order
        power = (s * tau) ** order
        return power / (1 + power)


@law("fractional_viscoelasticity", "springpot")
def springpot(rng: np.random.Generator, rig: Rig) -> Law:
    order = float(rng.uniform(0.1, 0.4))
    return _fractional("c_alpha", "N s^alpha/mm", {"alpha": order}, Springpot(order))


@law("fractional_viscoelasticity", "fractional_zener")
def fractional_zener(rng: np.random.Generator, rig: Rig) -> Law:
    order, tau = float(rng.uniform(0.2, 0.5)), rig.log(rng, 0.01, 0.1)
    return _fractional("k_1", "N/mm", {"alpha": order, "tau": tau}, Springpot(order, tau))


def _fractional(size: str, unit: str, shape: dict[str, float], transfer: Callable[[Array], Array]) -> Law:
    return added(size, unit, shape, lambda track, parts: convolved(track.x, track.h, transfer))


@law("fractional_viscoelasticity", "many_branches")
def many_branches(rng: np.random.Generator, rig: Rig) -> Law:
    """The power law of a springpot by Maxwell branches with log-spaced relaxation times."""
    order = float(rng.uniform(0.1, 0.4))
    taus = np.geomspace(2e-3, 50.0, 14)

    def act(track: Track, parts: Parts) -> Array:
        total: Array = np.sum([tau**-order * lag(track.v, track.h, tau) for tau in taus], axis=0)
        return total

    return added("k", "N/mm", {"alpha": order}, act)


@law("creep", "logarithmic")
def logarithmic(rng: np.random.Generator, rig: Rig) -> Law:
    """The elastic force falls with the logarithm of the time since the start."""
    start = rig.log(rng, 0.3, 1.0)

    def act(track: Track, parts: Parts, size: float) -> Array:
        return 1 - size * np.log10(1 + np.maximum(track.t, 0) / start)

    return softening({"t_0": start}, act, largest=0.5)


@law("creep", "log_kernel")
def log_kernel(rng: np.random.Generator, rig: Rig) -> Law:
    """Superposition: every increment of the elastic force relaxes with the logarithm of its own age."""
    taus = np.geomspace(2.0, 2000.0, 10)

    def act(track: Track, parts: Parts) -> Array:
        rate = np.gradient(parts.elastic, track.h, edge_order=2)
        total: Array = np.sum([lag(rate, track.h, tau) for tau in taus], axis=0)
        return total / len(taus)

    return added("share", "1", {}, act)


@law("creep", "slow_branches")
def slow_branches(rng: np.random.Generator, rig: Rig) -> Law:
    taus = [rig.log(rng, 5, 15), rig.log(rng, 30, 80), rig.log(rng, 150, 400)]

    def act(track: Track, parts: Parts) -> Array:
        total: Array = np.sum([lag(track.v, track.h, tau) for tau in taus], axis=0)
        return total

    return added("k_each", "N/mm", {f"tau_{i}": tau for i, tau in enumerate(taus)}, act)
