"""Recordings that follow each other on one specimen."""

from collections.abc import Iterable

from ._core import Recording
from .grouping import each_of


def one_specimen(recordings: Iterable[Recording]) -> list[Recording]:
    """Tell recordings that they follow each other on one specimen, which was virgin before the first.

    Otherwise every recording counts as that of a rested and virgin specimen. Wear (`cyclic_degradation`) and
    Mullins softening then go on from one recording to the next. What comes back with time (heat, creep,
    relaxation) starts rested in each of them all the same.

    Parameters
    ----------
    recordings : iterable of Recording
        With force, in the order in which they were recorded.

    Returns
    -------
    list of Recording
        The same, each with its `past`: the largest displacement so far (mm), the path (mm), the strokes
        (integral of ``|x v|``, mm^2), the energy that passed through the specimen and that stayed in it
        (N mm), and the integral of ``v^2`` (mm^2/s).

    Raises
    ------
    MreError
        One of them has no force (a ValueError).
    """
    found = list(each_of(recordings))
    return [recording.after(found[:place]) for place, recording in enumerate(found)]
