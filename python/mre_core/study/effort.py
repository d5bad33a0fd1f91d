"""How much the study computes."""

from dataclasses import dataclass

from ..checks import whole

MOST = 1_000_000


@dataclass(frozen=True)
class Effort:
    """Numbers of repetitions.

    Raises
    ------
    InputError
        One is no whole number from 1 to a million.
    """

    seeds: int
    """Of every swarm on the sinh model (Figures 12 and 13, the readings)."""
    bouc_wen_seeds: int
    """Of every particle swarm on Bouc-Wen (Figure 11), whose evaluations cost more."""
    bouc_wen_iterations: int
    """Of every swarm on Bouc-Wen (Figure 11); the paper has 300."""

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            whole(value, name, 1, MOST)


FULL = Effort(seeds=50, bouc_wen_seeds=10, bouc_wen_iterations=300)
QUICK = Effort(seeds=3, bouc_wen_seeds=1, bouc_wen_iterations=10)
"""To see that everything runs; too little to judge by."""
