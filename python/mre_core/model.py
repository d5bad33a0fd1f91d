"""Identified models: their parameters by coil current, their files, and their simulation."""

import math
import os
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._core import Recording
from .checks import choice
from .current_laws.law import Dependence
from .current_laws.variable import check_over, series_of
from .effects import Effect
from .errors import ExtrapolationWarning, InputError, mapping, shown
from .output import to_json, write_file
from .stored import number, read_json
from .tested import MOTION, beyond_tested

SCHEMA = "mre-core/model/1"
SIMULATED = "simulated"
"""In place of a model's name: the force that a user's own simulation gives for the recording."""
_FINE = 129
"""Levels at which laws are tabulated for a current that changes; between them the force is interpolated."""


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
    effects: tuple[Effect, ...] = ()
    """Effects beside the model's equation, in the order in which they act."""
    sizes: Mapping[str, Any] = field(default_factory=dict)
    """Sizes of the recordings that the effects were fitted to, from which some effects take their scale."""
    laws: Mapping[str, Dependence] = field(default_factory=dict)
    """Every parameter over the current; empty where only the levels are known. The levels are then those
    that were tested."""
    over: str = "current"
    """What the laws run over: in place of the current, ``temperature`` or ``amplitude``."""

    def __post_init__(self) -> None:
        choice(self.name, "model", [*_core.models(), SIMULATED])
        known = list(self.units)
        for name, of in (("levels", "Level"), ("effects", "Effect")):
            if not isinstance(given := getattr(self, name), Sequence):
                raise TypeError(f"{name} are {shown(given)}: wanted a sequence of {of}")
        if not self.levels:
            raise InputError("the model has no levels", wanted="at least one level of parameters")
        for level in self.levels:
            if not isinstance(level, Level):
                raise TypeError(f"levels hold {shown(level)}: wanted a Level")
            if level.current is not None:
                number(level.current, "current of a level")
            if sorted(mapping("parameters", level.parameters, "name to number")) != sorted(known):
                raise InputError(
                    f"parameters of {self.name} are {', '.join(level.parameters)}", wanted=", ".join(known)
                )
            for name, value in level.parameters.items():
                number(value, name)
        for name, largest in mapping("tested", self.tested, "name to number").items():
            number(largest, f"tested {name}", least=0.0 if name in MOTION else -math.inf)
        for effect in self.effects:
            if not isinstance(effect, Effect):
                raise TypeError(f"effects hold {shown(effect)}: wanted an Effect")
        if self.effects and not self.sizes:
            raise InputError(
                "the model has effects and no sizes", wanted="sizes of the recordings behind them"
            )
        if mapping("laws", self.laws, "parameter to law") and sorted(self.laws) != sorted(known):
            raise InputError(f"laws of {self.name} are {', '.join(self.laws)}", wanted=", ".join(known))
        if self.name != SIMULATED:
            _core.check(self.name, self.given())

    @property
    def units(self) -> dict[str, str]:
        """Parameters of the model without its effects and their units, in the order of the equation."""
        return {} if self.name == SIMULATED else dict(_core.parameters(self.name))

    def given(self) -> list[tuple[float | None, list[float]]]:
        """Levels as the core takes them."""
        return [
            (level.current, [float(level.parameters[name]) for name in self.units]) for level in self.levels
        ]

    def given_for(self, recordings: Sequence[Recording]) -> list[tuple[float | None, list[float]]]:
        """Levels as the core takes them for recordings: of laws, at what these run over."""
        if not self.laws:
            return self.given()
        series = [series_of(recording, self.over) for recording in recordings]
        at = np.unique(np.concatenate(series))
        if len(at) > _FINE:
            steady = [values for values in series if len(values) == 1]
            at = np.unique(np.concatenate([*steady, np.linspace(at[0], at[-1], _FINE)]))
        values = np.stack([self.laws[name].at(at) for name in self.units], axis=1)
        return [(float(place), row.tolist()) for place, row in zip(at, values, strict=True)]

    def to_dict(self) -> dict[str, Any]:
        """Content of a model file."""
        levels = []
        for level in self.levels:
            row: dict[str, Any] = {
                "current_A": level.current,
                "parameters": {
                    name: {"value": level.parameters[name], "unit": unit} | _ends(level, name)
                    for name, unit in self.units.items()
                },
            }
            if self.name == "bouc_wen":
                row["classical"] = classical(level.parameters)
            levels.append(row)
        return {
            "schema": SCHEMA,
            "model": self.name,
            "effects": [effect.to_dict() for effect in self.effects],
            "levels": levels,
            "tested": dict(self.tested),
            "sizes": dict(self.sizes),
        } | (
            {"laws": {name: law.to_dict() for name, law in self.laws.items()}, "over": self.over}
            if self.laws
            else {}
        )

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
            levels = tuple(
                Level(
                    level["current_A"],
                    {str(name): number(p["value"], str(name)) for name, p in level["parameters"].items()},
                    {
                        str(name): (number(p["low"], f"low of {name}"), number(p["high"], f"high of {name}"))
                        for name, p in level["parameters"].items()
                        if "low" in p
                    },
                )
                for level in content["levels"]
            )
            tested = {
                str(name): number(value, f"tested {name}")
                for name, value in content.get("tested", {}).items()
            }
            effects = tuple(Effect.from_dict(effect) for effect in content.get("effects", []))
            over = str(content.get("over", "current"))
            check_over(over)
            laws = {str(name): Dependence.from_dict(law) for name, law in content.get("laws", {}).items()}
            return cls(
                str(content["model"]), levels, tested, effects, dict(content.get("sizes", {})), laws, over
            )
        except (LookupError, TypeError, AttributeError) as error:
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
        return cls.from_dict(read_json(path), file=str(path))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write a model file, which `load` and every command reads.

        Raises
        ------
        InputError
            The file cannot be written.
        """
        content = to_json(self.to_dict())

        def write(place: Path) -> None:
            place.write_text(content, encoding="utf-8")

        write_file(path, write)


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
    """Restoring force of a model with its effects over a recording, whose own force is not looked at.

    It is the device's force: without drift, interference and clipping of the measurement.

    Parameters
    ----------
    model : Model or path
        The model, or its file.
    recording : Recording
        n samples of displacement and velocity, and the current where the model has several levels. Of a
        rested and virgin specimen, or of one that has been through others: `recording.after(others)`.

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
    if not isinstance(recording, Recording):
        raise TypeError(f"recording is {shown(recording)}: wanted a Recording")
    if not isinstance(model, Model):
        model = Model.load(model)
    for message in beyond_tested(model, recording):
        warnings.warn(message, ExtrapolationWarning, stacklevel=2)
    if model.name == SIMULATED and recording.simulated is None:
        raise InputError(
            f"recording '{recording.name}' has no simulated force", wanted="a column simulated_force_N"
        )
    effects = [effect.given() for effect in model.effects]
    levels = model.given_for([recording])
    return _core.simulate(model.name, levels, recording, effects, model.sizes or None, model.over)
