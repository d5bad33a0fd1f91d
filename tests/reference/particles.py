"""Plain twin of the particle swarm that the paper's section 4 compares with."""

from dataclasses import dataclass

import numpy as np

from .fish import Array, Board, Cost, History, Stream


@dataclass(frozen=True)
class ParticleSettings:
    """Settings under the names of the compiled swarm."""

    n_particles: int = 8
    max_iterations: int = 20
    inertia_start: float = 0.9
    inertia_end: float = 0.4
    cognitive: float = 2.0
    social: float = 2.0
    speed: float = 0.2


class ParticleSwarm:
    """Global-best particle swarm in the unit box, all particles moved at once."""

    def __init__(
        self,
        cost: Cost,
        settings: ParticleSettings,
        seed: int,
        lower: Array,
        upper: Array,
        start: Array | None = None,
    ) -> None:
        self.s = settings
        self.board = Board(cost, lower, upper)
        self.d = len(lower)
        self.start = start
        self.streams = [Stream(seed, k) for k in range(settings.n_particles)]
        self.history = History([])
        # How often a coordinate was held at the wall, and a velocity at its limit: tests want both seen.
        self.walls = 0
        self.limits = 0

    def run(self) -> None:
        s = self.s
        x = np.empty((s.n_particles, self.d))
        v = np.empty_like(x)
        for i, stream in enumerate(self.streams):
            x[i] = stream.draw(self.d)
            v[i] = s.speed * (2.0 * stream.draw(self.d) - 1.0)
        if self.start is not None:
            x[0] = (self.start - self.board.lower) / (self.board.upper - self.board.lower)
        h = self.board.evaluate(x)
        own_x, own_h = x.copy(), h.copy()
        self.history.add(self.board, h, s.inertia_start, s.speed)

        for t in range(1, s.max_iterations + 1):
            w = self.inertia(t)
            best = self.board.x
            assert best is not None
            for i, stream in enumerate(self.streams):
                for k in range(self.d):
                    u1, u2 = stream.draw(2)
                    own = s.cognitive * u1 * (own_x[i, k] - x[i, k])
                    free = w * v[i, k] + own + s.social * u2 * (best[k] - x[i, k])
                    v[i, k] = min(max(free, -s.speed), s.speed)
                    self.limits += bool(v[i, k] != free)
                    moved = x[i, k] + v[i, k]
                    x[i, k] = min(max(moved, 0.0), 1.0)
                    if x[i, k] != moved:
                        v[i, k] = 0.0
                        self.walls += 1
            h = self.board.evaluate(x)
            better = h < own_h
            own_x[better], own_h[better] = x[better], h[better]
            self.history.add(self.board, h, w, s.speed)

    def inertia(self, t: int) -> float:
        s = self.s
        if s.max_iterations == 1:
            return s.inertia_start
        share = (t - 1) / (s.max_iterations - 1)
        return s.inertia_start + (s.inertia_end - s.inertia_start) * share
