"""The whole study: what is computed in which order, and what it amounts to."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

from .._core import Recording, __version__
from ..crew import Crew, OnProgress
from ..errors import shown
from ..grouping import each_of
from ..minimise import draw_seed
from . import (
    figure02_weights,
    figure11_models,
    figure12_population,
    figure13_algorithms,
    figures04_07_one_test,
    figures08_10_loops,
    readings,
)
from .campaign import Campaign, as_campaign, replica
from .effort import FULL, Effort
from .paper import TABLE_2
from .section import Section
from .truths import truths

SCHEMA = "mre-core/study/1"
REPLICA = (
    "The paper's recordings are not public. These are simulated replicas of its twelve tests: the first has"
    " the parameters of Table 2, the others give the peak forces that the figures show; noise, sampling and"
    " everything else the paper does not say are ours. Figure 11 has replicas made by three different"
    " devices."
)
RECORDED = (
    "These are the recordings that were given, not the paper's. The paper's tests are read as ranks: Table 2"
    " as the lowest current and smallest amplitude, Figures 8 and 9 as the highest current, Figure 10 as the"
    " middle amplitude, Figures 12 and 13 as the second current and the middle amplitude."
)


@dataclass(frozen=True)
class Study:
    """Section 4 of the paper, repeated."""

    note: str
    """Whose recordings these are."""
    seed: int
    effort: Effort
    tests: tuple[str, ...]
    sections: tuple[Section, ...]

    def to_dict(self) -> dict[str, Any]:
        """Content of ``study.json``: every number, and what is said of the paper. The same on every run."""
        return {
            "schema": SCHEMA,
            "version": __version__,
            "note": self.note,
            "seed": self.seed,
            "effort": asdict(self.effort),
            "tests": list(self.tests),
            "claims": [
                {"section": section.name, **asdict(claim)}
                for section in self.sections
                for claim in section.claims
            ],
            "sections": {section.name: dict(section.data) for section in self.sections},
        }

    def times(self) -> dict[str, Any]:
        """Content of ``times.json``: seconds, which differ from run to run."""
        return {section.name: dict(section.times) for section in self.sections if section.times}


def study(
    recordings: Sequence[Recording] | None = None,
    *,
    seed: int | None = None,
    effort: Effort = FULL,
    threads: int | None = None,
    on_progress: OnProgress | None = None,
) -> Study:
    """Repeat section 4 of the paper.

    Parameters
    ----------
    recordings : sequence of Recording, optional
        A campaign with force, each recording at one constant current. A simulated replica of the paper's by
        default.
    seed : int, optional
        Same seed, same result; of the replica's noise and of the swarms, whose repetitions take the seeds
        that follow. Drawn and reported where not given.
    effort : Effort
        Numbers of repetitions.
    threads : int, optional
        All cores by default. No result depends on it.
    on_progress : callable, optional
        Called with (what is computed, jobs done, jobs in all).

    Returns
    -------
    Study
        One section for each figure and table.

    Raises
    ------
    MreError
        The recordings, the seed or the number of threads cannot be used (a ValueError).
    """
    seed = draw_seed(seed)
    if not isinstance(effort, Effort):
        raise TypeError(f"effort is {shown(effort)}: wanted an Effort")
    crew = Crew(threads, on_progress)
    if recordings is None:
        return _whole(REPLICA, replica(seed), truths(seed), TABLE_2, seed, effort, crew)
    campaign = as_campaign(list(each_of(recordings)))
    return _whole(RECORDED, campaign, {"as recorded": campaign}, {}, seed, effort, crew)


def _whole(
    note: str,
    campaign: Campaign,
    devices: Mapping[str, Campaign],
    printed: Mapping[str, float],
    seed: int,
    effort: Effort,
    crew: Crew,
) -> Study:
    sections = (
        figure02_weights.section(),
        figures04_07_one_test.section(campaign, printed, seed, crew),
        figures08_10_loops.section(campaign, seed, crew),
        figure11_models.section(devices, effort, seed, crew),
        figure12_population.section(campaign.searched, effort, seed, crew),
        figure13_algorithms.section(campaign.searched, effort, seed, crew),
        readings.section(campaign.searched, effort, seed, crew),
    )
    return Study(note, seed, effort, tuple(case.name for case in campaign.cases), sections)
