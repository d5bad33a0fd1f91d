"""Texts that hold half of a character, as those of Python may: nothing can write them."""

from collections.abc import Callable

import mre_core
import numpy as np
from mre_core.trial import make_trial

from .arrays import SERIES
from .jobs import batch
from .made import Call

HALF = "\ud800"
FRAME = {"time_s": SERIES["time"], "displacement_mm": SERIES["displacement"], "force_N": SERIES["force"]}


class Frame(dict[str, object]):
    """Columns by name, as a data frame has them."""

    columns = tuple(FRAME)


def half(call: Callable[[], object], *says: str) -> Call:
    return Call(call, says, mre_core.InputError)


def problem() -> object:
    return mre_core.Problem(mre_core.Recording(**SERIES), model=HALF)


def swarm() -> object:
    return mre_core.pso(lambda points: np.sum(points**2, axis=1), {HALF: (0, 1)})


HALVES = {
    "load_all: a path": half(lambda: mre_core.load_all(HALF), "?: its name is no text"),
    "inspect: a path": half(lambda: mre_core.inspect(HALF), "?: its name is no text"),
    "read_chunks: a path": half(lambda: list(mre_core.read_chunks(HALF)), "?: its name is no text"),
    "from_dataframe: a name": half(
        lambda: mre_core.from_dataframe(Frame(FRAME), name=HALF), "name is '?'", "half of a character"
    ),
    "Recording: a name": Call(
        lambda: mre_core.Recording(**SERIES, name=HALF), ("'name'", "half of a character"), TypeError
    ),
    "Problem: a model": Call(problem, ("'model'", "half of a character"), TypeError),
    "batch: what to exclude": half(lambda: batch(exclude=HALF), "exclude is '?'", "half of a character"),
    "swarm: a name of bounds": half(swarm, "a name of bounds is '?'", "half of a character"),
    "effect: an id": half(lambda: mre_core.Effect(HALF, "x", {}), "id or law of an effect is '?'"),
    "effect: a law": half(lambda: mre_core.Effect("inertia", HALF, {}), "id or law of an effect is '?'"),
    "trial: made in a folder": half(lambda: make_trial(HALF, 1), "?: its name holds half of a character"),
}
