"""A disk on which no room is left, at any point of a command: one line, and what stood there stays."""

import os
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Self

import mre_core
import pytest
from missing import campaign, write_all
from pandas.testing import assert_frame_equal
from rig import SINH, command, made_of, motion, record, run_process, write_csv


class Disk:
    """A file system of its own, in memory."""

    def __init__(self, place: Path) -> None:
        self.place = place

    def allow(self, size: str = "8m", *, inodes: int = 1000) -> None:
        """Give it so many bytes, such as ``12k``, and so many files and folders."""
        self._mount(f"remount,size={size},nr_inodes={inodes}")

    def content(self) -> dict[str, bytes]:
        """Every file with its bytes, every folder with none."""
        found = sorted(self.place.rglob("*"))
        return {str(p.relative_to(self.place)): p.read_bytes() if p.is_file() else b"" for p in found}

    def _mount(self, options: str) -> None:
        arguments = ["mount", "-t", "tmpfs", "-o", options, "tmpfs", str(self.place)]
        run = subprocess.run(arguments, capture_output=True, text=True, check=False)
        if run.returncode:
            pytest.skip(f"no file system can be mounted here: {run.stderr.strip()}")

    def __enter__(self) -> Self:
        self.place.mkdir()
        try:
            self._mount("size=8m,nr_inodes=1000")
        except FileNotFoundError:
            pytest.skip("this system has no mount")
        return self

    def __exit__(self, *_: object) -> None:
        subprocess.run(["umount", "--lazy", str(self.place)], check=True)


@pytest.fixture
def disk(tmp_path: Path) -> Iterator[Disk]:
    with Disk(tmp_path / "disk") as mounted:
        yield mounted


def recordings(folder: Path, count: int = 3) -> Path:
    folder.mkdir(exist_ok=True)
    for i in range(count):
        write_csv(folder / f"{i}.csv", record(made_of("sinh", SINH), motion(rate=100), noise=0.1, seed=i))
    return folder


def arguments_of(name: str, folder: Path) -> list[str | Path]:
    match name:
        case "identify":
            return ["identify", recordings(folder) / "0.csv", "--model", "sinh", "--optimizer", "exact"]
        case "diagnose":
            return ["diagnose", *write_all(folder, campaign()[:2]), "--base", "sinh", "--seed", "1"]
        case "batch":
            return ["batch", recordings(folder), *"--model sinh --seed 1 --quiet --no-figures".split()]
        case "demo":
            return ["demo", "--iterations", "1"]
        case _:
            return ["study", "--quick"]


@pytest.mark.parametrize(
    ("name", "size"),
    [("identify", "8k"), ("identify", "100k"), ("diagnose", "100k"), ("demo", "400k"), ("study", "1m")],
)
def test_no_room_for_the_results(disk: Disk, tmp_path: Path, name: str, size: str) -> None:
    out = disk.place / "out"
    out.mkdir()
    (out / "model.json").write_text("old")
    disk.allow(size)
    before = disk.content()
    run = run_process(*arguments_of(name, tmp_path), "--out", out)
    assert (run.returncode, run.stdout if name != "demo" else "") == (2, "")
    wanted = f"mre-core: {out}: cannot be written: No space left on device, wanted a folder to write to"
    assert run.stderr.splitlines()[-1] == wanted
    assert "Traceback" not in run.stderr
    assert disk.content() == before


def test_no_room_for_a_folder(disk: Disk, tmp_path: Path) -> None:
    disk.allow(inodes=1)
    run = run_process(*arguments_of("identify", tmp_path), "--out", disk.place / "out")
    assert (run.returncode, run.stderr.count("\n")) == (2, 1)
    assert "out: cannot be written: No space left on device" in run.stderr
    assert disk.content() == {}


@pytest.mark.parametrize("size", ["4k", "12k", "24k", "40k"])
def test_a_batch_goes_on_when_there_is_room_again(disk: Disk, tmp_path: Path, size: str) -> None:
    batch = arguments_of("batch", tmp_path / "in")
    disk.allow(size)
    run = run_process(*batch, "--out", disk.place / "out")
    assert (run.returncode, run.stdout, run.stderr.count("\n")) == (2, "", 1), run.stderr
    assert "cannot be written" in run.stderr
    assert not [name for name in disk.content() if ".mre-core-" in name]
    disk.allow()
    for out in (disk.place / "out", tmp_path / "never_full"):
        assert run_process(*batch, "--out", out).returncode == 0
    found, wanted = (
        mre_core.read_results(place / name) for place, name in ((disk.place, "out"), (tmp_path, "never_full"))
    )
    same = [name for name in found if not str(name).endswith("time")]
    assert_frame_equal(found[same], wanted[same])
    assert (found["status"] == "done").all()


def test_a_batch_keeps_the_results_it_had(disk: Disk, tmp_path: Path) -> None:
    batch = arguments_of("batch", tmp_path / "in")
    out = disk.place / "out"
    assert run_process(*batch, "--out", out).returncode == 0
    had, files = mre_core.read_results(out), disk.content()
    recordings(tmp_path / "in", 40)
    used = sum(-(-len(content) // 4096) + 1 for content in files.values()) * 4
    disk.allow(f"{used + 12}k")
    run = run_process(*batch, "--out", out)
    assert (run.returncode, run.stdout, run.stderr.count("\n")) == (2, "", 1), run.stderr
    assert_frame_equal(mre_core.read_results(out), had)
    models = {name: content for name, content in files.items() if name.endswith(".json")}
    assert models.items() <= disk.content().items()


@pytest.mark.parametrize("unbuffered", ["", "1"])
@pytest.mark.parametrize("arguments", [[], ["--version"], ["schema"], ["identify"]])
def test_no_room_for_the_output(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, arguments: list[str], unbuffered: str
) -> None:
    full = Path("/dev/full")
    if not full.exists():
        pytest.skip("this system has no /dev/full")
    monkeypatch.setenv("PYTHONUNBUFFERED", unbuffered)
    given = arguments_of("identify", tmp_path) if arguments == ["identify"] else arguments
    with full.open("w") as nowhere:
        run = subprocess.run(command(*given), stdout=nowhere, stderr=subprocess.PIPE, text=True, check=False)
        wanted = "mre-core: the output cannot be written: No space left on device, wanted room for it\n"
        assert (run.returncode, run.stderr) == (1, wanted)
        missing = command("identify", tmp_path / "missing.csv", "--model", "sinh")
        assert subprocess.run(missing, stderr=nowhere, check=False).returncode == 2
        assert subprocess.run(command(*given), stdout=nowhere, stderr=nowhere, check=False).returncode == 1


@pytest.mark.parametrize("unbuffered", ["", "1"])
def test_nobody_reads_the_output(monkeypatch: pytest.MonkeyPatch, unbuffered: str) -> None:
    monkeypatch.setenv("PYTHONUNBUFFERED", unbuffered)
    reader, writer = os.pipe()
    os.close(reader)
    run = subprocess.run(command("schema"), stdout=writer, stderr=subprocess.PIPE, text=True, check=False)
    os.close(writer)
    assert (run.returncode, run.stderr) == (1, "")
