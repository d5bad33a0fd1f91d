"""What happens in one recording on the fine time grid."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from .kinematics import Array
from .paths import Path


@dataclass(frozen=True)
class Track:
    """One recording on the fine grid: arrays of one length; `pick` holds the samples of the recording."""

    t: Array
    x: Array
    v: Array
    a: Array
    current: Array
    h: float
    pick: slice
    index: int
    count: int

    @cached_property
    def path(self) -> Path:
        return Path(self.x, self.v, self.h)

    @property
    def run_in(self) -> int:
        """Samples at the recording's own rate before its first."""
        return int(self.pick.start) // int(self.pick.step)

    @cached_property
    def sampled(self) -> Path:
        """What the recording's own rate shows of the motion, run-in included."""
        return self.thinned(self.x, self.v)

    def thinned(self, x: Array, v: Array) -> Path:
        step = int(self.pick.step)
        return Path(x[::step], v[::step], self.h * step)

    def moved(self, x: Array, v: Array) -> "Track":
        """The same recording seen by a device that moves otherwise."""
        return replace(self, x=x, v=v, a=np.gradient(v, self.h))
