"""Parts of the study: its tests, its devices, its statistics, and campaigns of one's own."""

import math
import threading
from collections.abc import Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from typing import Any

import mre_core
import numpy as np
import pytest
from mre_core import InputError, MreError, Problem, Recording
from mre_core.cli.demo import _identify_all
from mre_core.crew import Crew
from mre_core.replica import CAMPAIGN
from mre_core.study import Claim, Effort, Section, Study, Table, page, study
from mre_core.study.campaign import as_campaign, replica
from mre_core.study.classical_search import classical_pso
from mre_core.study.swarm_runs import (
    best_known,
    curve_by_evaluations,
    curve_by_iteration,
    lower_share,
    seeds,
    summarise,
)
from mre_core.study.truths import truths
from reference.models import Motion, classical_bouc_wen, pieces
from rig import BOUC_WEN, SINH, force_of, made_of, motion, record

TINY = Effort(seeds=2, bouc_wen_seeds=1, bouc_wen_iterations=2)


def bowl(points: Any) -> Any:
    return 0.5 + (points**2 * [1.0, 3.0]).sum(axis=1)


def runs(first: int = 1, **options: Any) -> list[Any]:
    box = [(-1.0, 2.0), (-1.0, 2.0)]
    return [
        mre_core.pso(bowl, box, seed=s, n_particles=6, max_iterations=9, **options) for s in seeds(first, 5)
    ]


def test_ranks_of_the_replica_are_the_papers_choices() -> None:
    campaign = replica(1)
    assert [case.name for case in campaign.cases] == [condition.name for condition in CAMPAIGN]
    assert campaign.smallest.name == "0A-1Hz-2mm"
    assert [case.name for case in campaign.by_amplitude] == ["3A-1Hz-2mm", "3A-1Hz-4mm", "3A-1Hz-8mm"]
    assert [case.name for case in campaign.by_current] == [f"{i}A-1Hz-4mm" for i in range(4)]
    assert campaign.searched.name == "1A-1Hz-4mm"


def test_ranks_of_any_campaign() -> None:
    def at(current: float, amplitude: float) -> Recording:
        return record(
            made_of("sinh", SINH), motion(amplitude, current=current), name=f"{current}-{amplitude}"
        )

    shuffled = as_campaign([at(2.0, 5.0), at(0.5, 5.05), at(0.5, 1.0), at(2.01, 1.02)])
    assert shuffled.currents == pytest.approx([0.5, 2.005])
    assert shuffled.amplitudes == pytest.approx([1.0, 5.0], rel=0.03)
    assert shuffled.smallest.name == "0.5-1.0"
    assert [case.name for case in shuffled.by_amplitude] == ["2.01-1.02", "2.0-5.0"]
    assert [case.name for case in shuffled.by_current] == ["0.5-5.05", "2.0-5.0"]
    assert shuffled.searched.name == "2.0-5.0"
    alone = as_campaign([at(1.0, 3.0)])
    assert alone.smallest is alone.searched is alone.by_amplitude[0] is alone.by_current[0]


def test_recordings_of_the_same_name_are_told_apart() -> None:
    one = record(made_of("sinh", SINH), motion(4.0), name="run")
    nameless = record(made_of("sinh", SINH), motion(2.0), name="")
    campaign = as_campaign([one, nameless, record(made_of("sinh", SINH), motion(8.0), name="run")])
    assert sorted(case.name for case in campaign.cases) == ["recording", "run", "run (2)"]
    assert next(case for case in campaign.cases if case.name == "run (2)").amplitude == 8.0


T = np.arange(200) / 100
X, F = 4 * np.sin(6 * T), 20 * np.sin(6 * T + 0.2)


def given(x: Any = X, force: Any = F, **options: Any) -> Recording:
    return Recording(T[: len(x)], x, force, **options)


REFUSED: dict[str, tuple[list[Recording], list[str]]] = {
    "none": ([], ["empty list", "at least one recording"]),
    "no force": ([given(force=None, name="a")], ["recording 'a' has no force", "wanted a force"]),
    "current changes": ([given(current=T, name="a")], ["'a' has a current that changes", "one constant"]),
    "constant force": (
        [given(force=np.full(200, 7.0), name="a")],
        ["force of recording 'a' is 7", "changes"],
    ),
    "too short": (
        [given(x=np.sin(T[:12]), force=np.cos(T[:12]), name="a")],
        ["'a' has 12 samples", "at least 20"],
    ),
    "some currents": ([given(current=1.0, name="a"), given(name="b")], ["'b' has no current", "for all"]),
}


@pytest.mark.parametrize("name", REFUSED)
def test_recordings_that_cannot_be_studied(name: str) -> None:
    recordings, pieces = REFUSED[name]
    with pytest.raises(MreError) as caught:
        study(recordings, seed=1, effort=TINY)
    assert "\n" not in str(caught.value)
    for piece in pieces:
        assert piece in str(caught.value)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"seed": -1}, r"seed is -1: |seed is -1, wanted a whole number"),
        ({"threads": 0}, "threads is 0, wanted a whole number from 1"),
    ],
)
def test_options_that_cannot_be_used(options: dict[str, Any], message: str) -> None:
    with pytest.raises(InputError, match=message):
        study(**options)


@pytest.mark.parametrize("name", ["seeds", "bouc_wen_seeds", "bouc_wen_iterations"])
def test_no_effort(name: str) -> None:
    with pytest.raises(InputError, match=f"{name} is 0, wanted a whole number from 1"):
        Effort(**{"seeds": 1, "bouc_wen_seeds": 1, "bouc_wen_iterations": 1} | {name: 0})


def test_devices_are_near_the_papers_peaks_and_from_rest() -> None:
    table = {"2": (11.0, 47.8, 94.7, 130), "4": (19.9, 81.5, 149, 204), "8": (37.4, 148, 259, 341)}
    for campaign in truths(1).values():
        assert len(campaign.cases) == 12
        for case in campaign.cases:
            force = force_of(case.recording)
            start = case.recording.scored[0]
            expected = table[f"{case.amplitude:g}"][round(case.current or 0)]
            assert np.abs(force[start:]).max() == pytest.approx(expected, rel=0.25)
            assert abs(force[0]) < 4 * max(0.2, 0.005 * expected)
            assert 0.5 < case.recording.time[start] < 1.5


def test_the_sinh_device_is_the_replicas() -> None:
    for case, condition in zip(truths(1)["sinh model"].cases, CAMPAIGN, strict=True):
        x, v = case.recording.displacement, case.recording.velocity
        force = condition.c0 * v + condition.k0 * x + condition.alpha * np.sinh(0.302 * x) + 0.001
        noise = max(0.2, 0.005 * np.abs(force).max())
        left = np.std((force_of(case.recording) - force)[slice(*case.recording.scored)])
        assert left == pytest.approx(noise, rel=0.25)


def test_noise_is_the_same_for_all_devices_and_another_for_another_seed() -> None:
    first, again, other = truths(3), truths(3), truths(4)
    shown = [
        [case.recording.displacement for case in campaign.cases]
        for campaign in (*first.values(), *again.values())
    ]
    for displacements in shown[1:]:
        np.testing.assert_array_equal(displacements, shown[0])
    assert not np.array_equal(other["sinh model"].cases[0].recording.displacement, shown[0][0])


def test_eq_1_and_2_as_written_against_their_twin() -> None:
    moved = motion(2.0, rate=500, cycles=2)
    problem = Problem(record(made_of("bouc_wen", BOUC_WEN), moved, noise=0.3, seed=1), "bouc_wen")
    for seed in (1, 2, 3):
        run = classical_pso(problem, seed=seed, max_iterations=15)
        p = run.values
        assert list(p) == ["k0", "c0", "alpha", "A", "beta", "gamma", "n", "F0"]
        assert abs(p["gamma"]) <= p["beta"]
        five = (p["k0"], p["alpha"], p["A"], p["beta"], p["gamma"])
        sine = Motion(moved.time, moved.displacement, moved.velocity)
        force = classical_bouc_wen(five, p["n"], p["c0"], [8] * len(pieces(sine)), sine) + p["F0"]
        error = force - force_of(problem.recordings[0])
        assert np.mean(error**2) == pytest.approx(run.fitness, rel=1e-3)


def test_a_summary_against_its_definitions() -> None:
    made = runs()
    found = summarise(made, 0.5)
    final = np.array([run.fitness for run in made])
    assert found["runs"] == 5
    assert found["fitness"] == {
        "smallest": final.min(),
        "lower": np.quantile(final, 0.1),
        "median": np.median(final),
        "upper": np.quantile(final, 0.9),
        "largest": final.max(),
    }
    assert found["gap"]["largest"] == pytest.approx(final.max() / 0.5 - 1)
    assert found["found"] == np.mean(final <= 0.505)
    assert found["evaluations"]["median"] == 60
    best = [run.history["best"] for run in made]
    levels = {
        "settled": [b[-1] + 0.05 * (b[0] - b[-1]) for b in best],
        "converged": [1.01 * b[-1] for b in best],
    }
    for name, level in levels.items():
        when = [next(i for i, y in enumerate(b) if y <= end) for b, end in zip(best, level, strict=True)]
        assert found[name]["iteration"]["median"] == np.median(when)
        assert found[name]["evaluations"]["median"] == np.median([6 * (i + 1) for i in when])


def test_curves() -> None:
    made = runs()
    best = np.array([run.history["best"] for run in made])
    by_iteration = curve_by_iteration(made)
    assert by_iteration["iteration"] == [float(i) for i in range(10)]
    np.testing.assert_array_equal(by_iteration["median"], np.median(best, axis=0))
    by_evaluations = curve_by_evaluations(made)
    for at, median in zip(by_evaluations["evaluations"], by_evaluations["median"], strict=True):
        # Six particles: after 6 i evaluations and before 6 (i + 1) iteration i - 1 is known.
        assert median == np.median(best[:, int((at + 0.5) // 6) - 1])


def test_pairs_of_runs() -> None:
    one, other = runs(), runs(first=101)
    wins = [(a.fitness < b.fitness) + 0.5 * (a.fitness == b.fitness) for a in one for b in other]
    assert lower_share(one, other) == pytest.approx(np.mean(wins))
    assert lower_share(one, one) == 0.5


def test_a_perfect_fit_leaves_rounding() -> None:
    clean = record(made_of("sinh", SINH), motion())
    power = np.mean(force_of(clean) ** 2)
    assert best_known(Problem(clean, "sinh")) == pytest.approx(1e-12 * power, rel=1e-9)


def test_seeds_follow_each_other() -> None:
    assert seeds(7, 3) == [7, 8, 9]
    assert seeds(2**64 - 1, 2) == [2**64 - 1, 0]


def test_a_crew_keeps_the_order_and_tells_how_far_it_is() -> None:
    told: list[tuple[str, int, int]] = []
    crew = Crew(3, lambda *progress: told.append(progress))
    gate = threading.Event()

    def work(i: int) -> int:
        if i == 0:
            gate.wait(10)  # the first to begin is the last to end
        elif i == 4:
            gate.set()
        return i * i

    assert crew.run("squares", work, range(5)) == [0, 1, 4, 9, 16]
    assert told == [("squares", done, 5) for done in range(6)]


@pytest.mark.parametrize("error", [RuntimeError, KeyboardInterrupt])
def test_a_crew_stops_all_jobs_with_one(error: type[BaseException]) -> None:
    crew = Crew(2)
    done: list[int] = []

    def work(i: int) -> None:
        if i == 0:
            raise error
        endless = mre_core.pso(bowl, [(-1.0, 1.0)] * 2, max_iterations=10**6, seed=1, **crew.options)
        assert endless.reason == "callback"
        done.append(i)

    with pytest.raises(error):
        crew.run("jobs", work, range(50))
    assert len(done) < 10  # those that had begun end; the others do not begin


@pytest.mark.parametrize("run", ["crew", "demo"])
def test_an_interruption_while_jobs_are_handed_out_stops_those_at_work(
    run: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    submit = ThreadPoolExecutor.submit
    futures: list[Future[Any]] = []

    def interrupted(self: ThreadPoolExecutor, *job: Any) -> Future[Any]:
        if len(futures) == 2:
            raise KeyboardInterrupt
        futures.append(submit(self, *job))
        return futures[-1]

    monkeypatch.setattr(ThreadPoolExecutor, "submit", interrupted)

    def endless(i: int) -> None:
        mre_core.pso(bowl, [(-1.0, 1.0)] * 2, max_iterations=10**6, seed=1, **crew.options)

    crew = Crew(2)
    with pytest.raises(KeyboardInterrupt):
        if run == "crew":
            crew.run("jobs", endless, range(50))
        else:
            _identify_all(own(), seed=1, iterations=10**6, threads=2, quiet=False)
    assert all(future.done() for future in futures)


def own() -> list[Recording]:
    model = made_of("bouc_wen", BOUC_WEN)
    return [
        record(model, motion(a, rate=100, cycles=2, current=i), noise=0.3, seed=k, name=f"<b>{i} A & {a} mm")
        for k, (i, a) in enumerate([(0.0, 2.0), (0.0, 4.0), (1.5, 2.0), (1.5, 4.0)])
    ]


def leaves(content: Any) -> Sequence[Any]:
    if isinstance(content, dict | list):
        rows = content.values() if isinstance(content, dict) else content
        return [leaf for row in rows for leaf in leaves(row)]
    return [content]


@pytest.fixture(scope="module")
def own_study() -> Study:
    return study(own(), seed=5, effort=TINY, threads=2)


def test_a_campaign_of_ones_own(own_study: Study) -> None:
    found = own_study.to_dict()
    assert found["tests"] == [r.name for r in own()]
    assert "not the paper's" in found["note"]
    assert list(found["sections"]["figure11"]["devices"]) == ["as recorded"]
    rows = found["sections"]["figure11"]["devices"]["as recorded"]
    assert [(row["current_A"], row["amplitude_mm"]) for row in rows] == [(0, 2), (0, 4), (1.5, 2), (1.5, 4)]
    for row in rows:
        assert row["bouc_wen"]["best"] == pytest.approx(0.3, rel=0.15)  # the truth, down to its noise
    # The paper's values are those of another device.
    assert all(p["paper"] is None for p in found["sections"]["table2"]["parameters"].values())
    assert "Table 2 " not in next(c["because"] for c in found["claims"] if c["section"] == "table2")
    assert not any("replica" in claim["because"] for claim in found["claims"])
    assert all(math.isfinite(leaf) for leaf in leaves(found) if isinstance(leaf, float))


def test_same_seed_same_study_for_any_number_of_threads(own_study: Study) -> None:
    again = study(own(), seed=5, effort=TINY, threads=1)
    assert again.to_dict() == own_study.to_dict()
    assert own_study.times()["figure12"] != again.times()["figure12"]  # apart, because they differ


def test_names_are_escaped_in_the_page(own_study: Study) -> None:
    text = page(own_study)
    assert "<b>1.5 A" not in text
    assert "&lt;b&gt;1.5 A &amp; 4.0 mm" in text


def test_whatever_a_section_says_is_escaped() -> None:
    evil = "<script>&\"'"
    section = Section(
        name="x",
        title=evil,
        data={},
        figures={},
        tables=(Table(evil, (evil,), ((evil,),)),),
        claims=(Claim(evil, "depends", evil),),
        notes=(evil,),
    )
    text = page(Study(evil, 1, TINY, (), (section,)))
    assert "<script" not in text
    assert text.count("&lt;script&gt;&amp;&#34;&#39;") == 8


def test_recordings_without_currents() -> None:
    plain = [record(made_of("sinh", SINH), motion(a, rate=100), noise=0.3, name=f"{a}") for a in (2.0, 4.0)]
    found = study(plain, seed=1, effort=TINY).to_dict()
    rows = found["sections"]["figure11"]["devices"]["as recorded"]
    assert [row["current_A"] for row in rows] == [None, None]
