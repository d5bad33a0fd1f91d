"""Recordings that follow each other on one specimen."""

from collections.abc import Iterable

from ._core import Recording
from .grouping import each_of


def one_specimen(recordings: Iterable[Recording]) -> list[Recording]:
    """Tell recordings that they follow each other on one specimen, which was virgin before the first.

    Otherwise every recording counts as that of a rested and virgin specimen. Wear (`cyclic_degradation`),
    Mullins softening and ageing (`creep`) then go on from one recording to the next. What comes back with
    time (heat, creep of the force, relaxation) starts rested in each of them all the same.

    Parameters
    ----------
    recordings : iterable of Recording
        In the order in which they were recorded, all but the last with force. The past of the first is kept.

    Returns
    -------
    list of Recording
        The same, each with its `past`: the `time` in recordings so far (s, without the rests between them),
        the largest `displacement` (mm), the `path` (mm), the
        `strokes` (integral of ``|x v|``, mm^2), the `energy` that passed through the specimen, that `stayed`
        in it, and the most of that so far (`dissipated`; all N mm, with the measured force), and the `heat`
        of a dashpot (integral of ``v^2``, mm^2/s).

    Raises
    ------
    MreError
        One of them but the last has no force (a ValueError).
    """
    found: list[Recording] = []
    for recording in each_of(recordings):
        first = not found and recording.past is not None
        found.append(recording if first else recording.after(found[-1:]))
    return found
