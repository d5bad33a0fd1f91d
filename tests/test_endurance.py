"""What counts as a leak, and that a short endurance run finds none."""

import random
from pathlib import Path

import pytest
from endurance.health import Health, leaks
from endurance.jobs import JOBS


def memories(*values: float) -> list[Health]:
    return [Health(value, 9, 3, 0) for value in values]


@pytest.mark.parametrize(
    ("values", "leak"),
    [
        ([200.0] * 11, False),
        ([200.0 + 10 * i for i in range(11)], True),
        ([200.0 + 9 * (-1) ** i for i in range(11)], False),
        ([100.0] + [400.0] * 10, False),  # libraries and caches
        ([200.0, 200.0] + [300.0] * 9, False),  # once
        ([200.0 + 0.5 * i for i in range(11)], False),  # less than an allocator keeps
        ([200.0 + 5 * i + 9 * (-1) ** i for i in range(11)], True),
        ([300.0 - 10 * i for i in range(11)], False),
    ],
)
def test_memory(values: list[float], leak: bool) -> None:
    assert [text.split(":")[0] for text in leaks(memories(*values))] == ["memory rises"] * leak


@pytest.mark.parametrize("name", ["files", "threads", "processes"])
def test_what_stays_open(name: str) -> None:
    told = memories(*[200.0] * 11)
    told[-1] = told[-1]._replace(**{name: 12})
    assert leaks(told) == [f"{name}: {getattr(told[0], name)} at the start, 12 at the end"]


@pytest.mark.filterwarnings("ignore::mre_core.errors.ExtrapolationWarning")
def test_a_round_of_every_job(tmp_path: Path) -> None:
    draw = random.Random(1)
    for job in JOBS.values():
        job(draw, tmp_path)
    before = Health.now()
    for job in JOBS.values():
        job(draw, tmp_path)
    after = Health.now()
    assert (after.files, after.processes) == (before.files, before.processes)
    assert after.threads <= before.threads
