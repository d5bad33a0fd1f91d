"""One case of a trial: what is concealed, and how it is recorded."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..errors import InputError

if TYPE_CHECKING:
    from ..concealed import Campaign, Excitation

LARGEST_ERROR = 0.06
"""Share of the force up to which a force plot looks right: the worst that the seed paper reports."""


@dataclass(frozen=True)
class Case:
    """A campaign to be made; without effects it is a null.

    The fields are the arguments of `mre_core.concealed.make_campaign`.
    """

    effects: tuple[str, ...]
    laws: tuple[str, ...]
    base: str
    strength: float
    noise: str
    velocity: str
    excitation: str | None
    samples: int | None
    noise_share: float
    displacement_noise: float
    seed: int

    def simulate(self, also: "Sequence[Excitation]" = ()) -> "Campaign":
        """Make the recordings, weaker where a plot of the force would show that something is missing.

        Parameters
        ----------
        also : sequence of Excitation
            Recorded after the others, which they do not change.

        Returns
        -------
        Campaign
            Recordings and the truth. What the refitted base leaves, noise included, is at most
            `LARGEST_ERROR` of the force.

        Raises
        ------
        InputError
            SciPy, which the simulator needs, is not installed.
        """
        try:
            from ..concealed import make_campaign
        except ModuleNotFoundError as error:
            raise InputError(
                f"simulating a trial needs {error.name}", wanted="pip install 'mre-core[trial]'"
            ) from None
        strength = self.strength
        while True:
            made = make_campaign(
                self.effects or None,
                self.laws,
                self.base,
                strength,
                self.noise,
                self.seed,
                self.excitation,
                self.samples,
                self.velocity,
                noise_share=self.noise_share,
                displacement_noise=self.displacement_noise,
                also=also,
            )
            if not made.effects or error_shown(made) <= LARGEST_ERROR:
                return made
            strength /= 2


def error_shown(made: "Campaign") -> float:
    """Return what a plot of the force shows: rms of mismatch and noise over that of the force."""
    return float((made.unexplained_rms**2 + made.noise_rms**2) ** 0.5) / made.force_rms
