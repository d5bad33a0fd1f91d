from collections.abc import Callable, Mapping, Sequence
from typing import Any, Self, final

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str

class MreError(ValueError): ...

@final
class Recording:
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
    def current_level(self) -> float | None: ...
    @property
    def current_varies(self) -> bool: ...
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
    def __new__(
        cls,
        recordings: Recording | Sequence[Recording],
        model: str = "sinh",
        bounds: Mapping[str, tuple[float, float]] | None = None,
        *,
        weights: str | ArrayLike | None = None,
    ) -> Self: ...
    @property
    def model(self) -> str: ...
    @property
    def recordings(self) -> list[Recording]: ...
    @property
    def names(self) -> list[str]: ...
    @property
    def units(self) -> list[str]: ...
    @property
    def limits(self) -> list[tuple[float, float]]: ...
    @property
    def lower(self) -> NDArray[np.float64]: ...
    @property
    def upper(self) -> NDArray[np.float64]: ...
    def fitness(self, x: ArrayLike, *, threads: int | None = None) -> Any: ...
    def levels(
        self, x: ArrayLike, current: float | None = None
    ) -> list[tuple[float | None, list[float]]]: ...
    def on_bound(self, x: ArrayLike) -> list[int]: ...

@final
class Swarm:
    def __new__(
        cls,
        kind: str,
        settings: dict[str, Any],
        seed: int,
        *,
        problem: Problem | None = None,
        lower: ArrayLike | None = None,
        upper: ArrayLike | None = None,
        names: list[str] | None = None,
        start: ArrayLike | None = None,
    ) -> Self: ...
    def ask(self) -> NDArray[np.float64]: ...
    def tell(self, costs: ArrayLike) -> None: ...
    @property
    def finished(self) -> bool: ...
    @property
    def best(self) -> tuple[NDArray[np.float64], float]: ...
    @property
    def evaluations(self) -> tuple[int, int]: ...
    @property
    def history(self) -> dict[str, NDArray[Any]]: ...
    @property
    def behaviours(self) -> dict[str, int]: ...
    def run_problem(
        self,
        problem: Problem,
        *,
        max_evaluations: int | None = None,
        time_limit: float | None = None,
        target: float | None = None,
        threads: int | None = None,
        callback: Callable[[int, int, float], Any] | None = None,
        on_interrupt: str = "raise",
    ) -> str: ...
    def run_function(
        self,
        function: Callable[[NDArray[np.float64]], ArrayLike],
        *,
        max_evaluations: int | None = None,
        time_limit: float | None = None,
        target: float | None = None,
        callback: Callable[[int, int, float], Any] | None = None,
        on_interrupt: str = "raise",
    ) -> str: ...

def fit_exact(
    problem: Problem, *, threads: int | None = None, on_interrupt: str = "raise"
) -> tuple[NDArray[np.float64], float, int, str, dict[str, NDArray[Any]]]: ...
def fit_hybrid(
    problem: Problem,
    settings: dict[str, Any],
    seed: int,
    *,
    start: ArrayLike | None = None,
    max_evaluations: int | None = None,
    time_limit: float | None = None,
    target: float | None = None,
    threads: int | None = None,
    callback: Callable[[int, int, float], Any] | None = None,
    on_interrupt: str = "raise",
) -> tuple[NDArray[np.float64], float, int, str, dict[str, NDArray[Any]]]: ...
def fit_uncertainty(problem: Problem, x: ArrayLike, level: float = 0.95) -> dict[str, Any]: ...
def fit_profile(
    problem: Problem, x: ArrayLike, level: float = 0.95, *, threads: int | None = None
) -> list[tuple[str, str, float, float | None, float | None, NDArray[np.float64]]]: ...
def fit_bootstrap(
    problem: Problem,
    x: ArrayLike,
    replicates: int,
    seed: int,
    level: float = 0.95,
    *,
    threads: int | None = None,
) -> tuple[list[tuple[str, str]], NDArray[np.float64], list[tuple[float, float]], list[int]]: ...
def models() -> list[str]: ...
def parameters(model: str) -> list[tuple[str, str]]: ...
def check(model: str, levels: Sequence[tuple[float | None, Sequence[float]]]) -> None: ...
def simulate(
    model: str, levels: Sequence[tuple[float | None, Sequence[float]]], recording: Recording
) -> NDArray[np.float64]: ...
def classical(
    kx: float, kw: float, rho: float, sigma: float, n: float
) -> tuple[float, float | None, float, float, float]: ...
def uniforms(seed: int, stream: int, count: int) -> NDArray[np.float64]: ...
def inertia_weight(iteration: int, iterations: int, p: int) -> float: ...
