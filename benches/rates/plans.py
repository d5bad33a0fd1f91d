"""What is drawn for each experiment: campaigns with known answers, by a seed."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import cycle, islice

import numpy as np
from mre_core.concealed import BASES, effects, laws_of
from mre_core.concealed.campaign import OWN_EXCITATION
from mre_core.trial.case import Case

STRENGTHS = (3.0, 1.0, 0.5)
"""What the effect leaves of the refitted base, over the noise, rms."""
WEAK = (0.25, 0.1, 0.05)
EACH_OF_SEVERAL = 2.0
NOISES = ("white", "ar60", "ar97")
EVERY_NOISE = ("white", "ar60", "ar97", "ar995", "pink", "narrow", "mains", "student", "quantised")
NOISE_SHARE = 0.01
"""Of the force, rms."""
NULL_SAMPLES = 10_000
DISPLACEMENT_NOISE = 0.003
"""mm, on every third null."""
LITTLE_TOLD = ("twelve", "steady", "single_staircase", "earthquakes")
"""Programmes of excitation that leave effects in doubt."""
PLACED = {
    **{effect: laws_of(effect) for effect in ("stiffness_jump", "end_stop", "force_clipping")},
    "unknown": ["bump"],
}
"""Effects that have a place, with their laws."""
LEVEL = 0.01
"""Stated rate of false alarms."""


@dataclass(frozen=True)
class Trial:
    """One diagnosis: what is concealed, and which effects the tool may not name."""

    case: Case
    without: tuple[str, ...] = ()
    false_alarm: float = LEVEL


NAMED = tuple(name for name in effects() if name != "unknown")
Draw = Callable[[np.random.Generator], Trial]


def _trial(rng: np.random.Generator, ids: tuple[str, ...], laws: tuple[str, ...], strength: float) -> Trial:
    return Trial(
        Case(
            effects=ids,
            laws=laws,
            base=str(rng.choice(BASES)),
            strength=strength,
            noise=str(rng.choice(NOISES)),
            velocity=str(rng.choice(["given", "given", "derived"])),
            excitation=None,
            samples=None,
            noise_share=NOISE_SHARE,
            displacement_noise=0.0,
            seed=int(rng.integers(2**32)),
        )
    )


def singles(rng: np.random.Generator) -> Iterator[Trial]:
    """Textbook laws at the three strengths in turn."""
    for strength, effect in _crossed(STRENGTHS):
        yield _trial(rng, (effect,), (laws_of(effect)[0],), strength)


def others(rng: np.random.Generator) -> Iterator[Trial]:
    """Other laws of the same physics than the textbook's."""
    for strength, effect in _crossed(STRENGTHS):
        if len(laws := laws_of(effect)) > 1:
            yield _trial(rng, (effect,), (str(rng.choice(laws[1:])),), strength)


def pairs(rng: np.random.Generator) -> Iterator[Trial]:
    """Two effects, each alone twice the noise."""
    for first in cycle(NAMED):
        second = str(rng.choice([name for name in NAMED if name != first]))
        yield _trial(rng, (first, second), (laws_of(first)[0], laws_of(second)[0]), EACH_OF_SEVERAL)


def triples(rng: np.random.Generator) -> Iterator[Trial]:
    """Three effects, each alone twice the noise."""
    for first in cycle(NAMED):
        ids = (first, *map(str, rng.choice([name for name in NAMED if name != first], 2, replace=False)))
        yield _trial(rng, ids, tuple(laws_of(name)[0] for name in ids), EACH_OF_SEVERAL)


def removed(rng: np.random.Generator) -> Iterator[Trial]:
    """Each effect in turn may not be named."""
    for strength, effect in _crossed(STRENGTHS[:2]):
        made = _trial(rng, (effect,), (laws_of(effect)[0],), strength)
        yield replace(made, without=(effect,))


def unknown(rng: np.random.Generator) -> Iterator[Trial]:
    """Physics of no catalogue."""
    laws = laws_of("unknown")
    for strength in cycle(STRENGTHS):
        for law in laws:
            yield _trial(rng, ("unknown",), (law,), strength)


def nulls(rng: np.random.Generator) -> Iterator[Trial]:
    """Nothing is missing, with every kind of noise."""
    for place, noise in enumerate(cycle(EVERY_NOISE)):
        made = _trial(rng, (), (), 0.0)
        shaken = DISPLACEMENT_NOISE if (place // len(EVERY_NOISE)) % 3 == 2 else 0.0
        null = replace(made.case, noise=noise, samples=NULL_SAMPLES, displacement_noise=shaken)
        yield replace(made, case=null)


def weak(rng: np.random.Generator) -> Iterator[Trial]:
    """Small effects: the tool, and an oracle that tests the concealed one alone at its share of the level."""
    for strength, effect in _crossed(WEAK):
        made = _trial(rng, (effect,), (laws_of(effect)[0],), strength)
        yield made
        ruled_out = tuple(name for name in NAMED if name != effect)
        yield replace(made, without=ruled_out, false_alarm=LEVEL / len(NAMED))


def doubts(rng: np.random.Generator) -> Iterator[Trial]:
    """Excitations that tell less, so that effects stay in doubt."""
    tried = cycle(LITTLE_TOLD)
    for strength, effect in _crossed(STRENGTHS[:2]):
        made = _trial(rng, (effect,), (laws_of(effect)[0],), strength)
        yield (
            made
            if effect in OWN_EXCITATION
            else replace(made, case=replace(made.case, excitation=next(tried)))
        )


def located(rng: np.random.Generator) -> Iterator[Trial]:
    """Effects that have a place, with every law of theirs, at the three strengths."""
    for turn in cycle(range(len(STRENGTHS))):
        for place, (effect, laws) in enumerate(PLACED.items()):
            law = str(rng.choice(laws))
            yield _trial(rng, (effect,), (law,), STRENGTHS[(place + turn) % len(STRENGTHS)])


def _crossed(strengths: tuple[float, ...]) -> Iterator[tuple[float, str]]:
    """Every effect at a strength, the strengths in turn; each effect meets every strength."""
    for turn in cycle(range(len(strengths))):
        for place, effect in enumerate(NAMED):
            yield strengths[(place + turn) % len(strengths)], effect


PLANS: dict[str, Callable[[np.random.Generator], Iterator[Trial]]] = {
    plan.__name__: plan
    for plan in (singles, others, pairs, removed, unknown, nulls, weak, doubts, triples, located)
}


def drawn(name: str, cases: int, seed: int) -> list[Trial]:
    """The first cases of an experiment."""
    rng = np.random.default_rng([seed, list(PLANS).index(name)])
    return list(islice(PLANS[name](rng), cases))
