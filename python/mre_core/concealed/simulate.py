"""From a motion to the force that the recording shows: the effects in the order of the measuring chain."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .devices import Device
from .excitations import Excitation
from .kinematics import Array
from .law import Added, Altered, Channel, Field, Gap, Law, Scaled, Seen, Series
from .refit import Sampled
from .track import Track

Chain = Sequence[tuple[Law, float]]
"""Laws, each with its size."""


@dataclass(frozen=True)
class Shown:
    """What one recording shows without noise: motion, force and time of the samples."""

    time: Array
    seen: Sampled
    force: Array


def track_of(excitation: Excitation, index: int, count: int, oversample: int, late: float = 0.0) -> Track:
    """The fine grid of a recording, from the start of its run-in; `late` shifts the motion alone."""
    h = 1 / (excitation.rate * oversample)
    before = round(excitation.run_in * excitation.rate) * oversample
    clock = (np.arange(before + (excitation.samples - 1) * oversample + 1, dtype=np.float64) - before) * h
    motion = excitation.motion(clock - late)
    pick = slice(before, None, oversample)
    return Track(clock, motion.x, motion.v, motion.a, excitation.current(clock), h, pick, index, count)


def device_force(track: Track, device: Device, chain: Chain) -> Array:
    """Force of the device alone for a motion of its own."""
    for law, size in chain:
        if isinstance(law, Altered):
            device = law.act(device, size)
    current = track.current
    for law, size in chain:
        if isinstance(law, Field):
            current = law.act(track, size)
    spring = track.x
    for law, size in chain:
        if isinstance(law, Gap):
            spring = law.act(spring, size)
    parts = device.parts(track.path, current, spring)
    extra = np.zeros_like(track.x)
    for law, size in chain:
        if isinstance(law, Added):
            extra = extra + size * law.act(track, parts)
    softened = parts
    for law, size in chain:
        if isinstance(law, Scaled):
            softened = softened.scaled(*law.act(track, parts, size))
    return softened.total + extra


def shown(prescribed: Track, late: Track, device: Device, chain: Chain) -> Shown:
    """One recording without noise: the rig moves as prescribed, the device as `late` has it."""
    track = late
    for law, size in chain:
        if isinstance(law, Series):
            track = law.act(track, lambda moved: device_force(moved, device, chain), size)
    force = device_force(track, device, chain)
    x, v = prescribed.x, prescribed.v
    for law, size in chain:
        if isinstance(law, Channel):
            force = law.act(track, force, size)
        if isinstance(law, Seen):
            x, v = law.act(prescribed, size)
    pick = prescribed.pick
    path = prescribed.sampled if x is prescribed.x else prescribed.thinned(x, v)
    seen = Sampled(path, prescribed.run_in, prescribed.current[pick])
    return Shown(prescribed.t[pick], seen, force[pick])
