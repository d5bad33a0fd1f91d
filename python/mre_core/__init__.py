"""Identify hysteresis models of magnetorheological elastomer isolators and dampers from recordings.

Units everywhere: millimetre, newton, second, ampere, degree Celsius.
"""

import sys
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ._core import MreError, Problem, Recording, __version__, inertia_weight, models
    from .asktell import AskTell
    from .batches import batch, plot_parameters, read_results
    from .certificate import Certificate, certificate
    from .chunks import read_chunks
    from .current_laws.fit import fit_laws
    from .current_laws.found import LawFit
    from .current_laws.law import Dependence, Law
    from .dataframe import from_dataframe
    from .diagnose import diagnose
    from .diagnosis import Diagnosis, MissingEffect
    from .effects import Effect
    from .errors import (
        CopyWarning,
        ExtrapolationWarning,
        InputError,
        SkippedWarning,
        UnitAssumedWarning,
        VelocityWarning,
    )
    from .fits import exact, hybrid
    from .identification import Identification
    from .identify import identify
    from .inspection import Inspection, inspect
    from .load import load, load_all
    from .loops import Loop, LoopTable, loops
    from .measure import Fit
    from .model import Level, Model, simulate
    from .results import Parameter, StopReason, SwarmResult
    from .specimen import one_specimen
    from .swarms import afsa, mafsa, pso
    from .uncertainty import Bootstrap, Estimate, Profile, Uncertainty, bootstrap, profile, uncertainty

__all__ = [
    "AskTell",
    "Bootstrap",
    "Certificate",
    "CopyWarning",
    "Dependence",
    "Diagnosis",
    "Effect",
    "Estimate",
    "ExtrapolationWarning",
    "Fit",
    "Identification",
    "InputError",
    "Inspection",
    "Law",
    "LawFit",
    "Level",
    "Loop",
    "LoopTable",
    "MissingEffect",
    "Model",
    "MreError",
    "Parameter",
    "Problem",
    "Profile",
    "Recording",
    "SkippedWarning",
    "StopReason",
    "SwarmResult",
    "Uncertainty",
    "UnitAssumedWarning",
    "VelocityWarning",
    "__version__",
    "afsa",
    "batch",
    "bootstrap",
    "certificate",
    "diagnose",
    "exact",
    "fit_laws",
    "from_dataframe",
    "hybrid",
    "identify",
    "inertia_weight",
    "inspect",
    "load",
    "load_all",
    "loops",
    "mafsa",
    "models",
    "one_specimen",
    "plot_parameters",
    "profile",
    "pso",
    "read_chunks",
    "read_results",
    "simulate",
    "uncertainty",
]

_HOMES = {
    "_core": "MreError Problem Recording __version__ inertia_weight models",
    "asktell": "AskTell",
    "batches": "batch plot_parameters read_results",
    "certificate": "Certificate certificate",
    "chunks": "read_chunks",
    "current_laws.fit": "fit_laws",
    "current_laws.found": "LawFit",
    "current_laws.law": "Dependence Law",
    "dataframe": "from_dataframe",
    "diagnose": "diagnose",
    "diagnosis": "Diagnosis MissingEffect",
    "effects": "Effect",
    "errors": "CopyWarning ExtrapolationWarning InputError SkippedWarning UnitAssumedWarning VelocityWarning",
    "fits": "exact hybrid",
    "identification": "Identification",
    "identify": "identify",
    "inspection": "Inspection inspect",
    "load": "load load_all",
    "loops": "Loop LoopTable loops",
    "measure": "Fit",
    "model": "Level Model simulate",
    "results": "Parameter StopReason SwarmResult",
    "specimen": "one_specimen",
    "swarms": "afsa mafsa pso",
    "uncertainty": "Bootstrap Estimate Profile Uncertainty bootstrap profile uncertainty",
}
"""Module to the names it defines. They are imported on first use: the command line needs few of them."""

_PARTS = ("plots", "trial")
"""Sub-packages with names of their own, which need no import of their own either."""

_HOME = {name: module for module, names in _HOMES.items() for name in names.split()}


def __getattr__(name: str) -> Any:
    if name in _PARTS:
        return import_module(f".{name}", __name__)
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(f".{_HOME[name]}", __name__), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__, *_PARTS})


class _Package(ModuleType):
    """Some functions are called as the module that defines them, whose import would take their name."""

    def __setattr__(self, name: str, value: Any) -> None:
        if not (name in _HOME and isinstance(value, ModuleType)):
            super().__setattr__(name, value)


sys.modules[__name__].__class__ = _Package
