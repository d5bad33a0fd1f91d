"""Ask and tell: the swarms for people with their own simulator or scheduler."""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .minimise import Bounds, draw_seed, in_box, read_box
from .swarms import defaults


class AskTell:
    """A swarm that asks for costs and is told them.

    Parameters
    ----------
    algorithm : {"mafsa", "afsa", "pso"}
        Which swarm.
    bounds : mapping or sequence of (lower, upper)
        The box.
    seed : int, optional
        Drawn and reported where not given.
    **settings
        Settings of the swarm, as keywords of `mafsa`, `afsa` or `pso`; and `x0`.

    Examples
    --------
    >>> opt = AskTell("pso", [(-1, 1), (-1, 1)], seed=1, max_iterations=50)
    >>> while not opt.finished:
    ...     points = opt.ask()
    ...     opt.tell((points**2).sum(axis=1))
    >>> opt.best[1] < 1e-3
    True
    """

    def __init__(self, algorithm: str, bounds: Bounds, *, seed: int | None = None, **settings: Any) -> None:
        known, start = defaults(algorithm), settings.pop("x0", None)
        if unknown := sorted(set(settings) - set(known)):
            raise TypeError(f"{algorithm} got an unexpected keyword argument '{unknown[0]}'")
        self.seed = draw_seed(seed)
        self._swarm = in_box(algorithm, read_box(bounds), self.seed, known | settings, start)

    def ask(self) -> NDArray[np.float64]:
        """Parameters whose costs are wanted, shape (n, d); n differs from generation to generation."""
        return self._swarm.ask()

    def tell(self, costs: ArrayLike) -> None:
        """Tell the costs of all points asked for, shape (n,); NaN counts as infinite."""
        self._swarm.tell(costs)

    @property
    def finished(self) -> bool:
        """True after the last iteration."""
        return self._swarm.finished

    @property
    def best(self) -> tuple[NDArray[np.float64], float]:
        """Best parameters so far, shape (d,), and their cost."""
        return self._swarm.best
