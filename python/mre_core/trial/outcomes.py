"""A case of an opened trial: answer, diagnosis and outcome together."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

from .parameters import Compared, compared
from .score import Outcome, judge


@dataclass(frozen=True)
class Scored:
    """One case with what was concealed, what was said, and how that is judged. Forces in N."""

    case: str
    effects: tuple[str, ...]
    laws: tuple[str, ...]
    base: str
    strength: float
    noise: str
    velocity: str
    displacement_noise: float
    """Rms in mm."""
    excitation: str
    reached: bool
    """False where the base absorbs the effect whatever its size, so that nothing is left to be found."""
    verdict: str
    outcome: Outcome
    noise_rms: float
    held_out_before: float | None
    held_out_after: float | None
    parameters: tuple[Compared, ...]
    error_shown: float
    """Rms of mismatch and noise over that of the force, after the base was refitted."""
    seconds: float

    @property
    def counted(self) -> bool:
        """Whether an effect that can be seen was concealed."""
        return bool(self.effects) and self.reached

    def to_dict(self) -> dict[str, Any]:
        """Entry of ``results.json``."""
        return asdict(self)


def scored(case: str, answer: Mapping[str, Any], said: Mapping[str, Any]) -> Scored:
    """Judge a case.

    Parameters
    ----------
    case : str
        Its id.
    answer : mapping
        Entry of the answers.
    said : mapping
        Content of the file of its diagnosis.

    Returns
    -------
    Scored
        All that the tables need.
    """
    planned, truth = answer["case"], answer["truth"]
    found = said.get("diagnosis")
    named = [effect["id"] for effect in found["effects"]] if found else []
    if found:
        others = [name for effect in found["effects"] for name in effect["indistinguishable_from"]]
        outcome = judge(
            planned["effects"], named, found["verdict"], noise=planned["noise"], alternatives=others
        )
    else:
        outcome = Outcome(tuple(sorted(planned["effects"])), (), "failed")
    return Scored(
        case=case,
        effects=tuple(planned["effects"]),
        laws=tuple(planned["laws"]),
        base=planned["base"],
        strength=min([effect["unexplained"] for effect in truth["effects"]], default=0.0)
        / truth["noise_rms"],
        noise=planned["noise"],
        velocity=planned["velocity"],
        displacement_noise=planned["displacement_noise"],
        excitation="short" if planned["samples"] else planned["excitation"] or "of the effect",
        reached=truth["reached"],
        verdict=found["verdict"] if found else "failed",
        outcome=outcome,
        noise_rms=truth["noise_rms"],
        held_out_before=found["fit"]["held_out_rms_before"] if found else None,
        held_out_after=found["fit"]["held_out_rms_after"] if found else None,
        parameters=tuple(compared(truth["effects"], found["effects"])) if found else (),
        error_shown=answer["error_shown"],
        seconds=said["seconds"],
    )
