"""Text files that `mre_core.load` cannot read."""

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Any

import mre_core

from .made import Call

HEADER = "time_s,displacement_mm,force_N"
N = 12
GOOD = [f"{0.01 * i!r},{i % 5},{100.0 - i}" for i in range(N)]

# Each: the whole file, the options, and pieces of the one line it earns behind "a.csv: ".
BAD: dict[str, tuple[bytes | list[str], dict[str, object], list[str]]] = {
    "empty": (b"", {}, ["the file is empty", "wanted a header"]),
    "blank": (b"\n \n\n", {}, ["the file is empty"]),
    "comments only": (["# a", "# b"], {}, ["no rows of numbers", "wanted a header"]),
    "header only": (["# a", HEADER, ""], {}, ["line 2: a header but no data", "wanted rows of numbers"]),
    "binary": (b"\x89PNG\0\0\1\2", {}, ["is not a text file", "the ending of its format"]),
    "utf-16": ("time_s".encode("utf-16"), {}, ["no rows of numbers"]),
    "bytes that are no UTF-8": (
        b"\xef\xbb\xbf# a\nT [\xb0C]\n",
        {},
        ["line 2: byte 0xb0 is not utf-8", "read encoding=cp1252"],
    ),
    "another encoding": (
        "t [s],T [°C]\n".encode(),
        {"read": {"encoding": "ascii"}},
        ["line 1: byte 0xc2 is not ascii"],
    ),
    "semicolons": (["time_s;force_N", "0;1"], {}, ["no column for displacement among time_s, force_N"]),
    "no header": (GOOD, {}, ["no column for time among column 1, column 2, column 3", "mre-core inspect"]),
    "duplicate": ([HEADER + ",force_N", *GOOD], {}, ["line 1: header has force_N more than once"]),
    "quote in header": (['"time_s,force_N', *GOOD], {}, ["line 1: header cannot be read"]),
    "text": (
        ["# x", HEADER, "", *GOOD[:2], "0.02,1,abc"],
        {},
        ["line 6, column 'force_N': found 'abc'", "a number"],
    ),
    "row of no units": (
        [HEADER, "a,b,c", *GOOD],
        {},
        ["line 2, column 'time_s': found 'a', wanted a number"],
    ),
    "late comment": (
        [HEADER, *GOOD[:2], "# pause", *GOOD[2:]],
        {},
        ["line 4, column 'time_s': found '# pause'"],
    ),
    "empty cell": (
        [HEADER, *GOOD[:3], "0.05,,1"],
        {},
        ["line 5, column 'displacement_mm': found an empty cell"],
    ),
    "short row": ([HEADER, *GOOD[:3], "0.05,1"], {}, ["line 5, column 'force_N': found an empty cell"]),
    "nan": ([HEADER, *GOOD[:3], "0.05,NaN,1"], {}, ["line 5", "found 'NaN', wanted a finite number"]),
    "inf": ([HEADER, *GOOD[:3], "0.05,1,-inf"], {}, ["line 5", "found '-inf', wanted a finite number"]),
    "overflow": ([HEADER, *GOOD[:3], "0.05,1,1e999"], {}, ["found '1e999', wanted a finite number"]),
    "100,000 digits": (
        [HEADER, *GOOD[:3], "9" * 100_000 + ",1,1"],
        {},
        ["line 5, column 'time_s': found '9999", "wanted a finite number"],
    ),
    "50,000 blanks in a header": (
        [HEADER.replace("force_N", "force" + " " * 50_000 + "N"), *GOOD],
        {},
        ["no column for force among time_s"],
    ),
    "hex": ([HEADER, *GOOD[:3], "0.05,1,0x1p3"], {}, ["found '0x1p3', wanted a number"]),
    "underscore": ([HEADER, *GOOD[:3], "0.05,1,1_0"], {}, ["found '1_0', wanted a number"]),
    "truth": ([HEADER, *GOOD[:3], "0.05,1,True"], {}, ["found 'True', wanted a number"]),
    "long text": ([HEADER, "0,1," + "z" * 500], {}, ["found 'zzzz", "..., wanted a number"]),
    "decimal commas": (
        [HEADER, "0,0,1,5,2,5"],
        {},
        ["line 2: found 6 fields, wanted 3", "comma between columns, decimal point"],
    ),
    "ragged": ([HEADER, *GOOD[:4], GOOD[4] + ",9"], {}, ["line 6: found 4 fields, wanted 3"]),
    "quote": ([HEADER, *GOOD[:4], '0.5,1,"2'], {}, ["line 6: row cannot be read"]),
    "line behind quoted lines": (
        [HEADER + ",note", GOOD[0] + ',"one\ntwo\nthree"', "", "0.01,1,x,y"],
        {},
        ["line 6, column 'force_N': found 'x'"],
    ),
    "repeated time": (
        [HEADER, "", *GOOD[:3], GOOD[2]],
        {},
        ["line 6, column 'time_s'", "repeated: 0.02 after 0.02"],
    ),
    "backward time": (
        [HEADER, *GOOD[:3], GOOD[0]],
        {},
        ["line 5, column 'time_s'", "backward: 0.0 after 0.02"],
    ),
    "few samples": ([HEADER, *GOOD[:3]], {}, ["3 samples"]),
    "still": ([HEADER, *(f"{i},1,{i}" for i in range(N))], {}, ["displacement is 1 mm throughout"]),
    "role missing": ([HEADER.replace("force_N", "F"), *GOOD], {}, ["no column for force among time_s"]),
    "bad map": ([HEADER, *GOOD], {"map": {"force": "farce_N"}}, ["'farce_N'", "nearest: force_N"]),
    "bad unit": ([HEADER, *GOOD], {"map": {"force": "force_N[furlong]"}}, ["unit 'furlong'", "force", "kN"]),
    "other condition": (
        [HEADER, *GOOD],
        {"humidity": 3},
        ["'humidity' is no condition", "current or temperature"],
    ),
    "condition text": ([HEADER, *GOOD], {"current": "much"}, ["current is 'much'", "a finite number in A"]),
    "condition nan": ([HEADER, *GOOD], {"temperature": float("nan")}, ["temperature is nan", "degC"]),
    "condition bool": ([HEADER, *GOOD], {"current": True}, ["current is True"]),
    "condition unit": ([HEADER, *GOOD], {"current": "5[mm]"}, ["'mm' is a unit of displacement", "mA"]),
    "name": (
        [HEADER, *GOOD],
        {"name_pattern": "{current}A"},
        ["name 'a' does not match the pattern '{current}A'"],
    ),
}


def load(data: bytes | Sequence[str], options: dict[str, Any]) -> object:
    Path("a.csv").write_bytes(data if isinstance(data, bytes) else ("\n".join(data) + "\n").encode())
    return mre_core.load("a.csv", **options)


LOADING = {
    kind: Call(partial(load, data, options), ["a.csv: ", *pieces], mre_core.InputError)
    for kind, (data, options, pieces) in BAD.items()
}
