"""Forty cases of the standard trial that are quick: what it is measured on, and what the tests run.

    PYTHONPATH=python python tests/short_trial.py SEED ...

prints how many of the effects were named right and how many nulls were clear.
"""

import sys
import tempfile
import warnings
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from mre_core.trial import Case, make_trial, open_trial, run_trial, standard
from mre_core.trial.outcomes import Scored

EFFECTS, NULLS = 28, 12
WEAKEST = 1.0
SAMPLES = 5000


def short_cases(seed: int) -> list[Case]:
    """One effect, or none; base models without a hysteretic variable; no noise on the displacement."""
    quick = [
        replace(case, samples=SAMPLES, displacement_noise=0.0)
        for case in standard(400, seed)
        if case.base != "bouc_wen" and case.excitation in ("rich", "field", "offset")
    ]
    one = [c for c in quick if len(c.effects) == 1 and c.strength >= WEAKEST and c.effects != ("unknown",)]
    return [*one[:EFFECTS], *(c for c in quick if not c.effects)][: EFFECTS + NULLS]


def short_trial(seed: int, folder: Path, workers: int | None = None) -> Sequence[Scored]:
    """Make, run and open."""
    make_trial(folder, short_cases(seed), seed=seed, workers=workers)
    run_trial(folder, workers=workers)
    return open_trial(folder).cases


def counts(cases: Sequence[Scored]) -> tuple[int, int, int, int]:
    """Effects named right, effects that the base does not absorb, clear nulls, nulls."""
    effects = [c for c in cases if c.counted]
    nulls = [c for c in cases if not c.effects]
    right = sum(c.outcome.kind == "right" for c in effects)
    return right, len(effects), sum(c.outcome.kind == "clear" for c in nulls), len(nulls)


if __name__ == "__main__":
    warnings.simplefilter("ignore")
    total = [0, 0, 0, 0]
    for text in sys.argv[1:]:
        with tempfile.TemporaryDirectory() as place:
            found = short_trial(int(text), Path(place) / "trial")
        total = [a + b for a, b in zip(total, counts(found), strict=True)]
        wrong = [
            (c.effects, c.base, c.noise, c.outcome.named)
            for c in found
            if c.outcome.kind not in ("right", "clear")
        ]
        print(text, counts(found), wrong, flush=True)
    print("right {} of {}, clear {} of {}".format(*total))
