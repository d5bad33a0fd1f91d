"""Samples that pass by once: the same as in memory."""

import pickle
from collections.abc import Iterator
from pathlib import Path

import mre_core
import numpy as np
import pytest
from mre_core import InputError, MreError, Problem, Recording, UnitAssumedWarning, read_chunks
from numpy.typing import NDArray
from rig import SINH, force_of, made_of, motion, record

Chunk = tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]


@pytest.fixture(scope="module")
def recording() -> Recording:
    return record(made_of("sinh", SINH), motion(cycles=20.0), noise=0.5, seed=3)


def series(recording: Recording) -> Chunk:
    return recording.displacement, recording.velocity, force_of(recording)


def cut(recording: Recording, size: int) -> Iterator[Chunk]:
    for first in range(0, len(recording), size):
        displacement, velocity, force = (values[first : first + size] for values in series(recording))
        yield displacement, velocity, force


def farthest(recording: Recording) -> float:
    return float(np.abs(recording.displacement).max())


def same(streamed: Problem, whole: Problem) -> None:
    np.testing.assert_allclose(streamed.lower, whole.lower, rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(streamed.upper, whole.upper, rtol=1e-12)
    rng = np.random.default_rng(1)
    rows = whole.lower + rng.random((200, 5)) * (whole.upper - whole.lower)
    np.testing.assert_allclose(streamed.fitness(rows), whole.fitness(rows), rtol=1e-12)


def test_streamed_equals_in_memory(recording: Recording) -> None:
    whole = Problem(recording)
    streamed = Problem.streamed(cut(recording, 777), farthest(recording))
    same(streamed, whole)
    assert streamed.names == whole.names
    assert streamed.recordings == []
    assert repr(streamed) == f"Problem(sinh, {len(recording)} samples streamed)"
    best = mre_core.exact(whole)
    found = mre_core.exact(streamed)
    assert found.fun == pytest.approx(best.fun, rel=1e-12)
    np.testing.assert_allclose(found.x, best.x, rtol=1e-6)
    assert mre_core.certificate(streamed, found).certified
    for search in (mre_core.hybrid, mre_core.pso, mre_core.mafsa):
        run = search(streamed, seed=1, max_iterations=15)
        assert best.fun * (1 - 1e-12) <= run.fun
        assert run.fun == pytest.approx(whole.fitness(run.x), rel=1e-12)
    assert mre_core.hybrid(streamed, seed=1).fun <= best.fun * (1 + 1e-9)


def test_bounds_are_taken(recording: Recording) -> None:
    bounds = {"beta": (0.01, 2.0), "k0": (1.0, 9.0)}
    same(
        Problem.streamed(cut(recording, 500), farthest(recording), bounds), Problem(recording, bounds=bounds)
    )


@pytest.mark.parametrize("threads", [1, 3])
def test_neither_cuts_nor_threads_matter(recording: Recording, threads: int) -> None:
    whole = Problem.streamed([series(recording)], farthest(recording))
    rows = whole.lower + np.random.default_rng(2).random((50, 5)) * (whole.upper - whole.lower)
    parts = Problem.streamed(cut(recording, 91), farthest(recording), threads=threads)
    assert parts.fitness(rows).tobytes() == whole.fitness(rows).tobytes()


def test_recordings_one_by_one(recording: Recording) -> None:
    scored = [recording.cut(None, 4.0).exclude("start_transient"), recording.cut(4.0)]
    most = max(farthest(part) for part in scored)
    streamed = Problem.streamed((part for part in scored), most)
    np.testing.assert_allclose(
        streamed.fitness([1.0, 10.0, 5.0, 0.2, 0.0]),
        Problem(scored).fitness([1.0, 10.0, 5.0, 0.2, 0.0]),
        1e-12,
    )


def test_a_file_chunk_by_chunk(tmp_path: Path, recording: Recording) -> None:
    file = tmp_path / "long.csv"
    rows = zip(recording.time, *series(recording), strict=True)
    text = "\n".join(f"{t!r},{x / 1e3!r},{v!r},{f!r}" for t, x, v, f in ((*map(float, row),) for row in rows))
    file.write_text(f"# from a rig\ntime_s,displacement_m,velocity_mm_s,force_N\n{text}\n")
    chunks = list(read_chunks(file, rows=1000))
    assert [len(chunk[0]) for chunk in chunks[:-1]] == [1000] * (len(recording) // 1000)
    whole = mre_core.load(file)
    same(Problem.streamed(chunks, farthest(whole)), Problem(whole))
    with file.open("a") as more:
        more.write("99,1,soft,1\n")
    place = rf"long\.csv: line {len(recording) + 3}, column 'velocity_mm_s': .*'soft'"
    with pytest.raises(InputError, match=place):
        Problem.streamed(read_chunks(file, rows=1000), 100.0)


def test_wrong_files_are_named(tmp_path: Path) -> None:
    def text(content: str | bytes, rows: int = 10) -> str:
        file = tmp_path / "a.csv"
        file.write_bytes(content.encode() if isinstance(content, str) else content)
        with pytest.raises(InputError) as caught:
            list(read_chunks(file, rows=rows))
        return str(caught.value)

    assert "no column for velocity" in text("time_s,displacement_mm,force_N\n0,1,2\n")
    assert "no column for force" in text("time_s,displacement_mm,velocity_mm_s\n0,1,2\n")
    assert "no rows of numbers" in text("\n# only this\n")
    assert "0xff is not UTF-8" in text(b"time_s,displacement_mm,velocity_mm_s,force_N\n0,1,2,\xff\n")
    assert "rows is 0" in text("x", rows=0)
    with pytest.raises(InputError, match="cannot be read: No such file"):
        list(read_chunks(tmp_path / "none.csv"))
    (tmp_path / "a.csv").write_text("time_s,displacement_mm,velocity,force_N\n0,1,2,3\n")
    with pytest.warns(UnitAssumedWarning, match="velocity"):
        assert len(list(read_chunks(tmp_path / "a.csv"))) == 1


def test_wrong_streams_are_named(recording: Recording) -> None:
    most = farthest(recording)
    x, v, f = series(recording)
    bad = v.copy()
    bad[5] = np.nan
    cases = [
        (
            [(x, v, f)],
            0.0,
            None,
            "^largest_displacement is 0.0: a positive number of mm, from 1e-30 to",
        ),
        ([(x, v, f)], -1.0, None, "^largest_displacement is -1.0: "),
        ([(x, v, f)], 0.5 * most, None, "^chunk 0: displacement at sample .*: within the largest_displ"),
        ([(x, v, f), (x, bad, f)], most, None, "^chunk 1: velocity is NaN at sample 5: "),
        ([(x, v, f[1:])], most, None, "^chunk 0: number of samples of force is "),
        ([x], most, None, r"^chunk is ndarray: a Recording, or a tuple \(displacement, velocity, force\)$"),
        ([], most, None, "^0 samples: at least 8 are needed$"),
        ([(x, v, 0 * f)], most, None, "^the force is zero throughout"),
        ([(x, v, f)], most, {"beta": (0.1, 26 / most)}, "^upper bound of beta is .*: at most .* 1/mm: "),
        ([(x, v, f)], most, {"beta": (0.1, 701 / most)}, "^bound of beta is .* above which sinh overflows"),
        ([(x, v, f)], most, {"gamma": (0.1, 1.0)}, "^parameter in bounds is 'gamma'"),
        ([record(made_of("sinh", SINH), motion(), name="a"), motion()], 99.0, None, "no force: an identif"),
    ]
    for chunks, largest, bounds, wanted in cases:
        with pytest.raises(MreError, match=wanted):
            Problem.streamed(chunks, largest, bounds)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="keeps no samples: it cannot be pickled"):
        pickle.dumps(Problem.streamed([(x, v, f)], most))
    beyond = Problem.streamed([(x, v, f)], most)
    assert beyond.fitness([1.0, 1.0, 1.0, 1.01 * beyond.upper[3], 0.0]) == np.inf


def test_no_uncertainty_without_samples(recording: Recording) -> None:
    streamed = Problem.streamed(cut(recording, 777), farthest(recording))
    found = mre_core.hybrid(streamed, seed=1, max_iterations=5)
    assert found.uncertainty is None
    assert [line.split()[0] for line in str(found).splitlines()[1:6]] == streamed.names
    wanted = (
        f"^problem is {len(recording)} samples streamed, none of which is kept:"
        " an uncertainty needs a problem of recordings$"
    )
    with pytest.raises(MreError, match=wanted):
        mre_core.uncertainty(streamed, found.x)
    with pytest.raises(MreError, match=wanted):
        mre_core.profile(streamed, found.x)
    with pytest.raises(MreError, match=wanted):
        mre_core.bootstrap(streamed, found.x, 10, seed=1)
    assert mre_core.uncertainty(Problem(recording), found.x).parameters
