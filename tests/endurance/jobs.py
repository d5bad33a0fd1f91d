"""Jobs on random data, each of which ends within seconds."""

import json
import random
import shutil
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any, Final

import mre_core
from missing import campaign
from mre_core import Model
from rig import BOUC_WEN, KELVIN_VOIGT, SINH, made_of, motion, record, write_csv

DEVICES: Final = {"kelvin_voigt": KELVIN_VOIGT, "sinh": SINH, "bouc_wen": BOUC_WEN}
OPTIMIZERS: Final = ("exact", "hybrid", "mafsa", "afsa", "pso")


def some_recording(draw: random.Random, name: str | None = None) -> mre_core.Recording:
    """Of a random device, length and noise."""
    device: Model = made_of(*draw.choice(list(DEVICES.items())))
    moved = motion(draw.uniform(1, 8), rate=draw.choice([50, 100, 256]), cycles=draw.uniform(2, 12))
    return record(device, moved, noise=draw.uniform(0, 1), seed=draw.randrange(2**32), name=name or "test")


def identify(draw: random.Random, folder: Path) -> None:
    """With any model and optimiser, through a file."""
    path = write_csv(folder / "one.csv", some_recording(draw))
    optimizer: Any = draw.choice(OPTIMIZERS)
    few: dict[str, Any] = {} if optimizer == "exact" else {"max_iterations": 4}
    found = mre_core.identify(
        mre_core.load(path), draw.choice(list(DEVICES)), optimizer=optimizer, seed=1, **few
    )
    (folder / "model.json").write_text(json.dumps(found.model.to_dict()))
    mre_core.simulate(Model.load(folder / "model.json"), some_recording(draw))


def diagnose(draw: random.Random, folder: Path) -> None:
    """Recordings from which something is missing, or nothing."""
    recordings = draw.sample(campaign(), 2) if draw.random() < 0.5 else [some_recording(draw)]
    found = mre_core.diagnose(recordings, draw.choice(list(DEVICES)), seed=draw.randrange(2**32))
    str(found.to_dict())


def batch(draw: random.Random, folder: Path) -> None:
    """A folder of files, one of which is none, in processes of its own."""
    for name in ("in", "out"):
        shutil.rmtree(folder / name, ignore_errors=True)
    (folder / "in").mkdir()
    for i in range(4):
        write_csv(folder / "in" / f"{i}.csv", some_recording(draw, str(i)))
    (folder / "in" / "bad.csv").write_text("time_s,force_N\n1,x\n")
    mre_core.batch(folder / "in", folder / "out", model=draw.choice(list(DEVICES)), seed=1, max_iterations=3)


def refuse(draw: random.Random, folder: Path) -> None:
    """What cannot be done leaves nothing behind either."""
    short = [0.0]
    with suppress(mre_core.MreError):
        mre_core.load(folder / "none.csv")
        raise AssertionError("taken")
    with suppress(mre_core.MreError):
        mre_core.Recording(short, short, None)
        raise AssertionError("taken")


JOBS: Final[dict[str, Callable[[random.Random, Path], None]]] = {
    "identify": identify,
    "diagnose": diagnose,
    "batch": batch,
    "refuse": refuse,
}
