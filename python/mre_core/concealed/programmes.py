"""Campaigns: which recordings a laboratory makes, drawn by a seed."""

from collections.abc import Callable, Sequence

import numpy as np

from .excitations import (
    Excitation,
    current_ramps,
    current_sine,
    current_staircase,
    earthquake,
    held,
    odd_multisine,
    staircase,
    steady,
    steady_current,
    sweep,
)
from .kinematics import Course, Motion

Rates = Sequence[float]
RUN_IN = 4.0


class Lab:
    """Makes excitations one after the other at the given rates, all of one duration."""

    def __init__(self, rng: np.random.Generator, rates: Rates, duration: float) -> None:
        self.rng, self.rates, self.duration = rng, rates, duration
        self.made: list[Excitation] = []

    def near(self, value: float, spread: float = 0.12) -> float:
        return value * float(self.rng.uniform(1 - spread, 1 + spread))

    def record(self, name: str, motion: Motion, current: Course, run_in: float = 0.0) -> None:
        rate = self.rates[len(self.made) % len(self.rates)]
        samples = round(rate * self.duration)
        label = f"{len(self.made) + 1:02d}_{name}"
        self.made.append(Excitation(label, rate, samples, motion, current, run_in))

    def staircase(self, frequency: float, amplitudes: Sequence[float], current: Course) -> None:
        f = self.near(frequency)
        sizes = [self.near(a) for a in amplitudes]
        motion = staircase(f, float(self.rng.uniform(0, 2 * np.pi)), sizes, self.duration)
        self.record(f"sine_{f:.2f}Hz", motion, current)


def rich(lab: Lab) -> None:
    """Sines of three frequencies with rising and falling amplitude, rests, multisine, sweep, earthquake."""
    current = steady_current(1.0)
    lab.staircase(0.7, [2.0, 4.0, 8.0, 4.0, 2.0], current)
    lab.staircase(1.8, [2.0, 6.0, 0.0, 4.0, 2.0], current)
    lab.staircase(4.2, [1.5, 3.0, 2.0, 0.0, 1.5], current)
    lab.record("multisine", odd_multisine(lab.rng, 6.0, lab.near(6.0)), current)
    lab.record("sweep", sweep(0.4, 5.0, lab.near(3.0), lab.duration), current)
    lab.record("earthquake", earthquake(lab.rng, lab.duration, lab.near(8.0)), current)
    lab.staircase(1.1, [8.0, 0.0, 3.0, 5.0, 0.0, 3.0], current)


def offset(lab: Lab) -> None:
    """The rich campaign with two recordings that hold an offset."""
    rich(lab)
    lab.made = lab.made[:5]
    for place in (5.0, -4.0):
        motion = held(lab.near(place), lab.near(2.0), lab.near(1.5), lab.duration)
        lab.record("hold", motion, steady_current(1.0))


def single(lab: Lab) -> None:
    lab.record("multisine", odd_multisine(lab.rng, 6.0, lab.near(7.0)), steady_current(1.0))


def single_staircase(lab: Lab) -> None:
    lab.staircase(1.0, [2.0, 4.0, 8.0, 4.0, 2.0], steady_current(1.0))


def one_sine(lab: Lab) -> None:
    """The seed paper's kind of test: one frequency, one amplitude, from rest."""
    lab.staircase(1.0, [4.0], steady_current(1.0))


def steady_sines(lab: Lab) -> None:
    """Three frequencies by three amplitudes, the run-in cut off."""
    for frequency in (0.5, 1.5, 4.0):
        for amplitude in (2.0, 4.0, 6.0):
            f, a = lab.near(frequency), lab.near(amplitude)
            motion = steady(f, float(lab.rng.uniform(0, 2 * np.pi)), a, RUN_IN)
            lab.record(f"steady_{f:.2f}Hz_{a:.1f}mm", motion, steady_current(1.0), RUN_IN)


def earthquakes(lab: Lab) -> None:
    for peak in (3.0, 8.0, 5.0, 2.0):
        lab.record("earthquake", earthquake(lab.rng, lab.duration, lab.near(peak)), steady_current(1.0))


def levels(lab: Lab) -> None:
    """Four recordings at each of three constant currents."""
    for value in (0.0, 1.5, 3.0):
        current = steady_current(value)
        lab.staircase(0.8, [2.0, 5.0, 8.0, 4.0], current)
        lab.staircase(3.5, [1.5, 3.0, 0.0, 2.0], current)
        lab.record("multisine", odd_multisine(lab.rng, 6.0, lab.near(6.0)), current)
        lab.record("earthquake", earthquake(lab.rng, lab.duration, lab.near(8.0)), current)


def twelve(lab: Lab) -> None:
    """The seed paper's campaign: 1 Hz at 2, 4 and 8 mm, at 0, 1, 2 and 3 A."""
    for value in (0.0, 1.0, 2.0, 3.0):
        for amplitude in (2.0, 4.0, 8.0):
            motion = staircase(1.0, 0.0, [amplitude], lab.duration)
            lab.record(f"sine_1Hz_{amplitude:g}mm_{value:g}A", motion, steady_current(value))


def field(lab: Lab) -> None:
    """A current that steps, ramps up and down and swings, under sines and random motions."""
    d = lab.duration
    lab.staircase(1.5, [4.0, 6.0, 3.0], current_staircase([0.0, 1.0, 3.0, 0.5, 2.0, 0.0], d))
    lab.staircase(2.5, [3.0, 4.0, 3.0], current_ramps([0.0, 3.0, 0.0, 2.0, 0.0], d))
    lab.record("multisine", odd_multisine(lab.rng, 6.0, lab.near(6.0)), current_sine(1.5, 1.5, lab.near(0.4)))
    stairs = current_staircase([0.5, 1.5, 2.5, 3.0, 2.0, 1.0, 0.0], d)
    lab.record("earthquake", earthquake(lab.rng, d, lab.near(8.0)), stairs)
    lab.staircase(0.9, [3.0, 7.0, 4.0], current_sine(1.2, 1.2, lab.near(1.1)))
    fast = current_staircase([0.0, 2.0, 0.0, 3.0, 1.0, 3.0, 0.0, 1.0, 2.0, 0.0], d)
    lab.staircase(3.5, [2.0, 3.0, 2.0], fast)
    lab.record(
        "multisine", odd_multisine(lab.rng, 6.0, lab.near(5.0)), current_ramps([3.0, 0.0, 1.5, 0.5, 3.0], d)
    )


PROGRAMMES: dict[str, Callable[[Lab], None]] = {
    "rich": rich,
    "offset": offset,
    "single": single,
    "single_staircase": single_staircase,
    "one_sine": one_sine,
    "steady": steady_sines,
    "earthquakes": earthquakes,
    "levels": levels,
    "twelve": twelve,
    "field": field,
}


def campaign_of(name: str, rng: np.random.Generator, rates: Rates, samples: int | None) -> list[Excitation]:
    """The excitations of a programme; `samples` in all stretches or shortens the 12 s of each recording."""
    if name not in PROGRAMMES:
        raise ValueError(f"excitation is {name!r}, wanted one of {', '.join(PROGRAMMES)}")
    duration = 12.0
    if samples is not None:
        trial = Lab(np.random.default_rng(0), rates, duration)
        PROGRAMMES[name](trial)
        duration *= samples / sum(one.samples for one in trial.made)
    lab = Lab(rng, rates, duration)
    PROGRAMMES[name](lab)
    return lab.made
