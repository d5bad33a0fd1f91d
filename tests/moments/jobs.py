"""Commands that take long, in a folder of their own."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple

import mre_core.trial
from rig import BOUC_WEN, made_of, motion, record, write_csv


class Job(NamedTuple):
    prepare: Callable[[Path], object]
    arguments: Sequence[str]
    span: float
    """Seconds from which a moment is drawn: some before the work, some within it."""


def one(folder: Path) -> None:
    moved = motion(cycles=60, rate=512)
    for current in (0, 1):
        write_csv(
            folder / f"{current}A.csv",
            record(made_of("bouc_wen", BOUC_WEN), moved, noise=0.1, seed=int(current)),
        )


def campaign(folder: Path) -> None:
    for current in (0.0, 0.5, 1.0):
        device = made_of("bouc_wen", BOUC_WEN | {"kw": 40 + 20 * current})
        write_csv(folder / f"{current}A.csv", record(device, motion(cycles=20, rate=200), noise=0.1))


def several(folder: Path) -> None:
    (folder / "in").mkdir()
    device = made_of("bouc_wen", BOUC_WEN)
    for i in range(8):
        write_csv(folder / "in" / f"{i}.csv", record(device, motion(rate=200), noise=0.1, seed=i))


def trial(folder: Path) -> None:
    mre_core.trial.make_trial(folder / "trial", 3, seed=1, workers=1)


IDENTIFY = [
    "identify",
    "0A.csv",
    "1A.csv",
    "--model",
    "bouc_wen",
    "--name-pattern",
    "{current}A",
    "--seed",
    "1",
]
BATCH = ["batch", "in", "--model", "sinh", "--optimizer", "mafsa", "--no-figures", "--seed", "1"]
CURRENTS = ["0.0A.csv", "0.5A.csv", "1.0A.csv", "--name-pattern", "{current}A"]
LAWS = ["laws", *CURRENTS, "--model", "bouc_wen"]
DIAGNOSE = ["diagnose", *CURRENTS, "--base", "sinh", "--quiet", "--out", "out"]
RUN = ["trial", "run", "trial", "--resume"]

JOBS = {
    "identify": Job(one, [*IDENTIFY, "--iterations", "1000000", "--out", "out"], 2.0),
    "identify, figures": Job(
        one, [*IDENTIFY, "--optimizer", "pso", "--iterations", "2", "--out", "out"], 3.0
    ),
    "diagnose": Job(campaign, DIAGNOSE, 6.0),
    "diagnose, blank": Job(campaign, [*DIAGNOSE, "--blank", "20"], 12.0),
    "laws": Job(campaign, [*LAWS, "--quiet", "--out", "out"], 6.0),
    "batch": Job(several, [*BATCH, "--out", "out"], 2.0),
    "trial run": Job(trial, [*RUN, "--workers", "2"], 6.0),
    "trial run, one process": Job(trial, [*RUN, "--workers", "1"], 6.0),
    "study": Job(lambda folder: None, ["study", "--quick", "--out", "out"], 5.0),
    "demo": Job(lambda folder: None, ["demo", "--iterations", "20", "--out", "out"], 5.0),
}
