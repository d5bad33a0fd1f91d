"""A campaign of recordings of a base device with effects that the base model lacks."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from . import laws as laws
from .bench import FINE, Bench, rms
from .devices import drawn
from .excitations import Excitation
from .kinematics import Array
from .law import Law, drawn_law, laws_of
from .noise import noisy
from .programmes import campaign_of
from .simulate import Shown

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
    """One effect as it was simulated; `unexplained` is what it alone leaves of the refitted base (N)."""

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


def make_campaign(
    effect: str | Sequence[str] | None,
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
    also: Sequence[Excitation] = (),
) -> Campaign:
    """Simulate the recordings of a device with effects that its base model lacks.

    Parameters
    ----------
    effect : str, sequence of str or None
        An id of `effects()`, ``"unknown"``, several of them, or nothing.
    law : str or sequence of str
        ``"textbook"`` or one of `laws_of(effect)`; one for each effect.
    base : {"kelvin_voigt", "sinh", "bouc_wen"}
        The device without effects.
    strength : float
        Rms that each effect alone leaves of the refitted base, over that of the noise.
    noise : str
        One of ``white, ar60, ar97, ar995, pink, narrow, mains, student, quantised, none``.
    seed : int
        Device, motions, parameters and noise are functions of it.
    excitation : str, optional
        ``rich`` unless the effect needs another: see README.md.
    samples : int, optional
        Of all recordings together; 12 s each where not given.
    velocity : {"given", "derived"}
        Whether a velocity is recorded.
    rate : float or sequence of float
        Hz; several are used in turn.
    noise_share : float
        Rms of the noise over that of the bare device's force.
    displacement_noise : float
        Rms in mm of white noise on the recorded displacement.
    temperature : bool
        Record an ambient temperature that tells nothing.
    fine : float
        Least rate of the grid of the simulation, Hz.
    also : sequence of Excitation
        Recorded after the others, which they do not change.

    Returns
    -------
    Campaign
        Recordings (arrays of shape (n,)) and the truth.

    Raises
    ------
    ValueError
        A name is not known.
    """
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
        found = bench.size_for(drew, strength * noise_rms)
        chain.append((drew, found.size))
        form = laws_of(name)[0] if form == "textbook" else form
        parameters = {drew.size: found.size} | dict(drew.shape)
        truths.append(Concealed(name, form, drew.size, drew.unit, parameters, found.left, found.reached))
    views = bench.show(chain)
    shown = [*views, *(bench.then(also, fine).show(chain) if also else ())]
    recordings = [
        _recorded(one, view, noise, noise_rms, velocity, displacement_noise, temperature, errors)
        for one, view in zip([*excitations, *also], shown, strict=True)
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
    shaken = view.seen.x + displacement_noise * rng.normal(size=len(force))
    degrees = 21 + 0.05 * rng.normal(size=len(force)) if temperature else None
    shown_velocity = view.seen.v if velocity == "given" else None
    return Recorded(
        excitation.name, view.time, shaken, shown_velocity, force, view.seen.current, degrees, view.force
    )
