"""The standard trial: which cases, by a seed."""

from collections.abc import Iterator, Sequence

import numpy as np

from .case import Case

BASES = ("kelvin_voigt", "sinh", "bouc_wen")
NOISES = ("white", "ar60", "ar97", "ar995", "pink", "narrow", "mains", "student", "quantised")
STRENGTHS = (0.25, 0.5, 1.0, 2.0, 3.0)
NOISE_SHARES = (0.005, 0.01, 0.015)
JUDGING = 1000
"""Seeds below are for development, those from here on for judging: each is run once."""

_KINDS = ("single",) * 12 + ("null",) * 5 + ("pair",) * 2 + ("unknown",)
"""Every twenty cases."""
_FIELD = ("field_lag", "field_remanence", "field_dependence")
_SHORT = 2000
_EXCITATIONS = {
    "rich": 8,
    "short": 3,
    "levels": 2,
    "twelve": 2,
    "earthquakes": 2,
    "steady": 1,
    "offset": 1,
    "field": 1,
}
"""Weights; "short" is the rich campaign in 2,000 samples."""


def standard(cases: int, seed: int) -> list[Case]:
    """Plan a trial: of twenty cases 12 have one effect, 2 have two, 1 is of no catalogue, 5 have nothing.

    Parameters
    ----------
    cases : int
        How many.
    seed : int
        Decides everything.

    Returns
    -------
    list of Case
        In an order that tells nothing.
    """
    from ..concealed import effects, laws_of

    rng = np.random.default_rng([seed, 0x7216])
    named = [name for name in effects() if name != "unknown"]
    decks = {
        "single": _deck(rng, named),
        "pair": _deck(rng, named),
        "null": _deck(rng, NOISES),
        "unknown": _deck(rng, laws_of("unknown")),
    }
    found = []
    for i in range(cases):
        kind = _KINDS[i % len(_KINDS)]
        ids: tuple[str, ...] = ()
        laws: tuple[str, ...] = ()
        noise = str(rng.choice(NOISES))
        if kind == "null":
            noise = next(decks["null"])
        elif kind == "unknown":
            ids, laws = ("unknown",), (next(decks["unknown"]),)
        else:
            ids = (next(decks[kind]),)
            if kind == "pair":
                ids = (*ids, str(rng.choice([name for name in named if name != ids[0]])))
            laws = tuple(_law(rng, laws_of(name)) for name in ids)
        excitation, samples = _excitation(rng, ids)
        found.append(
            Case(
                effects=ids,
                laws=laws,
                base=str(rng.choice(BASES)),
                strength=float(rng.choice(STRENGTHS)) if ids else 0.0,
                noise=noise,
                velocity=str(rng.choice(["given", "given", "derived"])),
                excitation=excitation,
                samples=samples,
                noise_share=float(rng.choice(NOISE_SHARES)),
                displacement_noise=float(rng.choice([0.0, 0.0, 0.003])),
                seed=int(rng.integers(2**32)),
            )
        )
    return [found[i] for i in rng.permutation(len(found))]


def _deck(rng: np.random.Generator, cards: Sequence[str]) -> Iterator[str]:
    """All cards in random order, then all in another: as evenly often as the number of cases allows."""
    while True:
        for i in rng.permutation(len(cards)):
            yield cards[i]


def _law(rng: np.random.Generator, laws: Sequence[str]) -> str:
    """Draw the textbook law half of the time."""
    return laws[0] if rng.random() < 0.5 else str(rng.choice(laws))


def _excitation(rng: np.random.Generator, ids: Sequence[str]) -> tuple[str, int | None]:
    """Draw a programme; what depends on a changing current gets one, creep half of the time a hold."""
    weights = np.array(list(_EXCITATIONS.values())) / sum(_EXCITATIONS.values())
    name = str(rng.choice(list(_EXCITATIONS), p=weights))
    if any(one in _FIELD for one in ids):
        name = "field"
    elif "creep" in ids and rng.random() < 0.5:
        name = "offset"
    return ("rich", _SHORT) if name == "short" else (name, None)
