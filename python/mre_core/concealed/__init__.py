"""Recordings of devices with concealed physics, made independently of the catalogue that is to name it."""

from .campaign import Campaign, Concealed, Recorded, make_campaign
from .devices import BASES
from .excitations import Excitation, followed, steady_current
from .law import effects, laws_of

__all__ = [
    "BASES",
    "Campaign",
    "Concealed",
    "Excitation",
    "Recorded",
    "effects",
    "followed",
    "laws_of",
    "make_campaign",
    "steady_current",
]
