"""One diagnosis, and what came of it beside the truth."""

import time
from dataclasses import dataclass

import mre_core
import numpy as np
from mre_core import Recording
from mre_core.concealed import Campaign
from plans import Trial


@dataclass(frozen=True)
class Outcome:
    """What the tool said of a trial."""

    trial: Trial
    named: tuple[str, ...]
    rivals: tuple[str, ...]
    verdict: str
    p_base: float
    """Chance of the base model's mismatch under the null, as the tool has it."""
    p_rest: float
    """Chance of what the final model leaves."""
    reached: bool
    """False where the base model absorbs the effect at any size."""
    error: float
    """Rms of the final model's force against the noise-free truth, over that of the noise."""
    seconds: float
    sets: tuple[int, ...]
    """For each effect named, with how many it may be exchanged, itself included."""
    twin: bool = False
    """True where the truth may not be named, and a diagnosis that may name all says that these recordings
    cannot tell it from what is named."""

    @property
    def right(self) -> bool:
        """Exactly the effects that are concealed."""
        return sorted(self.named) == sorted(self.trial.case.effects)

    @property
    def among(self) -> bool:
        """The first truth is named, or listed as not to be told from what is named."""
        return set(self.trial.case.effects) <= {*self.named, *self.rivals}

    @property
    def admitted(self) -> bool:
        """Says that it does not know: `unexplained`, or names that are said to leave a mismatch."""
        return self.verdict in ("unexplained", "partly_explained")


def run(trial: Trial) -> Outcome:
    """Simulate, diagnose on one thread, compare."""
    made = trial.case.simulate()
    start = time.perf_counter()
    found = mre_core.diagnose(
        recordings_of(made),
        trial.case.base,
        seed=1,
        false_alarm=trial.false_alarm,
        without=trial.without,
        threads=1,
    )
    seconds = time.perf_counter() - start
    named = tuple(effect.id for effect in found.effects)
    pairs = zip(found.histories, made.recordings, strict=True)
    error = np.concatenate([history.final - recorded.truth for history, recorded in pairs])
    return Outcome(
        trial,
        named,
        tuple(rival for effect in found.effects for rival in effect.indistinguishable_from),
        found.verdict,
        float(found.p_values["base"]),
        float(found.p_values["rest"]),
        made.reached,
        float(np.sqrt(np.mean(error**2))) / made.noise_rms,
        seconds,
        tuple(1 + len(effect.indistinguishable_from) for effect in found.effects),
        bool(trial.without) and found.verdict == "missing_physics" and _exchanged(trial, made, named),
    )


def _exchanged(trial: Trial, made: Campaign, named: tuple[str, ...]) -> bool:
    """Whether the diagnosis that may name everything says that the truth cannot be told from these names."""
    every = mre_core.diagnose(
        recordings_of(made), trial.case.base, seed=1, false_alarm=trial.false_alarm, threads=1
    )
    exchangeable = ({effect.id, *effect.indistinguishable_from} for effect in every.effects)
    return any({*named, *trial.case.effects} <= one for one in exchangeable)


def recordings_of(made: Campaign) -> list[Recording]:
    """What the tool gets."""
    found = []
    for one in made.recordings:
        steady = float(np.ptp(one.current)) == 0.0
        current = float(one.current[0]) if steady else one.current
        found.append(
            Recording(
                one.time, one.displacement, one.force, velocity=one.velocity, current=current, name=one.name
            )
        )
    return found
