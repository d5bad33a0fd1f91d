"""Identified models: their parameters by coil current, their files, and their simulation."""

import json
import os
import warnings
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._core import Recording
from .errors import ExtrapolationWarning, InputError

SCHEMA = "mre-core/model/1"
_LARGEST_FILE = 50_000_000


@dataclass(frozen=True)
class Level:
    """Parameters at one coil current in A; None where the current is not known."""

    current: float | None
    parameters: Mapping[str, float]
    intervals: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    """Intervals of those parameters that the recordings determine."""


@dataclass(frozen=True)
class Model:
    """A model with parameters at one or more coil currents, between which the force is interpolated.

    Examples
    --------
    >>> model = Model("kelvin_voigt", (Level(None, {"c0": 0.3, "k0": 5.0, "F0": 0.0}),))
    >>> model.levels[0].parameters["k0"]
    5.0
    """

    name: str
    levels: tuple[Level, ...]
    tested: Mapping[str, float] = field(default_factory=dict)
    """Largest absolute displacement (``displacement_mm``) and velocity (``velocity_mm_s``) in the
    recordings that the model was identified from."""

    def __post_init__(self) -> None:
        known = [name for name, _ in _core.parameters(self.name)]
        if not self.levels:
            raise InputError("the model has no levels", wanted="at least one level of parameters")
        for level in self.levels:
            if sorted(level.parameters) != sorted(known):
                raise InputError(
                    f"parameters of {self.name} are {', '.join(level.parameters)}", wanted=", ".join(known)
                )
        _core.check(self.name, [(level.current, self.values(level)) for level in self.levels])

    def values(self, level: Level) -> list[float]:
        """Parameters of a level in the order of the equation."""
        return [float(level.parameters[name]) for name, _ in _core.parameters(self.name)]

    def to_dict(self) -> dict[str, Any]:
        """Content of a model file."""
        units = dict(_core.parameters(self.name))
        levels = []
        for level in self.levels:
            row: dict[str, Any] = {
                "current_A": level.current,
                "parameters": {
                    name: {"value": level.parameters[name], "unit": unit} | _ends(level, name)
                    for name, unit in units.items()
                },
            }
            if self.name == "bouc_wen":
                row["classical"] = classical(level.parameters)
            levels.append(row)
        return {
            "schema": SCHEMA,
            "model": self.name,
            "effects": [],
            "levels": levels,
            "tested": dict(self.tested),
        }

    @classmethod
    def from_dict(cls, content: Any, *, file: str | None = None) -> Self:
        """Read the content of a model file.

        Raises
        ------
        InputError
            Something is missing or of the wrong kind.
        """
        try:
            if content["schema"] != SCHEMA:
                raise InputError(f"schema is {content['schema']!r}", file=file, wanted=SCHEMA)
            if content.get("effects"):
                raise InputError("the model has effects", file=file, wanted="a model without effects")
            levels = tuple(
                Level(
                    None if level["current_A"] is None else float(level["current_A"]),
                    {str(name): float(p["value"]) for name, p in level["parameters"].items()},
                    {
                        str(name): (float(p["low"]), float(p["high"]))
                        for name, p in level["parameters"].items()
                        if "low" in p
                    },
                )
                for level in content["levels"]
            )
            tested = {str(name): float(value) for name, value in content.get("tested", {}).items()}
            return cls(str(content["model"]), levels, tested)
        except (KeyError, TypeError, AttributeError) as error:
            raise InputError(f"not a model: {error!r}", file=file, wanted=f"a {SCHEMA} file") from None
        except ValueError as error:
            raise (
                error if file and str(error).startswith(file) else InputError(str(error), file=file)
            ) from None

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Self:
        """Read a model file.

        Raises
        ------
        InputError
            The file is missing, is not JSON, or is not a model.
        """
        file = str(path)
        try:
            if Path(path).stat().st_size > _LARGEST_FILE:
                raise InputError("too large for a model", file=file, wanted=f"at most {_LARGEST_FILE} bytes")
            content = json.loads(Path(path).read_bytes())
        except OSError as error:
            raise InputError(f"cannot be read: {error.strerror}", file=file) from None
        except (ValueError, RecursionError) as error:
            raise InputError(f"is not JSON: {error}", file=file) from None
        return cls.from_dict(content, file=file)


def _ends(level: Level, name: str) -> dict[str, float]:
    return dict(zip(("low", "high"), level.intervals.get(name, ()), strict=False))


def classical(parameters: Mapping[str, float]) -> dict[str, float | None]:
    """Bouc-Wen parameters of eq. 1 and 2, with the redundant A fixed at 1.

    Parameters
    ----------
    parameters : mapping
        Normalised form: kx (N/mm), kw (N), rho (1/mm), sigma, n.

    Returns
    -------
    dict
        k0 (N/mm), alpha (None where k0 is zero), A, beta, gamma (mm^-n), n.
    """
    names = ("kx", "kw", "rho", "sigma", "n")
    k0, alpha, a, beta, gamma = _core.classical(*(parameters[name] for name in names))
    return {"k0": k0, "alpha": alpha, "A": a, "beta": beta, "gamma": gamma, "n": parameters["n"]}


def simulate(model: Model | str | os.PathLike[str], recording: Recording) -> NDArray[np.float64]:
    """Restoring force of a model over a recording, whose own force is not looked at.

    Parameters
    ----------
    model : Model or path
        The model, or its file.
    recording : Recording
        n samples of displacement and velocity, and the current where the model has several levels.

    Returns
    -------
    ndarray, shape (n,)
        Force in N. Hysteretic variables start at rest.

    Raises
    ------
    MreError
        The current is missing, or the samples are too far apart for the parameters.

    Warns
    -----
    ExtrapolationWarning
        The recording leaves the tested displacement, velocity or current.
    """
    if not isinstance(model, Model):
        model = Model.load(model)
    for message in _outside(model, recording):
        warnings.warn(message, ExtrapolationWarning, stacklevel=2)
    levels = [(level.current, model.values(level)) for level in model.levels]
    return _core.simulate(model.name, levels, recording)


def _outside(model: Model, recording: Recording) -> list[str]:
    """One sentence for every tested range that a recording leaves by more than 1 %."""
    found = []
    series = {"displacement_mm": recording.displacement, "velocity_mm_s": recording.velocity}
    for key, values in series.items():
        largest, tested = float(np.abs(values).max()), model.tested.get(key)
        if tested is not None and largest > 1.01 * tested:
            what, _, unit = key.partition("_")
            unit = unit.replace("_", "/")
            found.append(f"{what} goes to {largest:.4g} {unit}, tested up to {tested:.4g} {unit}")
    known = [level.current for level in model.levels if level.current is not None]
    if known and recording.current is not None:
        current = np.asarray(recording.current)
        low, high = float(current.min()), float(current.max())
        margin = 0.02 + 0.02 * max(abs(value) for value in known)
        if low < min(known) - margin or high > max(known) + margin:
            span = f"goes from {low:.4g} A to {high:.4g} A" if low < high else f"is {low:.4g} A"
            found.append(
                f"current {span}, tested from {min(known):.4g} A to"
                f" {max(known):.4g} A: the force of the nearest tested current is taken"
            )
    name = f"recording '{recording.name}': " if recording.name else ""
    return [name + sentence for sentence in found]
