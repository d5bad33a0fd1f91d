"""Motions that a test rig is given, each at rest at zero before time zero unless it is a steady sine."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import make_interp_spline  # type: ignore[import-untyped]

from .kinematics import TURN, Array, Course, Jet, Motion, constant, rise, sine, waved

SOFT = 0.6
"""Seconds that a change of amplitude takes."""


@dataclass(frozen=True)
class Excitation:
    """One recording to be made; `run_in` seconds before its first sample are simulated and not recorded."""

    name: str
    rate: float
    samples: int
    motion: Motion
    current: Course
    run_in: float = 0.0

    @property
    def duration(self) -> float:
        return self.samples / self.rate


def steady_current(value: float) -> Course:
    return lambda t: np.full_like(t, value)


def steps_between(t: Array, times: Sequence[float], values: Sequence[float], soft: float) -> Jet:
    """A staircase that starts at the first value and goes to the next within `soft` seconds of each time."""
    level = constant(t, values[0])
    for time, old, new in zip(times, values[:-1], values[1:], strict=True):
        level = level + rise(t, time, time + soft).times(new - old)
    return level


def staircase(frequency: float, phase: float, amplitudes: Sequence[float], duration: float) -> Motion:
    """A sine whose amplitude takes the given values one after the other, from zero; zeros are rests."""
    times = np.arange(len(amplitudes)) * (duration / len(amplitudes))

    def motion(t: Array) -> Jet:
        levels = steps_between(t, times.tolist(), [0.0, *amplitudes], SOFT)
        return levels * sine(t, frequency, phase)

    return motion


def steady(frequency: float, phase: float, amplitude: float, run_in: float) -> Motion:
    """A sine that began smoothly `run_in` seconds before time zero."""
    return lambda t: rise(t, -run_in, -run_in + SOFT).times(amplitude) * sine(t, frequency, phase)


def sweep(low: float, high: float, amplitude: float, duration: float) -> Motion:
    """A logarithmic sweep; the amplitude falls with the frequency above 3 Hz."""
    growth = np.log(high / low) / duration

    def motion(t: Array) -> Jet:
        late = np.maximum(t, 0.0)
        frequency = low * np.exp(growth * late)
        phase = TURN * (frequency - low) / growth
        wave = waved(phase, TURN * frequency, TURN * growth * frequency)
        return rise(t, 0.0, 2 * SOFT).times(amplitude) * wave

    return motion


def sum_of_sines(
    frequencies: Array, amplitudes: Array, phases: Array, peak: float, envelope: Motion
) -> Motion:
    """Many sines under one envelope, scaled to a largest displacement in the first minute."""

    def raw(t: Array) -> Jet:
        total = constant(t, 0.0)
        for f, a, p in zip(frequencies.tolist(), amplitudes.tolist(), phases.tolist(), strict=True):
            total = total + sine(t, f, p).times(a)
        return envelope(t) * total

    probe = np.arange(0, 60, 0.01)
    scale = peak / float(np.max(np.abs(raw(probe).x)))
    return lambda t: raw(t).times(scale)


def odd_multisine(rng: np.random.Generator, highest: float, peak: float) -> Motion:
    """Odd harmonics of a quarter hertz with random phases; amplitudes fall with the frequency."""
    frequencies: Array = np.arange(1.0, round(highest / 0.25) + 1, 2) * 0.25
    phases = rng.uniform(0, TURN, len(frequencies))
    return sum_of_sines(frequencies, frequencies**-0.8, phases, peak, lambda t: rise(t, 0.0, 2 * SOFT))


def earthquake(rng: np.random.Generator, duration: float, peak: float) -> Motion:
    """Band-limited random motion that builds up, stays and dies away."""
    frequencies = np.sort(rng.uniform(0.3, 5.0, 40))
    amplitudes = rng.rayleigh(size=40) * frequencies**-1.2

    def envelope(t: Array) -> Jet:
        end = rise(t, 0.55 * duration, 1.05 * duration)
        return rise(t, 0.0, 0.2 * duration) * (constant(t) + end.times(-0.9))

    return sum_of_sines(frequencies, amplitudes, rng.uniform(0, TURN, 40), peak, envelope)


def held(offset: float, frequency: float, amplitude: float, duration: float) -> Motion:
    """A ramp to an offset, a hold, small sines about it, and back."""

    def motion(t: Array) -> Jet:
        times = np.array([0.02, 0.45, 0.75]) * duration
        place = steps_between(t, times.tolist(), [0.0, offset, -0.6 * offset, 0.3 * offset], 2 * SOFT)
        size = steps_between(
            t, (np.array([0.25, 0.45, 0.6]) * duration).tolist(), [0.0, amplitude, 0.0, amplitude], SOFT
        )
        return place + size * sine(t, frequency)

    return motion


def followed(times: Array, displacement: Array) -> Motion:
    """A command signal that the rig follows exactly; at rest before and after it."""
    course = make_interp_spline(times, displacement, 5)
    slope, bend = course.derivative(), course.derivative(2)

    def motion(t: Array) -> Jet:
        inside = (t >= times[0]) & (t <= times[-1])
        near = np.clip(t, times[0], times[-1])
        return Jet(course(near), inside * slope(near), inside * bend(near))

    return motion


def current_staircase(values: Sequence[float], duration: float, soft: float = 0.02) -> Course:
    """Steps of the current as fast as a current controller makes them."""
    times = np.arange(1, len(values)) * (duration / len(values)) + 0.137
    return lambda t: steps_between(t, times.tolist(), values, soft).x


def current_ramps(peaks: Sequence[float], duration: float) -> Course:
    """Straight up and down between the given values."""
    times = np.linspace(0, duration, len(peaks))
    return lambda t: np.interp(t, times, peaks)


def current_sine(mean: float, swing: float, frequency: float) -> Course:
    return lambda t: mean + swing * np.sin(TURN * frequency * np.maximum(t, 0.0))
