"""Recordings of devices with concealed physics, made independently of the catalogue that is to name it."""

from .campaign import Campaign, Concealed, Recorded, make_campaign
from .devices import BASES
from .law import effects, laws_of

__all__ = ["BASES", "Campaign", "Concealed", "Recorded", "effects", "laws_of", "make_campaign"]
