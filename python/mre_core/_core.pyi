from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, Self, final

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = [
    "MreError",
    "Problem",
    "Recording",
    "Swarm",
    "__version__",
    "catalogue",
    "certify",
    "check",
    "check_certifiable",
    "check_effect",
    "classical",
    "diagnose_recordings",
    "effect_parameters",
    "exact_is_quick",
    "excitation",
    "fit_bootstrap",
    "fit_exact",
    "fit_hybrid",
    "fit_profile",
    "fit_uncertainty",
    "inertia_weight",
    "models",
    "noise_products",
    "parameters",
    "simulate",
    "uniforms",
    "with_slopes",
]

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
    def evenly_sampled(self) -> bool: ...
    @property
    def scored(self) -> tuple[int, int]: ...
    def __len__(self) -> int: ...
    def cut(self, start: float | None = None, stop: float | None = None) -> Recording: ...
    def exclude(self, *names: str) -> Recording: ...
    def after(self, earlier: Sequence[Recording]) -> Recording: ...
    def at_current(self, current: ArrayLike) -> Recording: ...
    @property
    def past(self) -> dict[str, float] | None: ...

@final
class Problem:
    def __new__(
        cls,
        recordings: Recording | Sequence[Recording],
        model: str = "sinh",
        bounds: Mapping[str, ArrayLike] | None = None,
        *,
        weights: str | ArrayLike | None = None,
    ) -> Self: ...
    def __getnewargs_ex__(self) -> tuple[tuple[Any, ...], dict[str, Any]]: ...
    @staticmethod
    def streamed(
        chunks: Iterable[Recording | tuple[ArrayLike, ArrayLike, ArrayLike]],
        largest_displacement: float,
        bounds: Mapping[str, ArrayLike] | None = None,
        *,
        threads: int | None = None,
    ) -> Problem: ...
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
    def run_problem(self, problem: Problem, **options: Any) -> str: ...
    def run_function(self, function: Callable[[NDArray[np.float64]], ArrayLike], **options: Any) -> str: ...

def exact_is_quick(problem: Problem) -> bool: ...
def fit_exact(
    problem: Problem, *, threads: int | None = None, on_interrupt: str = "raise"
) -> tuple[NDArray[np.float64], float, int, str, dict[str, NDArray[Any]]]: ...
def fit_hybrid(
    problem: Problem,
    settings: dict[str, Any],
    seed: int,
    *,
    start: ArrayLike | None = None,
    **options: Any,
) -> tuple[NDArray[np.float64], float, int, str, dict[str, NDArray[Any]]]: ...
def check_certifiable(problem: Problem) -> None: ...
def certify(
    problem: Problem, x: ArrayLike, tolerance: float, *, threads: int | None = None
) -> tuple[float, float, bool, int]: ...
def fit_uncertainty(problem: Problem, x: ArrayLike, level: float = 0.95) -> dict[str, Any]: ...
def noise_products(
    tangents: list[NDArray[np.float64]], residual: NDArray[np.float64], rate: float
) -> tuple[NDArray[np.float64], float]: ...
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
def with_slopes(recordings: Sequence[Recording], *, threads: int | None = None) -> list[Recording | None]: ...
def models() -> list[str]: ...
def parameters(model: str) -> list[tuple[str, str]]: ...
def check(model: str, levels: Sequence[tuple[float | None, Sequence[float]]]) -> None: ...
def simulate(
    model: str,
    levels: Sequence[tuple[float | None, Sequence[float]]],
    recording: Recording,
    effects: Sequence[tuple[str, str, Sequence[float], Sequence[float]]] = ...,
    sizes: Mapping[str, Any] | None = None,
    over: str = "current",
) -> NDArray[np.float64]: ...
def catalogue() -> list[dict[str, Any]]: ...
def effect_parameters(id: str, law: str) -> tuple[list[tuple[str, str]], list[tuple[str, str]], bool]: ...
def check_effect(id: str, law: str, coefficients: Sequence[float], shapes: Sequence[float]) -> None: ...
def diagnose_recordings(
    recordings: Sequence[Recording],
    model: str,
    groups: Sequence[Sequence[int]],
    *,
    false_alarm: float,
    seed: int,
    held: Sequence[tuple[float | None, Sequence[float]]] | None = None,
    over: str = "current",
    held_effects: Sequence[tuple[str, str, Sequence[float], Sequence[float]]] = ...,
    sizes: Mapping[str, Any] | None = None,
    given: Sequence[ArrayLike] | None = None,
    base_effects: Sequence[tuple[str, str, Sequence[float]]] = ...,
    without: Sequence[str] = ...,
    limits: Mapping[str, float] = ...,
    limit_current: tuple[float, float] | None = None,
    blank: int = 0,
    threads: int | None = None,
    on_stage: Callable[[str], Any] | None = None,
    on_interrupt: str = "raise",
) -> tuple[str, list[NDArray[np.float64]], list[NDArray[np.float64]]]: ...
def excitation(
    kind: str,
    *,
    stroke: float,
    speed: float,
    highest: float,
    duration: float,
    rate: float,
    current: tuple[float, float] | None = None,
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64] | None]: ...
def classical(
    kx: float, kw: float, rho: float, sigma: float, n: float
) -> tuple[float, float | None, float, float, float]: ...
def uniforms(seed: int, stream: int, count: int) -> NDArray[np.float64]: ...
def inertia_weight(iteration: int, iterations: int, p: int) -> float: ...
