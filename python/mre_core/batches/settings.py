"""What every item of a batch is treated with, and the hash that names it."""

import hashlib
import json
import os
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from functools import cached_property
from inspect import signature
from pathlib import Path
from typing import Any, Literal, Self

import numpy as np

from .._core import Recording, models, parameters
from ..checks import choice, flag, whole
from ..columns import check_map
from ..conditions import check_pattern, read_conditions
from ..diagnose import check_false_alarm
from ..errors import InputError, SkippedWarning, mapping, shown
from ..files import ReadOptions
from ..files.table import NoTableError
from ..fits import hybrid
from ..identify import OPTIMIZERS, SWARMS, identify
from ..load import load_all
from ..minimise import RunOptions
from ..model import SIMULATED, Model
from ..stored import number
from ..uncertainty import MOST_REPLICATES

_VARYING = {"callback", "on_interrupt", "threads", "time_limit", "x0", "seed", "run", "problem_or_function"}
"""Keywords of an optimiser that belong to one run, or make results depend on the machine's speed."""


@dataclass(frozen=True)
class Reading:
    """How files become recordings: keywords of `load_all`, then what is cut and excluded."""

    map: Mapping[str, str] = field(default_factory=dict)
    conditions: Mapping[str, float | str] = field(default_factory=dict)
    name_pattern: str | None = None
    cut: tuple[float | None, float | None] | None = None
    """Start and stop in s."""
    exclude: tuple[str, ...] = ()
    read: Mapping[str, object] = field(default_factory=dict)

    def check(self, short: Recording) -> None:
        """See that they can be used at all, on a recording of a few samples.

        Raises
        ------
        InputError, TypeError
            One of them cannot.
        """
        check_map(self.map)
        read_conditions(self.conditions)
        if self.name_pattern is not None:
            check_pattern(self.name_pattern)
        ReadOptions.of(self.read)
        if self.cut is not None:
            if not isinstance(self.cut, tuple | list) or len(self.cut) != 2:
                raise InputError(f"cut is {shown(self.cut)}", wanted="a pair (start, stop) in s")
            for end in self.cut:
                if end is not None:
                    number(end, "cut")
        short.exclude(*self.exclude)

    def load(self, files: Sequence[Path]) -> list[Recording]:
        """Read all recordings of an item; of several files those that hold no table are passed over."""
        found: list[Recording] = []
        for file in files:
            try:
                found += self._of_file(file)
            except NoTableError as error:
                if file == files[-1] and not found:
                    raise
                warnings.warn(f"passed over: {error}", SkippedWarning, stacklevel=2)
        return found

    def _of_file(self, file: Path) -> list[Recording]:
        conditions: dict[str, Any] = dict(self.conditions)
        found = load_all(
            file, map=self.map, name_pattern=self.name_pattern, read=self.read or None, **conditions
        )
        if self.cut is not None:
            found = [recording.cut(*self.cut) for recording in found]
        return [recording.exclude(*self.exclude) for recording in found] if self.exclude else found


@dataclass(frozen=True)
class Settings:
    """Everything beside the recordings, the seed and the version that a result depends on."""

    job: Literal["identify", "diagnose"]
    model: str
    """Name of the model or the base; of a model file, the name of its equation."""
    start: Mapping[str, Any] | None
    """Content of the model file, where there is one."""
    reading: Reading
    options: Mapping[str, Any]
    """Further keywords of `identify` or `diagnose`."""
    bootstrap: int | None = None

    @classmethod
    def of(
        cls,
        model: str | os.PathLike[str] | None,
        base: str | os.PathLike[str] | None,
        reading: Reading,
        options: Mapping[str, Any],
        bootstrap: int | None,
    ) -> Self:
        """Check what can be checked before any recording is read.

        Raises
        ------
        InputError
            Not exactly one of model and base, or neither a known name nor a model file.
        """
        if (model is None) == (base is None):
            given = "both a model and a base are" if model is not None else "neither a model nor a base is"
            raise InputError(f"{given} given", wanted="a model to identify, or a base to diagnose")
        if bootstrap is not None and base is not None:
            raise InputError("a bootstrap of a diagnosis", wanted="a bootstrap with a model")
        name = _name(model if model is not None else base)
        start = None
        known = [*models(), *([SIMULATED] if base is not None else [])]
        if name.endswith(".json"):
            start = Model.load(name).to_dict()
            name = str(start["model"])
        elif name not in known:
            what = "model" if model is not None else "base"
            raise InputError(f"the {what} is {shown(name)}", wanted=f"{', '.join(known)}, or a model.json")
        job: Literal["identify", "diagnose"] = "identify" if model is not None else "diagnose"
        given_options = {key: plain(value, key) for key, value in options.items() if value is not None}
        known_options = _known_options(job, given_options.get("optimizer", "hybrid"))
        if surplus := sorted(set(given_options) - known_options):
            problem = f"{surplus[0]} is given, which a batch that is to {job} does not take"
            raise InputError(problem, wanted=", ".join(sorted(known_options)))
        if bootstrap is not None:
            bootstrap = whole(bootstrap, "bootstrap", 2, MOST_REPLICATES)
        phase = np.linspace(0, 6, 40)
        short = Recording(phase, np.sin(phase), np.sin(phase + 0.1))
        reading.check(short)
        if job == "identify":
            _rehearse(short, name, given_options)
        else:
            check_false_alarm(given_options.get("false_alarm", 0.01))
            flag(given_options.get("fixed", False), "fixed")
        return cls(job, name, start, reading, given_options, bootstrap)

    def given_model(self) -> str | Model:
        """Give the model or base as `identify` and `diagnose` take it."""
        return self.model if self.start is None else Model.from_dict(self.start)

    def to_dict(self) -> dict[str, Any]:
        """Everything, as plain JSON."""
        plain: dict[str, Any] = json.loads(json.dumps(asdict(self), sort_keys=True))
        return plain

    @cached_property
    def digest(self) -> str:
        """First twelve hexadecimal digits of the SHA-256 of the settings."""
        text = json.dumps(self.to_dict(), sort_keys=True)
        return hashlib.sha256(text.encode()).hexdigest()[:12]


def _name(given: object) -> str:
    if isinstance(given, str | os.PathLike) and isinstance(name := os.fspath(given), str):
        return name
    raise TypeError(f"the model or base is {shown(given)}: wanted a name, or the path of a model.json")


def plain(value: Any, name: str) -> Any:
    """Take a value as it is kept and sent: numbers of NumPy become those of Python.

    Raises
    ------
    InputError
        It cannot be written down.
    """
    try:
        return json.loads(json.dumps(value, default=lambda one: one.item()))
    except (AttributeError, TypeError, ValueError, RecursionError):
        raise InputError(f"{name} is {shown(value)}", wanted="numbers and texts") from None


def _rehearse(short: Recording, model: str, options: Mapping[str, Any]) -> None:
    """Identify a few samples with the options of all items, so that a wrong one is told once and at once.

    Of the bounds only the names are known to hold for every item: the rest of a box follows from recordings.
    """
    names = [name for name, _ in parameters(model)]
    for name, pair in mapping("bounds", options.get("bounds"), "name to (lower, upper)").items():
        if name not in names and name.partition("(")[0] not in names:
            raise InputError(f"bounds of '{name}'", wanted=f"one of {', '.join(names)}")
        if not isinstance(pair, list) or len(pair) != 2:
            raise InputError(f"bounds of {name} are {shown(pair)}", wanted="a pair (lower, upper)")
        low, high = (number(end, f"bound of {name}") for end in pair)
        if low > high:
            raise InputError(f"bounds of {name} are {shown(pair)}", wanted="the lower one first")
    rest = {name: value for name, value in options.items() if name != "bounds"}
    if options.get("optimizer") != "exact":
        rest["callback"] = lambda *_: True  # ends it after the first generation
    identify(short, model, seed=1, **rest)


def _known_options(job: str, optimizer: object) -> set[str]:
    """Keywords that `identify` or `diagnose` take and that every item can share."""
    if job == "diagnose":
        return {"false_alarm", "fixed"}
    known = {"optimizer", "bounds", "weights", "certify"}
    name = choice(optimizer, "optimizer", OPTIMIZERS)
    if name == "exact":
        return known
    function = {**SWARMS, "hybrid": hybrid}[name]
    return known | (set(signature(function).parameters) | set(RunOptions.__annotations__)) - _VARYING
