"""Effects that a model carries beside its equation, with their parameters."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Self

from . import _core
from .checks import texts
from .errors import InputError, mapping
from .stored import number


@dataclass(frozen=True)
class Effect:
    """An effect of the catalogue under one of its laws.

    Where the law belongs to the measurement (drift, interference), its coefficients are those of single
    recordings and no part of a device: `parameters` then holds its shapes only.

    Raises
    ------
    MreError
        No such effect or law, or parameters that are not those of the law or not admissible.

    Examples
    --------
    >>> effect = Effect("maxwell_relaxation", "one branch", {"k_m": 1.05, "tau": 0.52})
    >>> effect.units
    {'k_m': 'N/mm', 'tau': 's'}
    """

    id: str
    law: str
    parameters: Mapping[str, float]

    def __post_init__(self) -> None:
        texts((self.id, self.law), "id or law of an effect")
        if sorted(mapping("parameters", self.parameters, "name to number")) != sorted(self.units):
            found = ", ".join(self.parameters) or "none"
            raise InputError(
                f"parameters of {self.id} ({self.law}) are {found}", wanted=", ".join(self.units) or "none"
            )
        _core.check_effect(*self.given())

    @property
    def of_the_measurement(self) -> bool:
        """True where the law belongs to the measurement and not to the device."""
        return _core.effect_parameters(self.id, self.law)[2]

    @property
    def units(self) -> dict[str, str]:
        """Parameters of a device with this effect and their units, in the order of the law."""
        coefficients, shapes, own = _core.effect_parameters(self.id, self.law)
        return dict(shapes if own else [*coefficients, *shapes])

    def given(self) -> tuple[str, str, list[float], list[float]]:
        """Id, law, coefficients and shapes, as the core takes them."""
        coefficients, shapes, own = _core.effect_parameters(self.id, self.law)

        def values(part: list[tuple[str, str]]) -> list[float]:
            return [number(self.parameters[name], f"{name} of {self.id}") for name, _ in part]

        return self.id, self.law, [] if own else values(coefficients), values(shapes)

    def to_dict(self) -> dict[str, Any]:
        """Entry of a model file."""
        return {
            "id": self.id,
            "law": self.law,
            "of_the_measurement": self.of_the_measurement,
            "parameters": {
                name: {"value": self.parameters[name], "unit": unit} for name, unit in self.units.items()
            },
        }

    @classmethod
    def from_dict(cls, content: Any) -> Self:
        """Read an entry of a model file.

        Raises
        ------
        MreError
            Something is missing, of the wrong kind, or not admissible.
        """
        try:
            parameters = {str(name): p["value"] for name, p in content["parameters"].items()}
            return cls(str(content["id"]), str(content["law"]), parameters)
        except (KeyError, TypeError, AttributeError) as error:
            raise InputError(
                f"effects hold {content!r}: {error!r}", wanted="an id, a law and parameters for each"
            ) from None
