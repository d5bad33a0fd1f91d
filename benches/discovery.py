"""Trials of the diagnosis on concealed physics, made by code that shares nothing with the catalogue's.

    python benches/discovery.py [--seeds 1:3] [--laws textbook|any|other] [--strengths 3,1,0.5]
    python benches/discovery.py --nulls 20 --noise white,ar60,ar97,ar995,pink,narrow,student,quantised

Seeds below 1000 are for development: thresholds may be tuned on them. Seeds from 1000 on are for judging, and
are run once per release.
"""

import argparse
import os
import sys
import time
import warnings
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent.parent / "tests"))

BASES = ("kelvin_voigt", "sinh", "bouc_wen")
JUDGING = 1000


@dataclass(frozen=True)
class Case:
    """One campaign; no effect is a null."""

    effect: str | None
    law: str
    base: str
    strength: float
    noise: str
    velocity: str
    seed: int


@dataclass(frozen=True)
class Outcome:
    """What the diagnosis said of a case."""

    case: Case
    kind: str
    """right, extra, wrong, unexplained, missed; clear or false for a null."""
    named: tuple[str, ...]
    reached: bool
    error: float
    """Rms error of the final model against the noise-free force, over the noise's rms."""
    seconds: float


def run(case: Case) -> Outcome:
    """Simulate a campaign, diagnose it, and judge what comes out."""
    import mre_core
    from concealed import make_campaign

    made = make_campaign(
        case.effect, case.law, base=case.base, strength=case.strength, noise=case.noise, seed=case.seed,
        velocity=case.velocity,
    )  # fmt: skip
    recordings = []
    for r in made.recordings:
        current = float(r.current[0]) if np.ptp(r.current) == 0 else r.current
        recordings.append(
            mre_core.Recording(
                r.time, r.displacement, r.force, velocity=r.velocity, current=current, name=r.name
            )
        )
    start = time.perf_counter()
    found = mre_core.diagnose(recordings, case.base, seed=1, threads=1)
    seconds = time.perf_counter() - start
    named = tuple(sorted(effect.id for effect in found.effects))
    truth = tuple(sorted(made.ids))
    errors = [f - r.truth for f, r in zip([h.final for h in found.histories], made.recordings, strict=True)]
    error = float(np.sqrt(np.mean(np.concatenate(errors) ** 2))) / made.noise_rms
    return Outcome(case, judge(truth, named, found.verdict), named, made.reached, error, seconds)


def judge(truth: tuple[str, ...], named: tuple[str, ...], verdict: str) -> str:
    """Compare what was named with what was concealed."""
    if not truth:
        return "clear" if verdict == "adequate" else "false"
    if named == truth:
        return "right"
    if named:
        return "extra" if set(truth) <= set(named) else "wrong"
    return "missed" if verdict == "adequate" else "unexplained"


def cases(options: argparse.Namespace) -> list[Case]:
    """All cases of the options, drawn from their seeds."""
    from concealed import effects, laws_of

    noises, found = options.noise.split(","), []
    if options.nulls:
        for noise in noises:
            for seed in range(options.first, options.first + options.nulls):
                rng = np.random.default_rng([seed, 7])
                base, velocity = str(rng.choice(BASES)), str(rng.choice(["given", "derived"]))
                found.append(Case(None, "textbook", base, 0.0, noise, velocity, seed))
        return found
    first, last = (int(text) for text in options.seeds.split(":"))
    strengths = [float(text) for text in options.strengths.split(",")]
    for seed in range(first, last):
        for k, effect in enumerate(e for e in effects() if e != "unknown"):
            rng = np.random.default_rng([seed, k, 99])
            laws = laws_of(effect)
            choice = {"textbook": laws[:1], "any": laws, "other": laws[1:] or laws}[options.laws]
            found.append(
                Case(
                    effect, str(rng.choice(choice)), str(rng.choice(BASES)), float(rng.choice(strengths)),
                    str(rng.choice(noises)), str(rng.choice(["given", "given", "derived"])), 1000 * seed + k,
                )
            )  # fmt: skip
    return found


def table(outcomes: list[Outcome]) -> str:
    """Counts by strength, or by noise for nulls."""
    null = outcomes[0].case.effect is None
    lines = []
    key = (lambda o: o.case.noise) if null else (lambda o: o.case.strength)
    for group in sorted({key(o) for o in outcomes}, key=str, reverse=not null):
        members = [o for o in outcomes if key(o) == group]
        if null:
            false = sum(o.kind == "false" for o in members)
            lines.append(f"{group}: {false} of {len(members)} false discoveries")
            continue
        counted = [o for o in members if o.reached]
        counts = Counter(o.kind for o in counted)
        right = [o.error for o in counted if o.kind == "right"]
        text = ", ".join(f"{kind} {count}" for kind, count in counts.most_common())
        median = f"{np.median(right):.2f}" if right else "-"
        absorbed = len(members) - len(counted)
        lines.append(
            f"strength {group}: {counts['right']} of {len(counted)} right ({text}); median error of the model"
            f" {median} of the noise; {absorbed} more that the base absorbs"
        )
    seconds = np.array([o.seconds for o in outcomes])
    lines.append(f"one thread: median {np.median(seconds):.1f} s, longest {seconds.max():.1f} s a campaign")
    return "\n".join(lines)


def main() -> None:
    """Run the trials that the options ask for and print their table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--seeds", default="1:3", help="first:last, last excluded")
    parser.add_argument("--laws", default="textbook", choices=("textbook", "any", "other"))
    parser.add_argument("--strengths", default="3,1,0.5")
    parser.add_argument("--noise", default="white,ar60,ar97")
    parser.add_argument("--nulls", type=int, default=0, help="campaigns without effect for each noise")
    parser.add_argument("--first", type=int, default=1, help="first seed of the nulls")
    parser.add_argument("--quiet", action="store_true", help="only the table")
    options = parser.parse_args()
    warnings.simplefilter("ignore")
    outcomes = []
    with ProcessPoolExecutor(os.cpu_count()) as pool:
        for outcome in pool.map(run, cases(options)):
            outcomes.append(outcome)
            if outcome.kind not in ("right", "clear") and not options.quiet:
                note = "" if outcome.reached else " (absorbed)"
                print(f"{outcome.kind}{note}: {outcome.case}, named {outcome.named}", flush=True)
    print(table(outcomes))


if __name__ == "__main__":
    main()
