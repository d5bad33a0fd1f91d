"""Stop a command once, and look at what is left."""

import json
import os
import signal
import subprocess
import time
import tomllib
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import pandas as pd
from rig import command

SIGNALS = (signal.SIGINT, signal.SIGTERM)
_MARK = "MRE_CORE_MOMENT"
# A process that a shell has put in the background ignores Ctrl-C.
_READY = """
import pathlib, signal
import mre_core.cli.main
signal.signal(signal.SIGINT, signal.default_int_handler)
pathlib.Path("ready").touch()
"""


class Stopped(NamedTuple):
    status: int
    said: str
    seconds: float
    """From the signal to the end."""


def stop(arguments: Sequence[str], folder: Path, moment: float, number: signal.Signals) -> Stopped:
    """Run a command in a folder, and send a signal some seconds after it has begun."""
    job = subprocess.Popen(
        command(*arguments, before=_READY),
        cwd=folder,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        env=os.environ | {_MARK: str(folder)},
    )
    try:
        while job.poll() is None and not (folder / "ready").exists():
            time.sleep(0.01)
        time.sleep(moment)
        sent = time.monotonic()
        job.send_signal(number)
        _, said = job.communicate(timeout=60)
        return Stopped(job.returncode, said, time.monotonic() - sent)
    finally:
        job.kill()
        (folder / "ready").unlink(missing_ok=True)


def check(found: Stopped, folder: Path) -> None:
    """Nothing but whole files is left, and nobody at work."""
    # Zero, or the signal itself, where all was done before it came.
    assert found.status in {130, 0, *(-number for number in SIGNALS)}, found
    assert "Traceback" not in found.said, found
    if found.status == 130:
        # On a terminal the line of ^C ends first.
        assert all(line.startswith("mre-core: interrupted") for line in found.said.splitlines()[-1:]), found
    for path in sorted(folder.rglob("*")):
        assert not path.name.startswith(".mre-core-"), path
        if path.is_file():
            _whole(path)
    end = time.monotonic() + 20
    while left := at_work(folder):
        assert time.monotonic() < end, left
        time.sleep(0.05)


def _whole(path: Path) -> None:
    match path.suffix:
        case ".json":
            json.loads(path.read_text(encoding="utf-8"))
        case ".toml":
            tomllib.loads(path.read_text(encoding="utf-8"))
        case ".parquet":
            pd.read_parquet(path)
        case ".html":
            assert path.read_text(encoding="utf-8").rstrip().endswith("</html>")
        case ".png":
            assert path.read_bytes()[-8:-4] == b"IEND"
        case ".svg":
            assert path.read_text(encoding="utf-8").rstrip().endswith("</svg>")
        case ".csv":
            assert path.read_bytes().endswith(b"\n")


def at_work(folder: Path) -> list[str]:
    """Processes that a command in the folder has started; empty where the system does not tell."""
    mark = f"{_MARK}={folder}".encode()
    found = []
    for process in Path("/proc").glob("[0-9]*"):
        try:
            if mark in (process / "environ").read_bytes().split(b"\0"):
                found.append((process / "cmdline").read_bytes().decode(errors="replace"))
        except OSError:  # it has ended, or is none of ours
            continue
    return found
