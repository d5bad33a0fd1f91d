"""A trial from making to opening, and everything that can be wrong with it."""

import json
import shutil
import signal
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import mre_core
import numpy as np
import pytest
from mre_core.batches import items
from mre_core.batches.journal import alone_in
from mre_core.batches.settings import Reading
from mre_core.batches.work import Task, work
from mre_core.trial import Case, make_trial, open_trial, run_trial
from rig import Cli, command, everything_in

PLAIN = Case((), (), "kelvin_voigt", 0.0, "white", "given", "rich", 2000, 0.01, 0.0, 11)
HEAVY = Case(("inertia",), ("mass",), "kelvin_voigt", 3.0, "white", "given", "rich", 4000, 0.01, 0.0, 2)
Change = Callable[[Path], object]


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, str]:
    folder = tmp_path_factory.mktemp("made") / "trial"
    return folder, make_trial(folder, [PLAIN, HEAVY], seed=9, workers=1)


@pytest.fixture(scope="module")
def done(made: tuple[Path, str], tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Run where the answers are not."""
    folder = tmp_path_factory.mktemp("done") / "trial"
    shutil.copytree(made[0], folder, ignore=shutil.ignore_patterns("answers.json"))
    assert not (folder / "answers.json").exists()
    steps: list[tuple[int, int]] = []
    assert run_trial(folder, workers=2, on_done=lambda *step: steps.append(step)) == 2
    assert steps == [(0, 2), (1, 2), (2, 2)]
    shutil.copy(made[0] / "answers.json", folder)
    return folder


@pytest.fixture
def copy(done: Path, tmp_path: Path) -> Path:
    return Path(shutil.copytree(done, tmp_path / "trial"))


def test_what_is_made(made: tuple[Path, str]) -> None:
    folder, seal = made
    assert len(seal) == 64
    public = (folder / "trial.json").read_text(encoding="utf-8")
    assert json.loads(public)["seal"] == seal
    assert "inertia" not in public
    names = everything_in(folder)
    assert {"trial.json", "answers.json", "recordings/0001/01.csv", "recordings/0002/07.csv"} <= names
    assert not [name for name in names if "sine" in name or name.startswith(".")]
    assert "inertia" not in (folder / "recordings/0002/01.csv").read_text(encoding="utf-8")
    recording = mre_core.load(folder / "recordings/0002/01.csv")
    assert recording.current_level == 1.0
    assert recording.velocity_window is None


def test_the_same_seed_makes_the_same_trial(made: tuple[Path, str], tmp_path: Path) -> None:
    folder, seal = made
    again = tmp_path / "again"
    assert make_trial(again, [PLAIN, HEAVY], seed=9, workers=2) == seal
    for name in everything_in(again):
        if (again / name).is_file():
            assert (again / name).read_bytes() == (folder / name).read_bytes()


def test_a_drawn_seed_salts_the_seal(tmp_path: Path) -> None:
    one, other = (make_trial(tmp_path / name, [PLAIN], workers=1) for name in "ab")
    assert one != other
    assert "seed" not in (tmp_path / "a" / "trial.json").read_text(encoding="utf-8")


def test_what_comes_out(copy: Path, made: tuple[Path, str], cli: Cli, tmp_path: Path) -> None:
    status, out, err = cli("trial", "open", copy, "--seal", made[1], "--tables", tmp_path / "tables")
    assert (status, err) == (0, "")
    assert made[1] in out
    assert "inertia" in out
    status, text, err = cli("trial", "open", copy, "--json")
    assert (status, err) == (0, "")
    results = json.loads(text)
    assert [case["outcome"]["kind"] for case in results["cases"]] == ["clear", "right"]
    mass = results["cases"][1]["parameters"][0]
    assert mass["found"] == pytest.approx(mass["truth"], rel=0.1)
    whole = (tmp_path / "tables" / "all.md").read_text(encoding="utf-8")
    assert "| one effect | 1 | 1 right |" in whole
    assert "| nothing | 1 | 1 clear |" in whole
    assert json.loads((copy / "results.json").read_text(encoding="utf-8")) == results
    status, out, err = cli("trial", "run", copy, "--resume")
    assert (status, out) == (2, "")
    assert "was opened" in err


def test_a_run_goes_on_where_it_stopped(copy: Path, cli: Cli) -> None:
    first = (copy / "diagnoses/0001.json").read_bytes()
    before = json.loads((copy / "diagnoses/0002.json").read_text(encoding="utf-8"))
    (copy / "diagnoses/0002.json").unlink()
    status, out, err = cli("trial", "run", copy)
    assert (status, out) == (2, "")
    assert "1 of 2 cases have a diagnosis, wanted --resume" in err
    assert cli("trial", "run", copy, "--resume", "--workers", "1") == (0, "1 case diagnosed\n", "")
    assert (copy / "diagnoses/0001.json").read_bytes() == first
    after = json.loads((copy / "diagnoses/0002.json").read_text(encoding="utf-8"))
    assert after["diagnosis"] == before["diagnosis"]


def test_a_run_that_is_stopped_says_how_it_goes_on(
    copy: Path, cli: Cli, monkeypatch: pytest.MonkeyPatch
) -> None:
    (copy / "diagnoses/0002.json").unlink()

    def stopped(*given: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("mre_core.trial.run.drive", stopped)
    status, out, err = cli("trial", "run", copy, "--resume")
    # A terminal has shown ^C: click ends that line.
    assert (status, out, err) == (130, "", "\nmre-core: interrupted: --resume goes on where it was\n")


def test_a_diagnosis_that_fails_is_an_outcome(made: tuple[Path, str], tmp_path: Path) -> None:
    folder = tmp_path / "trial"
    make_trial(folder, [PLAIN], seed=1, workers=1)
    for path in (folder / "recordings/0001").glob("*.csv"):
        path.write_text("time_s,displacement_mm,force_N\n0,1,2\n", encoding="utf-8")
    run_trial(folder, workers=1)
    assert "samples" in json.loads((folder / "diagnoses/0001.json").read_text(encoding="utf-8"))["error"]
    with pytest.raises(mre_core.InputError, match="case 0001 was diagnosed from recordings that are not"):
        open_trial(folder)


def test_cases_that_another_attempt_may_do_are_told(copy: Path, cli: Cli) -> None:
    before = json.loads((copy / "diagnoses/0002.json").read_text(encoding="utf-8"))
    for file in (copy / "diagnoses").glob("*.json"):
        file.unlink()
    with ThreadPoolExecutor(1) as executor:
        submit = executor.submit

        def broken(work: Any, tasks: list[Task], *rest: Any) -> "Future[Any]":
            return submit(divmod, 1, 0) if tasks[0].item == "0001" else submit(work, tasks, *rest)

        executor.submit = broken  # type: ignore[assignment]
        problem = (
            r"trial: 1 of 2 cases were not diagnosed \(case 0001: its worker failed: ZeroDivisionError: .*"
        )
        with pytest.raises(mre_core.InputError, match=problem + r"\), wanted --resume to try them again"):
            run_trial(copy, executor=executor)
    assert not (copy / "diagnoses/0001.json").exists()
    after = json.loads((copy / "diagnoses/0002.json").read_text(encoding="utf-8"))
    assert after["diagnosis"] == before["diagnosis"]
    with alone_in(copy / "diagnoses"):
        status, out, err = cli("trial", "run", copy, "--resume")
    assert (status, out) == (2, "")
    assert "another process is at work there, wanted its end" in err
    assert cli("trial", "run", copy, "--resume") == (0, "1 case diagnosed\n", "")


def test_seconds_are_those_of_the_diagnosis(copy: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """And every recording is read twice: for its digest, and by the worker that sees that it is still so."""
    (copy / "diagnoses/0002.json").unlink()
    clock, hashed = [0.0], []
    diagnose, load = mre_core.diagnose, Reading.load
    digest_of = items.digest_of

    def slowly(work: Callable[..., Any], seconds: float) -> Callable[..., Any]:
        def does(*given: Any, **options: Any) -> Any:
            clock[0] += seconds
            return work(*given, **options)

        return does

    def noted(path: Path) -> str:
        hashed.append(path.name)
        return digest_of(path)

    monkeypatch.setattr(time, "perf_counter", lambda: clock[0])
    monkeypatch.setattr(Reading, "load", slowly(load, 100.0))
    monkeypatch.setattr(sys.modules["mre_core.diagnose"], "diagnose", slowly(diagnose, 7.0))
    for module in ("trial.run", "trial.files", "batches.work"):
        monkeypatch.setattr(f"mre_core.{module}.digest_of", noted)
    with ThreadPoolExecutor(1) as executor:
        submit = executor.submit
        executor.submit = lambda _, tasks, *rest: submit(list, map(work, tasks))  # type: ignore[assignment]
        run_trial(copy, resume=True, executor=executor)
    said = json.loads((copy / "diagnoses/0002.json").read_text(encoding="utf-8"))
    assert said["seconds"] == 7.0
    assert Counter(hashed) == {path.name: 2 for path in (copy / "recordings/0002").iterdir()}


@pytest.mark.parametrize("what", ["run", "open"])
def test_one_at_a_time(copy: Path, cli: Cli, what: str) -> None:
    # Whatever stands in the folder of another run, it may be another thing the moment after.
    (copy / "diagnoses/0002.json").unlink()
    with alone_in(copy / "diagnoses"):
        before = everything_in(copy)
        status, out, err = cli("trial", what, copy)
        assert everything_in(copy) == before
    assert (status, out) == (2, "")
    place = copy / "diagnoses"
    assert err == f"mre-core: {place}: another process is at work there, wanted its end, or another folder\n"


def test_what_ends_while_a_run_begins_is_seen(copy: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (copy / "diagnoses/0002.json").unlink()

    @contextmanager
    def after_another(place: Path) -> Iterator[None]:
        """What had the folder ends just before it is given."""
        (copy / "results.json").touch()
        with alone_in(place):
            yield

    monkeypatch.setattr("mre_core.trial.run.alone_in", after_another)
    with pytest.raises(mre_core.InputError, match="the trial was opened"):
        run_trial(copy, resume=True, workers=1)


@pytest.mark.parametrize("left", [[], ["0001.json"]])
def test_what_is_refused_leaves_nothing(copy: Path, cli: Cli, left: list[str]) -> None:
    shutil.rmtree(copy / "recordings/0002")
    for file in (copy / "diagnoses").iterdir():
        if file.name not in left:
            file.unlink()
    if not left:
        (copy / "diagnoses").rmdir()
    before = everything_in(copy)
    for what in (["run", "--resume"], ["open"]):
        assert cli("trial", what[0], copy, *what[1:])[0] == 2
        assert everything_in(copy) == before


def edit(path: Path, old: str, new: str) -> None:
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new, 1), encoding="utf-8")


def unrun(folder: Path) -> None:
    shutil.rmtree(folder / "diagnoses")


def reseal(folder: Path) -> None:
    """Edited answers and a seal that fits them."""
    from mre_core.trial.files import seal_of

    old = seal_of(folder / "answers.json")
    edit(folder / "answers.json", '"inertia"', '"creep"')
    edit(folder / "trial.json", old, seal_of(folder / "answers.json"))


def drop_case(folder: Path) -> None:
    content = json.loads((folder / "trial.json").read_text(encoding="utf-8"))
    content["cases"].pop()
    (folder / "trial.json").write_text(json.dumps(content), encoding="utf-8")


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (unrun, "was not run: there are no diagnoses, wanted 'trial run' before 'trial open'"),
        (lambda f: (f / "diagnoses/0002.json").unlink(), "1 of 2 cases have no diagnosis: 0002"),
        (lambda f: (f / "answers.json").unlink(), "answers.json: there are no answers"),
        (lambda f: edit(f / "answers.json", '"inertia"', '"creep"'), "answers.json: the seal is broken"),
        (reseal, "trial.json: the seal is broken: trial.json states"),
        (drop_case, "cases 0002 are in one of trial.json and answers.json"),
        (lambda f: (f / "trial.json").unlink(), "holds no trial"),
        (lambda f: (f / "trial.json").write_text("{", encoding="utf-8"), "trial.json: is not JSON"),
        (lambda f: (f / "trial.json").write_text("{}", encoding="utf-8"), "schema is None"),
        (lambda f: (f / "diagnoses/0001.json").write_text("{", encoding="utf-8"), "0001.json: is not JSON"),
        (
            lambda f: edit(f / "diagnoses/0001.json", '"recordings_sha256": "', '"recordings_sha256": "0'),
            "case 0001 was diagnosed from recordings that are not those that were made",
        ),
        (lambda f: edit(f / "trial.json", "kelvin_voigt", "sinh"), "base of case 0001 is 'sinh'"),
    ],
)
def test_nothing_is_opened_that_was_tampered_with(
    copy: Path, made: tuple[Path, str], cli: Cli, change: Change, said: str
) -> None:
    change(copy)
    before = everything_in(copy)
    status, out, err = cli("trial", "open", copy, "--seal", made[1])
    assert (status, out) == (2, "")
    assert said in err
    assert err.count("\n") == 1
    assert everything_in(copy) == before


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["make", "new", "--cases", "0"], "cases is 0, wanted a whole number from 1"),
        (["make", "new", "--seed", "-1"], "seed is -1"),
        (["make", "new", "--workers", "0"], "workers is 0"),
        (["make", "."], "holds trial.json already, wanted a new folder"),
        (["run", "new"], "new: holds no trial"),
        (["open", "new"], "new: holds no trial"),
        (["open"], "Missing argument 'DIR'"),
    ],
)
def test_wrong_options(
    copy: Path, cli: Cli, monkeypatch: pytest.MonkeyPatch, arguments: list[str], said: str
) -> None:
    monkeypatch.chdir(copy)
    before = everything_in(copy)
    status, out, err = cli("trial", *arguments)
    assert (status, out) == (2, "")
    assert said in err
    assert everything_in(copy) == before


def test_without_recordings_there_is_no_run(copy: Path, cli: Cli) -> None:
    shutil.rmtree(copy / "recordings/0002")
    status, _, err = cli("trial", "run", copy, "--resume")
    assert status == 2
    assert "case 0002 has no recordings" in err


def test_a_recording_that_cannot_be_read(copy: Path, cli: Cli) -> None:
    (copy / "diagnoses/0002.json").unlink()
    odd = copy / "recordings/0002/03.csv"
    odd.unlink()
    odd.mkdir()
    status, out, err = cli("trial", "run", copy, "--resume")
    assert (status, out) == (2, "")
    assert (
        f"mre-core: {odd}: cannot be read: Is a directory, wanted recordings as 'trial make' wrote them\n"
        == err
    )


@pytest.mark.parametrize("workers", ["1", "2"])
def test_ctrl_c_leaves_whole_files(tmp_path: Path, workers: str) -> None:
    folder = tmp_path / "trial"
    slow = Case(("inertia",), ("mass",), "bouc_wen", 3.0, "white", "given", "rich", None, 0.01, 0.0, 3)
    make_trial(folder, [PLAIN, slow, slow, slow], seed=9, workers=1)
    running = subprocess.Popen(
        command("trial", "run", folder, "--workers", workers),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    limit = time.monotonic() + 100
    while not (folder / "diagnoses/0001.json").exists() and time.monotonic() < limit:
        time.sleep(0.05)
    running.send_signal(signal.SIGINT)
    out, err = running.communicate(timeout=60)
    assert running.returncode == 130, err
    assert (out, err.strip()) == ("", "mre-core: interrupted: --resume goes on where it was")
    assert {path.name for path in (folder / "diagnoses").iterdir()} <= {"batch.lock"} | {
        f"000{i}.json" for i in range(1, 5)
    }
    assert json.loads((folder / "diagnoses/0001.json").read_text(encoding="utf-8"))["case"] == "0001"


def test_numbers_of_the_files_are_those_of_the_simulator(made: tuple[Path, str]) -> None:
    truth = PLAIN.simulate().recordings[0]
    recording = mre_core.load(made[0] / "recordings/0001/01.csv")
    assert recording.force is not None
    assert np.allclose(recording.force, truth.force, rtol=1e-8, atol=1e-9)
