"""The laws of every effect; importing a module enters its laws in the register."""

from . import (
    contact,
    damage,
    damping,
    elastic,
    field,
    friction,
    hysteresis,
    relaxation,
    rig,
    sensor,
    softening,
    unknown,
)

__all__ = [
    "contact",
    "damage",
    "damping",
    "elastic",
    "field",
    "friction",
    "hysteresis",
    "relaxation",
    "rig",
    "sensor",
    "softening",
    "unknown",
]
