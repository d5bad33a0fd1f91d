"""What is withheld from the tool, case by case."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cache

import mre_core
import numpy as np
from mre_core import Diagnosis, Model, Recording
from numpy.typing import NDArray
from recordings import building, damper, with_force

SEED = 1
SHORT = ("5mm3Hz", "5mm4Hz")


@dataclass(frozen=True)
class Proof:
    """A diagnosis of real recordings, and what it is to be compared with."""

    name: str
    title: str
    withheld: str
    expected: Mapping[str, str]
    """Effects, or what an unexplained mismatch depends on, that answer the question, each with why."""
    diagnosis: Diagnosis
    held_out: list[Recording] = field(default_factory=list)
    """Recordings that took no part at all."""
    sizes: Mapping[tuple[str, str], float] = field(default_factory=dict)
    """Values wanted of parameters, by effect and name: what was put in beside what was there before."""
    put_in: Mapping[str, float] = field(default_factory=dict)
    """What the script put in, by parameter."""


def memory() -> Proof:
    """Rubber isolators with a base model without memory."""
    train = building(["CNP100", "ICA100"], every=4)
    return Proof(
        "building-memory",
        "Rubber isolators of a building, base model without memory",
        "The base model is a spring and a dashpot; that the isolators remember their path is withheld."
        " The tool gets the earthquakes CNP100 and ICA100 (one sample of four); SP100 and ICA140 are shown to"
        " neither model.",
        {"hysteresis": "lead-free rubber dissipates by rate-independent memory"},
        mre_core.diagnose(train, "kelvin_voigt", seed=SEED),
        building(["SP100", "ICA140"], every=4),
    )


def current_withheld() -> Proof:
    """The damper, all currents in one base model."""
    train = damper(
        [f"{motion}{current}A" for motion in SHORT for current in ("0", "0x5", "1")], current=False
    )
    return Proof(
        "damper-current-withheld",
        "MR damper, the coil current withheld",
        "Six tests at 0, 0.5 and 1 A are given as if there were no coil: one set of parameters for all. The"
        " tool should find that the recordings differ from each other by something that is not recorded, and"
        " that it acts on the yield force.",
        {"recording": "an unexplained mismatch that differs from recording to recording"},
        mre_core.diagnose(train, "bouc_wen", seed=SEED),
    )


def current_law() -> Proof:
    """The current given, but a straight line between 0 and 1 A where the damper saturates."""
    # By name: given last, those at 0.5 A are as well explained by a stiffness that jumps before them.
    tests = damper([f"{motion}{current}A" for motion in SHORT for current in ("0", "0x5", "1")])
    known = [test for test in tests if test.current_level != 0.5]
    model = mre_core.identify(known, "bouc_wen", seed=SEED).model
    return Proof(
        "damper-current-law",
        "MR damper, a current law of the wrong form",
        "A Bouc-Wen model is identified at 0 A and 1 A and interpolates linearly between them. It is kept as"
        " it is and diagnosed at 0.5 A, where the yield force of the damper is well above the straight line.",
        {"field_dependence": "the parameters change with the current otherwise than the law says"},
        mre_core.diagnose(tests, model, fixed=True, seed=SEED),
    )


def yield_and_clearance() -> Proof:
    """The damper at 1 A with a spring and a dashpot."""
    train = damper(["5mm3Hz1A", "5mm4Hz1A"])
    return Proof(
        "damper-yield",
        "MR damper, base model without yield force and clearance",
        "The base model is a spring and a dashpot with an offset. Withheld are the yield force of the fluid"
        " and the clearance that shows as a kink after each reversal.",
        {
            "coulomb_friction": "the yield force",
            "hysteresis": "the yield force, with its stiffness before yielding",
            "backlash": "the clearance",
        },
        mre_core.diagnose(train, "kelvin_voigt", seed=SEED),
        damper(["10mm2Hz1A"]),
    )


@cache
def _model() -> Model:
    """The damper at 0.5 A as two other tests show it: a Bouc-Wen model with what it leaves out."""
    known = damper([f"{motion}0x5A" for motion in ("5mm3Hz", "10mm2Hz")])
    return mre_core.diagnose(known, "bouc_wen", seed=SEED).model


def _measured() -> tuple[Recording, NDArray[np.float64], NDArray[np.float64]]:
    """A test that the model was not fitted to, its force, and the part of that which is scored."""
    (whole,) = damper(["5mm4Hz0x5A"])
    force = np.asarray(whole.force)
    return whole, force, force[slice(*whole.scored)]


def altered(
    name: str, title: str, told: str, effect: str, force: NDArray[np.float64], sizes: Mapping[str, float]
) -> Proof:
    """The damper's force channel altered: diagnosed with a model of the damper that is kept as it is."""
    whole, *_ = _measured()
    return Proof(
        name,
        title,
        f"{told} The base is a model of the damper from two other tests at the same current (5 mm at 3 Hz and"
        " 10 mm at 2 Hz), kept as it is; what it misses by itself is in the recording as well.",
        {effect: "it was put in"},
        mre_core.diagnose([with_force(whole, force)], _model(), fixed=True, seed=SEED),
        sizes={(effect, key): size for key, size in sizes.items()},
        put_in=sizes,
    )


def delayed() -> Proof:
    """The force channel 5 ms late."""
    whole, force, _ = _measured()
    late = round(0.005 * whole.sampling_rate)
    return altered(
        "damper-delay",
        "MR damper, force channel 5 ms late",
        "A real recording of the damper at 1000 Hz; its force channel is shifted by five samples.",
        "time_delay",
        np.concatenate([np.full(late, force[0]), force[:-late]]),
        {"d": late / whole.sampling_rate},
    )


def clipped() -> Proof:
    """The force channel clipped at 90 % of its largest value."""
    _, force, scored = _measured()
    level = 0.9 * float(np.max(np.abs(scored)))
    return altered(
        "damper-clipping",
        "MR damper, force channel clipped at 90 %",
        "A real recording of the damper; its force channel ends at 90 % of the largest force.",
        "force_clipping",
        np.clip(force, -level, level),
        {"L": level},
    )


def hummed() -> Proof:
    """Mains hum on the force channel, 3 % of the force."""
    whole, force, scored = _measured()
    size = 0.03 * 2**0.5 * float(np.std(scored))
    return altered(
        "damper-hum",
        "MR damper, mains hum on the force channel",
        "A real recording of the damper; a 50 Hz sine of 3 % of the force's rms is added to its force.",
        "mains_interference",
        force + size * np.sin(2 * np.pi * 50 * whole.time),
        {"A_1, B_1": size, "f": 50.0},
    )


CASES: dict[str, Callable[[], Proof]] = {
    "building-memory": memory,
    "damper-current-withheld": current_withheld,
    "damper-current-law": current_law,
    "damper-yield": yield_and_clearance,
    "damper-delay": delayed,
    "damper-clipping": clipped,
    "damper-hum": hummed,
}
