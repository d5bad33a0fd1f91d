"""Input and options of the other commands that cannot be."""

import json
import os
from collections.abc import Mapping
from typing import Any

from rig import HEADER

from .made import Command, instead

GOOD_FILE = instead(1, HEADER)
INSPECT = ["inspect", "a.csv"]
LOOPS = ["loops", "a.csv", "--out", "new"]
LAWS = ["laws", "a.csv", "--model", "sinh", "--out", "new"]
BATCH = ["batch", "d", "--model", "sinh", "--out", "new"]
DIAGNOSE = ["diagnose", "a.csv", "--base", "sinh", "--out", "new"]
NEXT = ["next-test", "d", "--out", "c.csv"]
MAKE = ["trial", "make", "new", "--cases", "1", "--seed", "1"]
IN_BATCH: Mapping[str, bytes] = {"d/a.csv": GOOD_FILE}

LIMITS = {
    "stroke_mm": 4,
    "speed_mm_s": 90,
    "highest_hz": 10,
    "duration_s": 8,
    "rate_hz": 200,
    "current_A": None,
}


def batch(*says: str, given: list[str]) -> Command:
    return Command([*BATCH, *given], says, IN_BATCH)


def proposal(*says: str, **changed: Any) -> Command:
    """A diagnosis of a stranger whose proposal has other entries."""
    limits = LIMITS | changed
    test = {"excitation": limits.pop("excitation", "slow_sine"), "limits": limits}
    return Command(NEXT, says, {"d/diagnosis.json": json.dumps({"next_test": test}).encode()})


CAMPAIGNS = {
    "inspect: no file": Command(["inspect", "b.csv"], ["b.csv: there is no such file", "nearest: a.csv"]),
    "inspect: an empty folder": Command(
        ["inspect", "d"], ["d: is a folder without recordings"], {"d/x.foo": b""}
    ),
    "inspect: an encoding of nobody": Command([*INSPECT, "--read", "encoding=klingon"], ["'klingon'"]),
    "inspect: a header before the file": Command([*INSPECT, "--read", "header=-3"], ["-3"]),
    "inspect: a separator of two characters": Command([*INSPECT, "--read", "separator=ab"], ["'ab'"]),
    "inspect: a decimal mark of letters": Command([*INSPECT, "--read", "decimal=x"], ["'x'"]),
    "inspect: no samples a second": Command([*INSPECT, "--read", "rate=0"], ["rate"]),
    "inspect: NaN samples a second": Command([*INSPECT, "--read", "rate=nan"], ["rate", "nan"]),
    "inspect: a table that is not there": Command([*INSPECT, "--read", "table=nope"], ["'nope'"]),
    "inspect: settings in place of a folder": Command(
        [*INSPECT, "--write-config", "."], ["is there already"]
    ),
    "inspect: settings under a file": Command(
        [*INSPECT, "--write-config", "a.csv/x.toml"], ["a.csv", "cannot be written"]
    ),
    "loops: no such convention": Command([*LOOPS, "--convention", "x"], ["'x'", "peak_force"]),
    "loops: a model that is a recording": Command([*LOOPS, "--model", "a.csv"], ["a.csv: is not JSON"]),
    "loops: no model": Command([*LOOPS, "--model", "no.json"], ["no.json: cannot be read"]),
    "loops: no closed cycle": Command(LOOPS, ["recording 'a' has no closed cycle", "a motion that repeats"]),
    "laws: a law of nobody": Command([*LAWS, "--law", "alpha=x"], ["law of alpha is 'x'", "saturating"]),
    "laws: a law of no parameter": Command([*LAWS, "--law", "x=linear"], ["'x'", "alpha"]),
    "laws: a law without a name": Command([*LAWS, "--law", "alpha"], ["--law alpha"]),
    "laws: no such parameter is shared": Command([*LAWS, "--shared", "x"], ["'x'", "alpha"]),
    "laws: over something else": Command([*LAWS, "--over", "x"], ["'x'", "temperature"]),
    "laws: a level that is a word": Command([*LAWS, "--predict", "a"], ["--predict", "'a'"]),
    "laws: no current": Command(LAWS, ["recording 'a' has no current", "current=VALUE[A]", "{current}"]),
    "next-test: no folder": Command(
        ["next-test", "d", "--out", "c.csv"], ["diagnosis.json", "cannot be read"]
    ),
    "next-test: no JSON": Command(NEXT, ["diagnosis.json", "is not JSON"], {"d/diagnosis.json": b"{"}),
    "next-test: a deep nest": Command(
        NEXT, ["is not JSON", "nested too deeply"], {"d/diagnosis.json": b"[" * 100_000}
    ),
    "next-test: a list": Command(NEXT, ["proposes no test"], {"d/diagnosis.json": b"[]"}),
    "next-test: no limits": proposal("stroke is None", "a finite number", stroke_mm=None),
    "next-test: limits that are none": Command(
        NEXT, ["proposes no test"], {"d/diagnosis.json": b'{"next_test": {"limits": 3}}'}
    ),
    "next-test: a stroke that would be written as zero": Command(
        [*NEXT, "--stroke", "1e-300"],
        ["stroke is 1e-300", "from 1e-06"],
        {
            "d/diagnosis.json": json.dumps(
                {"next_test": {"excitation": "slow_sine", "limits": LIMITS}}
            ).encode()
        },
    ),
    "next-test: a name too long": Command(
        ["next-test", "d", "--out", "x" * 300],
        ["x" * 300, "cannot be written", "File name too long"],
        {
            "d/diagnosis.json": json.dumps(
                {"next_test": {"excitation": "slow_sine", "limits": LIMITS}}
            ).encode()
        },
    ),
    "next-test: a word for a limit": proposal("rate is 'fast'", "a finite number", rate_hz="fast"),
    "next-test: a limit of NaN": proposal("duration is nan", "a finite number", duration_s=float("nan")),
    "next-test: a stroke below zero": proposal("stroke is -4", "a number from 1e-06", stroke_mm=-4),
    "next-test: a signal of 1e15 samples": proposal("at most 10000000 samples", duration_s=1e9, rate_hz=1e6),
    "next-test: an excitation of nobody": proposal("excitation is '../x'", "one of", excitation="../x"),
    "next-test: a current that is a word": proposal("current_A is 'ab'", "the lowest", current_A="ab"),
    "batch: no folder": Command(["batch", "no", *BATCH[2:]], ["no: cannot be read", "recordings"]),
    "batch: a file for a folder": Command(["batch", "a.csv", *BATCH[2:]], ["a.csv: cannot be read"]),
    "batch: no recordings": Command(BATCH, ["d: a folder without recordings", ".xlsx"], {"d/x.png": b"a"}),
    "batch: neither model nor base": Command(
        ["batch", "d", "--out", "new"], ["neither a model nor a base"], IN_BATCH
    ),
    "batch: model and base": batch("both a model and a base", given=["--base", "sinh"]),
    "batch: no such model": Command(
        ["batch", "d", "--model", "x", "--out", "new"], ["'x'", "sinh"], IN_BATCH
    ),
    "batch: no such optimizer": batch("'x'", "mafsa", given=["--optimizer", "x"]),
    "batch: no workers": batch("workers is 0", "1 to 1024", given=["--workers", "0"]),
    "batch: a million workers": batch("workers is 1000000", "1 to 1024", given=["--workers", "1000000"]),
    "batch: no threads": batch("threads is 0", "1 to 1024", given=["--threads", "0"]),
    "batch: no time": batch("budget is 0", "a positive number", given=["--budget", "0"]),
    "batch: NaN for a time": batch("budget is nan", "a finite number", given=["--budget", "nan"]),
    "batch: seeds that run backward": batch("--seeds 3:1", "FIRST:END", given=["--seeds", "3:1"]),
    "batch: a billion seeds": batch("--seeds 0:1000000000", given=["--seeds", "0:1000000000"]),
    "batch: no bootstrap": batch("bootstrap is -1", "from 2", given=["--bootstrap", "-1"]),
    "batch: bounds of no parameter": batch("bounds of 'q'", "alpha", given=["--bounds", "q=0:1"]),
    "batch: bounds reversed": batch("bounds of beta", "lower", given=["--bounds", "beta=2:1"]),
    "batch: weights of nobody": batch("weights is 'q'", "'samples'", given=["--weights", "q"]),
    "batch: no fish": batch("mre-core: fish is 0", given=["--optimizer", "mafsa", "--fish", "0"]),
    "batch: no iterations": batch("mre-core: iterations is 0", given=["--iterations", "0"]),
    "batch: a certain false alarm": Command(
        ["batch", "d", "--base", "sinh", "--out", "new", "--false-alarm", "2"],
        ["false_alarm is 2.0", "below 0.5"],
        IN_BATCH,
    ),
    "batch: a seed below zero": batch("seed is -1", "from 0", given=["--seed", "-1"]),
    "batch: a part of no such name": batch("part to exclude is 'x'", given=["--exclude", "x"]),
    "batch: a name pattern without fields": batch("name pattern 'x'", given=["--name-pattern", "x"]),
    "batch: no address": batch("nonsense", given=["--cluster", "nonsense"]),
    "batch: no Dask workers": batch("local:0", given=["--cluster", "local:0"]),
    "batch: a folder that is a file": batch("a.csv", "cannot be written", given=["--out", "a.csv"]),
    "diagnose: a certain false alarm": Command([*DIAGNOSE, "--false-alarm", "1"], ["false_alarm is 1.0"]),
    "diagnose: an effect of nobody": Command([*DIAGNOSE, "--without", "magic"], ["without is 'magic'"]),
    "diagnose: a limit of nobody": Command(
        [*DIAGNOSE, "--limit", "weight=3"], ["--limit weight=3", "stroke"]
    ),
    "diagnose: a limit twice": Command(
        [*DIAGNOSE, "--limit", "stroke=3", "--limit", "stroke=4"], ["--limit stroke=4", "each once"]
    ),
    "diagnose: a limit that is a word": Command(
        [*DIAGNOSE, "--limit", "speed=fast"], ["--limit speed=fast", "--limit speed=NUMBER in mm/s"]
    ),
    "diagnose: a current without a range": Command(
        [*DIAGNOSE, "--limit", "current=3"], ["--limit current=3", "LOWEST:HIGHEST"]
    ),
    "diagnose: bytes that are no text": Command(
        [*DIAGNOSE, "--exclude", os.fsdecode(b"\xff")],
        ["'?' is no text in UTF-8"],
    ),
    "diagnose: no such base": Command(
        ["diagnose", "a.csv", "--base", "cinh", "--out", "new"], ["'cinh'", "sinh"]
    ),
    "diagnose: less than a cycle": Command(DIAGNOSE, ["recording 'a'", "one full cycle"]),
    "demo: a seed below zero": Command(["demo", "--seed", "-1", "--out", "new"], ["seed is -1", "from 0"]),
    "study: a seed below zero": Command(["study", "--quick", "--seed", "-1", "--out", "new"], ["seed is -1"]),
    "study: no recordings": Command(
        ["study", "--quick", "--recordings", "no.csv", "--out", "new"], ["no.csv: there is no such file"]
    ),
    "study: a folder that is a file": Command(
        ["study", "--quick", "--out", "a.csv"], ["a.csv: cannot be written"]
    ),
    "trial: no cases": Command([*MAKE, "--cases", "0"], ["cases is 0", "from 1"]),
    "trial: a billion cases": Command([*MAKE, "--cases", "1000000000"], ["cases is 1000000000", "to 100000"]),
    "trial: a seed below zero": Command([*MAKE, "--seed", "-1"], ["seed is -1"]),
    "trial: no workers": Command([*MAKE, "--workers", "0"], ["workers is 0"]),
    "trial: made in a file": Command(["trial", "make", "a.csv", *MAKE[3:]], ["a.csv"]),
    "trial: none to run": Command(["trial", "run", "no"], ["no: holds no trial"]),
    "trial: no JSON": Command(["trial", "open", "d"], ["trial.json: is not JSON"], {"d/trial.json": b"{"}),
    "trial: a list": Command(["trial", "run", "d"], ["schema is None"], {"d/trial.json": b"[]"}),
    "schema: something more": Command(["schema", "x"], ["unexpected", "(x)"]),
}
