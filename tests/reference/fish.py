"""Plain twin of the modified artificial fish swarm, after sections 3.1 to 3.3 of the seed paper.

Written to be read next to the paper, not to be fast: X are positions in the unit box, H costs, Y food.
"""

import math
from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass

import numpy as np
from mre_core._core import uniforms
from numpy.typing import NDArray

Array = NDArray[np.float64]
Cost = Callable[[Array], Array]
Place = tuple[Array, float]
# What a fish does in one iteration: it yields the rows it wants to know, is sent their costs, and ends
# with its new place. This keeps each behaviour in one piece although the swarm is evaluated in batches.
Act = Generator[Array, Array, Place]


@dataclass(frozen=True)
class FishSettings:
    """Settings under the names of the compiled swarm."""

    n_fish: int = 8
    max_iterations: int = 20
    try_number: int = 4
    delta: float = 0.6
    visual: float = 0.4
    step: float = 0.2
    visual_min: float = 0.002
    step_min: float = 0.0003
    p: int = 5
    schedule: str = "start"
    neighbourhood: str = "swarm"
    crowd: str = "literal"
    search: str = "best"


class Stream:
    """The random numbers of one individual, in order."""

    def __init__(self, seed: int, number: int) -> None:
        self.seed = seed
        self.number = number
        self.used = 0
        self.known = np.empty(0)

    def draw(self, count: int) -> Array:
        end = self.used + count
        if end > len(self.known):
            self.known = uniforms(self.seed, self.number, 2 * end)
        drawn = self.known[self.used : end]
        self.used = end
        return drawn


class Board:
    """The box, what was evaluated in it, batch by batch, and the bulletin of 3.1.5 (first of equals)."""

    def __init__(self, cost: Cost, lower: Array, upper: Array) -> None:
        self.cost = cost
        self.lower = lower
        self.upper = upper
        self.batches: list[Array] = []
        self.costs: list[Array] = []
        self.failures = 0
        self.x: Array | None = None
        self.h = np.inf

    def evaluate(self, rows: Array) -> Array:
        physical = self.lower + rows * (self.upper - self.lower)
        told = self.cost(physical)
        h = np.where(np.isfinite(told), told, np.inf)
        self.batches.append(physical)
        self.costs.append(told)
        self.failures += int(np.count_nonzero(np.isinf(h)))
        k = int(np.argmin(h))
        if self.x is None or h[k] < self.h:
            self.x, self.h = rows[k].copy(), float(h[k])
        return h

    @property
    def evaluations(self) -> int:
        return sum(len(rows) for rows in self.batches)

    @property
    def best(self) -> Array:
        assert self.x is not None
        return self.lower + self.x * (self.upper - self.lower)


@dataclass
class History:
    """One row an iteration, the initial swarm first."""

    rows: list[tuple[float, float, float, float, float]]

    def add(self, board: Board, h: Array, scope: float, step: float) -> None:
        finite = h[np.isfinite(h)]
        mean = float(finite.mean()) if len(finite) else np.inf
        self.rows.append((board.h, mean, float(board.evaluations), scope, step))

    def column(self, name: str) -> Array:
        k = ("best", "mean", "evaluations", "range", "step").index(name)
        return np.array([row[k] for row in self.rows])


def inertia_weight(iteration: int, iterations: int, p: int) -> float:
    """Eq. 8, first part."""
    return float(np.exp(-20.0 * (iteration / iterations) ** p))


def food(h: Array) -> Array:
    """Y = f(X), high where the cost is low: the paper maximises Y and minimises H."""
    return np.array([1.0 / (1.0 + x) if x >= 0.0 else 1.0 - x for x in h.tolist()])


def distance(a: Array, b: Array) -> float:
    """d_ij of 3.1, summed in order: a step along a very short distance magnifies its rounding."""
    return math.sqrt(sum(float(q) for q in (a - b) ** 2))


def clamp(x: Array) -> Array:
    return np.minimum(np.maximum(x, 0.0), 1.0)


class FishSwarm:
    """The swarm of 3.3; `streams` says which stream each fish draws from (its own number by default)."""

    def __init__(
        self,
        cost: Cost,
        settings: FishSettings,
        seed: int,
        lower: Array,
        upper: Array,
        start: Array | None = None,
        streams: Sequence[int] | None = None,
    ) -> None:
        self.s = settings
        self.board = Board(cost, lower, upper)
        self.d = len(lower)
        self.start = start
        self.streams = [Stream(seed, k) for k in streams or range(settings.n_fish)]
        self.history = History([])
        self.behaviours = {"search": 0, "swarm": 0, "follow": 0, "random": 0}
        # How often a fish already stood at its target: tests want to have seen it.
        self.met = 0

    def run(self) -> None:
        s = self.s
        # Step 2. The first fish draws even where it is told its place, so the others do not depend on it.
        self.X = np.array([stream.draw(self.d) for stream in self.streams])
        if self.start is not None:
            self.X[0] = (self.start - self.board.lower) / (self.board.upper - self.board.lower)
        # Step 3.
        self.H = self.board.evaluate(self.X)
        self.visual, self.step = s.visual, s.step
        self.history.add(self.board, self.H, self.visual, self.step)
        for iteration in range(1, s.max_iterations + 1):
            self.update_parameters(iteration)
            self.behave()
            self.history.add(self.board, self.H, self.visual, self.step)

    def update_parameters(self, iteration: int) -> None:
        """Step 4, eq. 8; "recursive" takes visual and step on the right for the present ones."""
        s = self.s
        if s.schedule == "constant":
            return
        w = inertia_weight(iteration, s.max_iterations, s.p)
        visual, step = (s.visual, s.step) if s.schedule == "start" else (self.visual, self.step)
        self.visual = visual * w + s.visual_min
        self.step = step * w + s.step_min

    def behave(self) -> None:
        """Step 5: all fish act on the swarm as it stood at the beginning of the iteration."""
        n = len(self.X)
        self.Y = food(self.H)
        # Eq. 7, summed one by one: a pairwise sum could call a fish of a uniform swarm hungry.
        self.phi = sum(self.Y.tolist()) / n
        self.dist = np.array([[distance(a, b) for b in self.X] for a in self.X])
        self.estimate_centres()

        acts = [self.act(i) for i in range(n)]
        wants = {i: next(acts[i]) for i in range(n)}
        X, H = self.X.copy(), self.H.copy()
        while wants:
            h = self.board.evaluate(np.concatenate(list(wants.values())))
            later: dict[int, Array] = {}
            first = 0
            for i, rows in wants.items():
                mine = h[first : first + len(rows)]
                first += len(rows)
                try:
                    later[i] = acts[i].send(mine)
                except StopIteration as end:
                    X[i], H[i] = end.value
            wants = later
        self.X, self.H = X, H

    def fellows(self, i: int) -> list[int]:
        """The others within visual of fish i."""
        return [j for j in range(len(self.X)) if j != i and self.dist[i, j] < self.visual]

    def estimate_centres(self) -> None:
        """Centres and their food for the fish that want to swarm (3.1.2, or 3.2.2 for the whole swarm)."""
        self.centre: dict[int, tuple[Array, float]] = {}
        wanting = [i for i in range(len(self.X)) if self.Y[i] > self.phi]
        if self.s.neighbourhood == "swarm":
            if wanting:
                xc = self.X.mean(axis=0)
                yc = float(food(self.board.evaluate(xc[None, :]))[0])
                self.centre = dict.fromkeys(wanting, (xc, yc))
            return
        rows = {i: self.X[self.fellows(i)].mean(axis=0) for i in wanting if self.fellows(i)}
        if rows:
            yc_all = food(self.board.evaluate(np.array(list(rows.values()))))
            self.centre = {i: (rows[i], float(y)) for i, y in zip(rows, yc_all, strict=True)}

    def roomy(self, i: int, y_target: float) -> bool:
        """The lost condition of 3.1.2 and 3.1.3: enough food at the target, and not too crowded."""
        s = self.s
        if s.crowd == "none":
            return bool(y_target > self.Y[i])
        whole = s.crowd == "literal" and s.neighbourhood == "swarm"
        nf = len(self.X) - 1 if whole else len(self.fellows(i))
        return nf >= 1 and bool(y_target / nf > s.delta * self.Y[i])

    def act(self, i: int) -> Act:
        """3.1.4: a hungry fish follows, a fed one swarms."""
        if self.Y[i] < self.phi:
            return (yield from self.follow(i))
        if self.Y[i] > self.phi:
            return (yield from self.swarm(i))
        return (yield from self.search(i))

    def swarm(self, i: int) -> Act:
        """3.1.2."""
        if i in self.centre:
            xc, yc = self.centre[i]
            if self.roomy(i, yc):
                self.behaviours["swarm"] += 1
                return (yield from self.arrive(self.towards(i, xc)))
        return (yield from self.search(i))

    def follow(self, i: int) -> Act:
        """3.1.3."""
        whole = self.s.neighbourhood == "swarm"
        seen = [j for j in range(len(self.X)) if j != i] if whole else self.fellows(i)
        if seen:
            best = min(seen, key=lambda j: (self.H[j], j))
            if self.roomy(i, float(self.Y[best])):
                self.behaviours["follow"] += 1
                return (yield from self.arrive(self.towards(i, self.X[best])))
        return (yield from self.search(i))

    def search(self, i: int) -> Act:
        """3.1.1, or with "best" the modification of 3.2.2: straight to the best place in sight."""
        tries = self.s.try_number
        if self.s.search == "best":
            looks = np.array([self.about(i, self.visual) for _ in range(tries)])
            h = yield looks
            k = int(np.argmin(h))
            if h[k] < self.H[i]:
                self.behaviours["search"] += 1
                return looks[k], float(h[k])
        else:
            for _ in range(tries):
                look = self.about(i, self.visual)
                h = yield look[None, :]
                if h[0] < self.H[i]:
                    self.behaviours["search"] += 1
                    return (yield from self.arrive(self.towards(i, look)))
        self.behaviours["random"] += 1
        return (yield from self.arrive(self.about(i, self.step)))

    def about(self, i: int, scope: float) -> Array:
        u = self.streams[i].draw(self.d)
        return clamp(self.X[i] + scope * (2.0 * u - 1.0))

    def towards(self, i: int, target: Array) -> Array:
        x: Array = self.X[i]
        dist = distance(target, x)
        if dist == 0.0:
            self.met += 1
            return x.copy()
        u = float(self.streams[i].draw(1)[0])
        return clamp(x + u * self.step / dist * (target - x))

    @staticmethod
    def arrive(x: Array) -> Act:
        h = yield x[None, :]
        return x, float(h[0])
