"""A device on its test bench: what the recordings show of it, with effects of any size."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from .devices import Device
from .excitations import Excitation
from .kinematics import Array
from .law import Added, Late, Law, Rig
from .refit import Refit
from .simulate import Chain, Shown, shown, track_of
from .strength import Solved, solved

FINE = 1600.0
"""Least rate (Hz) of the fine grid."""


def rms(arrays: Sequence[Array]) -> float:
    return float(np.sqrt(sum(float(a @ a) for a in arrays) / sum(len(a) for a in arrays)))


class Bench:
    """A device, its excitations and the fine grid on which it is simulated."""

    def __init__(self, device: Device, excitations: Sequence[Excitation], fine: float = FINE) -> None:
        self.device, self.excitations = device, excitations
        self.steps = [max(2, int(np.ceil(fine / one.rate - 1e-9))) for one in excitations]
        count = len(excitations)
        pairs = enumerate(zip(excitations, self.steps, strict=True))
        self.tracks = [track_of(one, i, count, steps) for i, (one, steps) in pairs]
        self.bare = self.show([])
        self.refit = Refit(device)

    def show(self, chain: Chain) -> list[Shown]:
        """The recordings without noise."""
        late = sum(law.act(size) for law, size in chain if isinstance(law, Late))
        views = []
        for one, steps, track in zip(self.excitations, self.steps, self.tracks, strict=True):
            moved = track_of(one, track.index, track.count, steps, late) if late else track
            views.append(shown(track, moved, self.device, chain))
        return views

    def then(self, excitations: Sequence[Excitation], fine: float = FINE) -> "Bench":
        """The same device later; what differs between recordings is as it was in the last one."""
        later = Bench(self.device, excitations, fine)
        count = len(self.excitations)
        later.tracks = [replace(track, index=count - 1, count=count) for track in later.tracks]
        return later

    def left(self, views: Sequence[Shown]) -> float:
        """What the base model cannot explain (N, rms)."""
        return self.refit.unexplained([v.seen for v in views], [v.force for v in views])

    def rig(self) -> Rig:
        """Extremes of the recordings, of the bare device."""
        seen = [view.seen for view in self.bare]
        x, v = np.concatenate([s.x for s in seen]), np.concatenate([s.v for s in seen])
        force = np.concatenate([view.force for view in self.bare])
        matrix = np.column_stack([x, v, np.ones_like(x)])
        return Rig(
            base=self.device.base,
            stroke=float(np.max(np.abs(x))),
            speed=float(np.max(np.abs(v))),
            force=float(np.max(np.abs(force))),
            stiffness=float(np.linalg.lstsq(matrix, force, rcond=None)[0][0]),
            duration=max(one.duration for one in self.excitations),
            recordings=len(self.bare),
            largest_current=max(float(np.max(view.seen.current)) for view in self.bare),
        )

    def size_for(self, law: Law, wanted: float) -> Solved:
        """The size at which the law alone leaves the wanted mismatch (N, rms)."""
        if not isinstance(law, Added):
            return solved(lambda size: self.left(self.show([(law, size)])), wanted, law.typical, law.largest)
        seen, forces = [v.seen for v in self.bare], [v.force for v in self.bare]
        unit = self.show([(law, 1.0)])
        waves = [one.force - force for one, force in zip(unit, forces, strict=True)]

        if rms(waves) == 0:  # such as a stop that no motion reaches
            return Solved(1.0, self.left(self.bare), False)

        def left(size: float) -> float:
            changed = [force + size * wave for force, wave in zip(forces, waves, strict=True)]
            return self.refit.unexplained(seen, changed)

        return solved(left, wanted, 2 * wanted / rms(waves), rms(forces) / rms(waves))
