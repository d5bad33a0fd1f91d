"""Interface of the Rust core. Units everywhere: millimetre, newton, second, ampere, degree Celsius."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Self, final

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str

class MreError(ValueError): ...

@final
class Recording:
    """One validated recording; immutable."""

    def __new__(
        cls,
        time: ArrayLike,
        displacement: ArrayLike,
        force: ArrayLike | None,
        *,
        velocity: ArrayLike | None = None,
        current: ArrayLike | float | None = None,
        temperature: ArrayLike | float | None = None,
        simulated: ArrayLike | None = None,
        name: str = "",
    ) -> Self: ...
    @property
    def name(self) -> str: ...
    @property
    def time(self) -> NDArray[np.float64]: ...
    @property
    def displacement(self) -> NDArray[np.float64]: ...
    @property
    def velocity(self) -> NDArray[np.float64]: ...
    @property
    def force(self) -> NDArray[np.float64] | None: ...
    @property
    def simulated(self) -> NDArray[np.float64] | None: ...
    @property
    def current(self) -> float | NDArray[np.float64] | None: ...
    @property
    def temperature(self) -> float | NDArray[np.float64] | None: ...
    @property
    def velocity_window(self) -> float | None: ...
    @property
    def sampling_rate(self) -> float: ...
    @property
    def scored(self) -> tuple[int, int]: ...
    def __len__(self) -> int: ...
    def cut(self, start: float | None = None, stop: float | None = None) -> Recording: ...
    def exclude(self, *names: str) -> Recording: ...

@final
class Problem:
    """Fitness of a model's parameters on recordings."""

    def __new__(
        cls,
        recordings: Recording | Sequence[Recording],
        model: str = "sinh",
        bounds: Mapping[str, tuple[float, float]] | None = None,
        *,
        weights: str | Sequence[float] | None = None,
    ) -> Self: ...
    @property
    def model(self) -> str: ...
    @property
    def names(self) -> list[str]: ...
    @property
    def units(self) -> list[str]: ...
    @property
    def lower(self) -> NDArray[np.float64]: ...
    @property
    def upper(self) -> NDArray[np.float64]: ...
    def fitness(self, x: ArrayLike, *, threads: int | None = None) -> NDArray[np.float64]: ...
