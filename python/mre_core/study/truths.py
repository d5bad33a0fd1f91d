"""Three devices for Figure 11, each tested like the paper's: who fits best depends on what the device is.

All start from rest, swell for a second and then move steadily; the start is excluded from the fitness, so
that no model is judged by a state it cannot know. Their peak forces are near those of the paper's figures.
"""

from collections.abc import Callable

import numpy as np

from .._core import Recording
from ..effects import Effect
from ..model import Level, Model, simulate
from ..replica import BETA, CAMPAIGN, OFFSET, SAMPLING_RATE, Condition, measured
from .campaign import Campaign, as_campaign

_SECONDS = 4.0
# By current in A: c0 (N s/mm), kx (N/mm), kw (N), k_3 (N/mm^3).
_BOUC_WEN = {
    0: (0.25, 3.8, 2.1, 0.0073),
    1: (0.7, 14.9, 13.7, 0.029),
    2: (0.7, 25.3, 37.0, 0.051),
    3: (0.7, 32.9, 58.0, 0.067),
}
_SHAPES = {"rho": 0.65, "sigma": 1.5, "n": 1.7}
# By current in A: c0 (N s/mm), k0 (N/mm), alpha (N), k_m (N/mm).
_RUBBER = {
    0: (0.25, 5.3, 1.5, 0.55),
    1: (0.95, 24.5, 1.5, 2.0),
    2: (1.5, 45.5, 3.0, 3.5),
    3: (1.9, 61.0, 4.0, 4.5),
}
_PAYNE = Effect("payne_softening", "Kraus, stiffness", {"s": 0.5, "x_c": 2.0, "t_a": 0.5, "m": 1.0})
_TAU = 0.3


def truths(seed: int) -> dict[str, Campaign]:
    """Simulate the twelve tests of each device, with the same noise.

    Parameters
    ----------
    seed : int
        Of the noise.

    Returns
    -------
    dict
        Campaigns by the name of the device.
    """
    devices: dict[str, Callable[[Condition], Model]] = {
        "sinh model": _sinh,
        "Bouc-Wen with stiffening": _bouc_wen,
        "Maxwell branch and Payne softening": _rubber,
    }
    return {
        name: as_campaign([_record(condition, device(condition), seed) for condition in CAMPAIGN])
        for name, device in devices.items()
    }


def _record(condition: Condition, device: Model, seed: int) -> Recording:
    time = np.arange(round(_SECONDS * SAMPLING_RATE) + 1) / SAMPLING_RATE
    rise, turn = np.clip(time, 0, 1), 2 * np.pi
    swell, growth = rise**2 * (3 - 2 * rise), 6 * rise * (1 - rise)
    sine, cosine = np.sin(turn * time), np.cos(turn * time)
    velocity = condition.amplitude * (growth * sine + swell * turn * cosine)
    true = Recording(time, condition.amplitude * swell * sine, None, velocity=velocity)
    return measured(condition, true, simulate(device, true), seed).exclude("start_transient")


def _sinh(condition: Condition) -> Model:
    names = ("c0", "k0", "alpha", "beta", "F0")
    return _device("sinh", dict(zip(names, condition.values, strict=True)))


def _bouc_wen(condition: Condition) -> Model:
    c0, kx, kw, cubic = _BOUC_WEN[round(condition.current)]
    stiffening = Effect("cubic_stiffness", "cubic", {"k_3": cubic})
    return _device("bouc_wen", {"c0": c0, "kx": kx, "kw": kw, **_SHAPES, "F0": OFFSET}, stiffening)


def _rubber(condition: Condition) -> Model:
    c0, k0, alpha, k_m = _RUBBER[round(condition.current)]
    branch = Effect("maxwell_relaxation", "one branch", {"k_m": k_m, "tau": _TAU})
    values = {"c0": c0, "k0": k0, "alpha": alpha, "beta": BETA, "F0": OFFSET}
    return _device("sinh", values, _PAYNE, branch)


def _device(name: str, values: dict[str, float], *effects: Effect) -> Model:
    return Model(name, (Level(None, values),), effects=effects, sizes=_SIZES if effects else {})


_SIZES = {
    "displacement": 8.0,
    "velocity": 51.0,
    "force": 350.0,
    "step": 1 / SAMPLING_RATE,
    "duration": _SECONDS,
    "total": 12 * _SECONDS,
    "path": 130.0,
    "energy": 1e4,
    "dissipated": 3e3,
    "current": None,
    "current_varies": False,
    "quantum": None,
}
"""Round values for the campaign: these effects take nothing of weight from them."""
