"""What is withheld from the tool, case by case."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import mre_core
import numpy as np
from mre_core import Diagnosis, Model, Recording
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
    """Ids that answer the question, each with why."""
    diagnosis: Diagnosis
    held_out: list[Recording] = field(default_factory=list)
    """Recordings that took no part at all."""
    sizes: Mapping[tuple[str, str], float] = field(default_factory=dict)
    """True values of parameters, by effect and name; known where the script altered the channel."""


def memory() -> Proof:
    """Rubber isolators with a base model without memory."""
    train = building(["CNP100", "ICA100"], every=4)
    return Proof(
        "building-memory",
        "Rubber isolators of a building, base model without memory",
        "The base model is a spring and a dashpot; that the isolators remember their path is withheld from it."
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
        {"field_dependence": "the parameters change with the current"},
        mre_core.diagnose(train, "bouc_wen", seed=SEED),
    )


def current_law() -> Proof:
    """The current given, but a straight line between 0 and 1 A where the damper saturates."""
    known = damper([f"{motion}{current}A" for motion in SHORT for current in ("0", "1")])
    between = damper([f"{motion}0x5A" for motion in SHORT])
    model = mre_core.identify(known, "bouc_wen", seed=SEED).model
    return Proof(
        "damper-current-law",
        "MR damper, a current law of the wrong form",
        "A Bouc-Wen model is identified at 0 A and 1 A and interpolates linearly between them. It is kept as"
        " it is and diagnosed at 0.5 A, where the yield force of the damper is well above the straight line.",
        {"field_dependence": "the parameters change with the current otherwise than the law says"},
        mre_core.diagnose([*known, *between], model, fixed=True, seed=SEED),
    )


def yield_and_clearance() -> Proof:
    """The damper at 1 A with a spring and a dashpot."""
    train = damper(["5mm3Hz1A", "5mm4Hz1A"])
    return Proof(
        "damper-yield",
        "MR damper, base model without yield force and clearance",
        "The base model is a spring and a dashpot with an offset. Withheld are the yield force of the fluid and"
        " the clearance that shows as a kink after each reversal.",
        {
            "coulomb_friction": "the yield force",
            "hysteresis": "the yield force, with its stiffness before yielding",
            "backlash": "the clearance",
        },
        mre_core.diagnose(train, "kelvin_voigt", seed=SEED),
        damper(["10mm2Hz1A"]),
    )


def altered(name: str, title: str, told: str, effect: str, change: Callable[[Recording], Recording],
            sizes: Callable[[Recording], Mapping[tuple[str, str], float]]) -> Proof:  # fmt: skip
    """The damper's force channel altered; the base is what a diagnosis of the recording as it is found."""
    (whole,) = damper(["5mm4Hz0x5A"])
    before: Model = mre_core.diagnose([whole], "bouc_wen", seed=SEED).model
    return Proof(
        name,
        title,
        f"{told} The base model is what the diagnosis found on the recording as it was measured"
        f" ({', '.join(e.id for e in before.effects) or 'no effects'}), so that only the alteration is new.",
        {effect: "it was put in"},
        mre_core.diagnose([change(whole)], before, seed=SEED),
        sizes=sizes(whole),
    )


def delayed() -> Proof:
    """The force channel 5 ms late."""

    def change(r: Recording) -> Recording:
        late = round(0.005 * r.sampling_rate)
        force = np.asarray(r.force)
        return with_force(r, np.concatenate([np.full(late, force[0]), force[:-late]]))

    return altered(
        "damper-delay", "MR damper, force channel 5 ms late",
        "A real recording of the damper at 1000 Hz; its force channel is shifted by five samples.",
        "time_delay", change, lambda r: {("time_delay", "d"): 0.005},
    )  # fmt: skip


def clipped() -> Proof:
    """The force channel clipped at 90 % of its largest value."""

    def level(r: Recording) -> float:
        return 0.9 * float(np.max(np.abs(np.asarray(r.force)[slice(*r.scored)])))

    return altered(
        "damper-clipping", "MR damper, force channel clipped at 90 %",
        "A real recording of the damper; its force channel ends at 90 % of the largest force.",
        "force_clipping", lambda r: with_force(r, np.clip(np.asarray(r.force), -level(r), level(r))),
        lambda r: {("force_clipping", "L"): level(r)},
    )  # fmt: skip


def hummed() -> Proof:
    """Mains hum on the force channel, 3 % of the force."""

    def size(r: Recording) -> float:
        return 0.03 * 2**0.5 * float(np.std(np.asarray(r.force)[slice(*r.scored)]))

    def change(r: Recording) -> Recording:
        return with_force(r, np.asarray(r.force) + size(r) * np.sin(2 * np.pi * 50 * r.time))

    return altered(
        "damper-hum", "MR damper, mains hum on the force channel",
        "A real recording of the damper; a 50 Hz sine of 3 % of the force's rms is added to its force channel.",
        "mains_interference", change,
        lambda r: {("mains_interference", "A_1, B_1"): size(r), ("mains_interference", "f"): 50.0},
    )  # fmt: skip


CASES: dict[str, Callable[[], Proof]] = {
    "building-memory": memory,
    "damper-current-withheld": current_withheld,
    "damper-current-law": current_law,
    "damper-yield": yield_and_clearance,
    "damper-delay": delayed,
    "damper-clipping": clipped,
    "damper-hum": hummed,
}
