"""A campaign of recordings of a base device with effects that the base model lacks."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from . import laws as laws
from .devices import Device, drawn
from .excitations import Excitation
from .kinematics import Array
from .law import Added, Law, Rig, drawn_law, laws_of
from .noise import noisy
from .programmes import campaign_of
from .refit import unexplained
from .simulate import Chain, Shown, shown
from .strength import solved

FINE = 1600.0
"""Least rate (Hz) of the fine grid."""
OWN_EXCITATION = {
    "field_lag": "field",
    "field_remanence": "field",
    "field_dependence": "field",
    "creep": "offset",
}


@dataclass(frozen=True)
class Recorded:
    """One recording: s, mm, mm/s, N, A; `truth` is the force without noise."""

    name: str
    time: Array
    displacement: Array
    velocity: Array | None
    force: Array
    current: Array
    temperature: Array | None
    truth: Array


@dataclass(frozen=True)
class Concealed:
    """One effect as it was simulated; `unexplained` is what it alone leaves of the refitted base model (N)."""

    effect: str
    law: str
    size: str
    unit: str
    parameters: dict[str, float]
    unexplained: float
    reached: bool


@dataclass(frozen=True)
class Campaign:
    """Recordings and what is true about them; rms values in N."""

    recordings: list[Recorded]
    base: str
    base_parameters: list[dict[str, float]]
    effects: list[Concealed]
    noise: str
    noise_rms: float
    unexplained_rms: float
    force_rms: float
    excitation: str
    seed: int

    @property
    def ids(self) -> list[str]:
        return [one.effect for one in self.effects]

    @property
    def reached(self) -> bool:
        return all(one.reached for one in self.effects)


def rms(arrays: Sequence[Array]) -> float:
    return float(np.sqrt(sum(float(a @ a) for a in arrays) / sum(len(a) for a in arrays)))


class Bench:
    """A device, its excitations and the fine grid on which it is simulated."""

    def __init__(self, device: Device, excitations: Sequence[Excitation], fine: float) -> None:
        self.device, self.excitations, self.fine = device, excitations, fine

    def show(self, chain: Chain) -> list[Shown]:
        count = len(self.excitations)
        return [
            shown(one, i, count, self.device, chain, max(2, int(np.ceil(self.fine / one.rate - 1e-9))))
            for i, one in enumerate(self.excitations)
        ]

    def left(self, views: Sequence[Shown]) -> float:
        return unexplained(self.device, [v.seen for v in views], [v.force for v in views])

    def rig(self) -> Rig:
        """Extremes of the recordings, of the bare device."""
        views = self.show([])
        x, v, force = (
            np.concatenate(a)
            for a in zip(*((s.seen.path.x, s.seen.path.v, s.force) for s in views), strict=True)
        )
        matrix = np.column_stack([x, v, np.ones_like(x)])
        stiffness = float(np.linalg.lstsq(matrix, force, rcond=None)[0][0])
        acceleration = max(float(np.max(np.abs(np.gradient(s.seen.path.v, s.seen.path.h)))) for s in views)
        current = max(float(np.max(s.seen.current)) for s in views)
        duration = max(one.duration for one in self.excitations)
        extremes = (float(np.max(np.abs(a))) for a in (x, v))
        stroke, speed = extremes
        peak = float(np.max(np.abs(force)))
        return Rig(
            self.device.base, stroke, speed, acceleration, peak, stiffness, duration, len(views), current
        )

    def size_for(self, law: Law, wanted: float) -> tuple[float, float, bool]:
        """Size, mismatch left, and whether it is the wanted one."""
        if isinstance(law, Added):
            bare, unit = self.show([]), self.show([(law, 1.0)])
            seen, forces = [v.seen for v in bare], [v.force for v in bare]
            waves = [b.force - a.force for a, b in zip(bare, unit, strict=True)]

            def left(size: float) -> float:
                return unexplained(
                    self.device, seen, [f + size * w for f, w in zip(forces, waves, strict=True)]
                )

            found = solved(left, wanted, wanted / rms(waves) * 2, 2 * rms(forces) / rms(waves))
        else:
            found = solved(lambda size: self.left(self.show([(law, size)])), wanted, law.typical, law.largest)
        return found.size, found.left, found.reached


def make_campaign(
    effect: str | None | Sequence[str],
    law: str | Sequence[str] = "textbook",
    base: str = "sinh",
    strength: float = 3.0,
    noise: str = "white",
    seed: int = 0,
    excitation: str | None = None,
    samples: int | None = None,
    velocity: str = "given",
    *,
    rate: float | Sequence[float] = 200.0,
    noise_share: float = 0.01,
    displacement_noise: float = 0.0,
    temperature: bool = False,
    fine: float = FINE,
) -> Campaign:
    """Simulate recordings; see README.md for the arguments."""
    names = [] if effect is None else [effect] if isinstance(effect, str) else list(effect)
    forms = [law] * len(names) if isinstance(law, str) else list(law)
    if len(forms) != len(names):
        raise ValueError(f"law has {len(forms)} names for {len(names)} effects")
    if velocity not in ("given", "derived"):
        raise ValueError(f"velocity is {velocity!r}, wanted given or derived")
    motions, devices, effects, errors = (np.random.default_rng([seed, i]) for i in range(4))
    own = [OWN_EXCITATION[name] for name in names if name in OWN_EXCITATION]
    programme = excitation or (own[0] if own else "rich")
    rates = [rate] if isinstance(rate, int | float) else list(rate)
    excitations = campaign_of(programme, motions, rates, samples)
    bench = Bench(drawn(base, devices, 8.0), excitations, fine)
    noise_rms = noise_share * rms([v.force for v in bench.show([])])
    rig = bench.rig()
    chain: list[tuple[Law, float]] = []
    truths: list[Concealed] = []
    for name, form in zip(names, forms, strict=True):
        drew = drawn_law(name, form, effects, rig)
        size, left, reached = bench.size_for(drew, strength * noise_rms)
        chain.append((drew, size))
        form = laws_of(name)[0] if form == "textbook" else form
        parameters = {drew.size: size} | dict(drew.shape)
        truths.append(Concealed(name, form, drew.size, drew.unit, parameters, left, reached))
    views = bench.show(chain)
    recordings = [
        _recorded(one, view, noise, noise_rms, velocity, displacement_noise, temperature, errors)
        for one, view in zip(excitations, views, strict=True)
    ]
    currents = sorted({float(c) for view in views for c in view.seen.current[[0, -1]]})
    parameters_of_base = [{"current": c} | bench.device.at(c) for c in currents]
    forces = [view.force for view in views]
    return Campaign(
        recordings,
        base,
        parameters_of_base,
        truths,
        noise,
        noise_rms,
        bench.left(views),
        rms(forces),
        programme,
        seed,
    )


def _recorded(
    excitation: Excitation,
    view: Shown,
    noise: str,
    noise_rms: float,
    velocity: str,
    displacement_noise: float,
    temperature: bool,
    rng: np.random.Generator,
) -> Recorded:
    force = noisy(noise, view.force, noise_rms, excitation.rate, rng)
    shaken = view.seen.path.x + displacement_noise * rng.normal(size=len(force))
    degrees = 21 + 0.05 * rng.normal(size=len(force)) if temperature else None
    shown_velocity = view.seen.path.v if velocity == "given" else None
    return Recorded(
        excitation.name, view.time, shaken, shown_velocity, force, view.seen.current, degrees, view.force
    )
