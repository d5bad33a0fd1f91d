"""Eight threads at once get what each gets alone; callbacks may call back; everything public is pickled."""

import pickle
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import mre_core
import numpy as np
import pytest
from mre_core import Effect, Level, MissingEffect, Model, MreError, Problem, Recording
from rig import SINH, made_of, motion, record


@pytest.fixture(scope="module")
def recording() -> Recording:
    return record(made_of("sinh", SINH), motion(rate=64.0, current=1.0), noise=0.3, seed=2)


CALLS: dict[str, Callable[[Recording, int], Any]] = {
    "hybrid": lambda r, seed: mre_core.identify(r, "bouc_wen", seed=seed, max_iterations=2),
    "exact": lambda r, seed: mre_core.identify(r, "sinh", optimizer="exact"),
    "pso": lambda r, seed: mre_core.identify(r, "sinh", optimizer="pso", seed=seed, max_iterations=5),
    "simulate": lambda r, seed: mre_core.simulate(made_of("sinh", SINH), r).tolist(),
    "loops": lambda r, seed: mre_core.loops(r)[0].to_dict(),
    "bootstrap": lambda r, seed: mre_core.bootstrap(Problem(r, "sinh"), list(SINH.values()), 5, seed=seed),
    "function": lambda r, seed: mre_core.afsa(
        lambda x: (x**2).sum(axis=1), [(-1, 1)] * 3, seed=seed, max_iterations=5
    ),
}


def bits(found: Any) -> bytes:
    return (
        pickle.dumps(found) if not isinstance(found, mre_core.Identification) else pickle.dumps(found.model)
    )


@pytest.mark.parametrize("name", CALLS)
def test_eight_threads(name: str, recording: Recording) -> None:
    call = CALLS[name]
    alone = [bits(call(recording, seed)) for seed in range(8)]
    with ThreadPoolExecutor(8) as pool:
        assert list(pool.map(lambda seed: bits(call(recording, seed)), range(8))) == alone


def test_a_callback_that_calls_back(recording: Recording) -> None:
    problem = Problem(recording, "sinh")
    inside: list[float] = []

    def callback(*_: object) -> None:
        if len(inside) < 3:
            inside.append(mre_core.pso(problem, seed=1, max_iterations=2).fitness)

    found = mre_core.pso(problem, seed=1, max_iterations=300, callback=callback)
    assert inside
    assert set(inside) == {mre_core.pso(problem, seed=1, max_iterations=2).fitness}
    assert found.fitness == mre_core.pso(problem, seed=1, max_iterations=300).fitness


def test_a_callback_without_an_end(recording: Recording) -> None:
    def callback(*_: object) -> None:
        callback()

    with pytest.raises(RecursionError):
        mre_core.mafsa(Problem(recording, "sinh"), seed=1, callback=callback)


def test_a_swarm_within_another() -> None:
    asked = mre_core.AskTell("pso", [(-1.0, 1.0)], seed=1, max_iterations=2)
    while not asked.finished:
        points = asked.ask()
        nested = mre_core.pso(lambda x: x[:, 0] ** 2, [(-1, 1)], seed=1, max_iterations=1)
        asked.tell((points**2).sum(axis=1) + 0 * nested.fitness)
    assert asked.finished


def everything(recording: Recording) -> dict[str, Any]:
    """An object of every public class that holds data."""
    found = mre_core.identify(recording, "sinh", optimizer="exact")
    problem = found.problems[0]
    effect = Effect("inertia", "moving mass", {"m": 3.0})
    sizes = dict.fromkeys(
        ("displacement", "velocity", "force", "step", "duration", "total", "path", "energy"), 1.0
    )
    recordings = [
        record(made_of("sinh", SINH), motion(rate=64.0, current=i), noise=0.3, seed=int(i))
        for i in (0.0, 1.0, 2.0)
    ]
    laws = mre_core.fit_laws(recordings, "kelvin_voigt")
    x = found.result.x
    uncertainty = mre_core.uncertainty(problem, x)
    [loops] = mre_core.loops(recording)
    objects = [
        *(recording, problem, found, found.model, found.fits[0], found.result, found.result.parameters[0]),
        *(effect, Model("sinh", (Level(0.0, SINH),), {}, (effect,), sizes), Level(0.0, SINH)),
        *(laws, next(iter(laws.model.laws.values())), next(iter(laws.model.laws.values())).law),
        *(uncertainty, uncertainty.parameters[0], mre_core.profile(problem, x)[0]),
        *(mre_core.bootstrap(problem, x, 3, seed=1), mre_core.certificate(problem, found.result)),
        *(loops, loops.measured[0], found.result.reason, mre_core.diagnose(recordings, "sinh", seed=1)),
        MissingEffect(
            "inertia", "moving mass", "a", "b", "c", {}, 0.0, "exact", 0.0, (), (), {}, (), 2.0, 1.0
        ),
        *(mre_core.InputError("a", file="f", line=3, wanted="b"), MreError("a")),
        *(
            mre_core.UnitAssumedWarning("a"),
            mre_core.SkippedWarning("a"),
            mre_core.CopyWarning("a"),
            mre_core.ExtrapolationWarning("a"),
            mre_core.VelocityWarning("a"),
        ),
    ]
    return {type(one).__name__: one for one in objects}


STATES = {"AskTell", "Inspection"}
"""A run under way has its state in the core; an inspection is tested below."""


def test_everything_public_is_pickled(recording: Recording, tmp_path: Any) -> None:
    found = everything(recording)
    (tmp_path / "a.csv").write_text(
        "time_s,displacement_mm,force_N\n" + "".join(f"{i},{np.sin(i)},{np.cos(i)}\n" for i in range(40))
    )
    found["Inspection"] = mre_core.inspect(tmp_path / "a.csv")
    classes = {name for name in mre_core.__all__ if isinstance(getattr(mre_core, name), type)}
    assert classes - {"AskTell"} <= set(found), classes - set(found)
    for name, one in found.items():
        copy = pickle.loads(pickle.dumps(one))
        assert type(copy) is type(one), name
        assert (str(copy), repr(copy)) == (str(one), repr(one)), name
        # All of it: what is pickled again is the same.
        assert pickle.dumps(pickle.loads(pickle.dumps(copy))) == pickle.dumps(copy), name
    assert pickle.loads(pickle.dumps(found["InputError"])).line == 3
