"""Recordings that cannot be read, by `mre-core identify`."""

import numpy as np
from rig import HEADER

from .made import GOOD, IDENTIFY, Command, T, bad_file, headed, instead

FILES = {
    "missing column": bad_file(headed("time_s,displacement_mm,humidity"), "no column for force", "force_N"),
    "wrong unit": bad_file(headed("time_s,displacement_mm,Force [mm]"), "column 'Force [mm]'", "kN"),
    "text in a number": bad_file(
        instead(7, "0.05,1,soft"), "line 7, column 'force_N'", "'soft'", "wanted a number"
    ),
    "nan": bad_file(
        instead(9, "0.07,nan,1"), "line 9, column 'displacement_mm'", "'nan'", "wanted a finite number"
    ),
    "infinite": bad_file(instead(9, "0.07,1,1e999"), "line 9, column 'force_N'", "'1e999'", "finite"),
    "empty cell": bad_file(instead(9, "0.07,,1"), "line 9, column 'displacement_mm'", "empty cell"),
    "repeated time": bad_file(instead(6, "0.03,1,1"), "line 6, column 'time_s'", "0.03 after 0.03", "wanted"),
    "backward time": bad_file(instead(6, "0.01,1,1"), "line 6, column 'time_s'", "0.01 after 0.03", "wanted"),
    "two samples": bad_file("\n".join([HEADER, *GOOD[:2]]).encode(), "2 samples", "at least"),
    "constant displacement": bad_file(
        "\n".join([HEADER, *(f"{t},5,{t}" for t in T)]).encode(), "displacement is 5 mm throughout"
    ),
    "ragged row": bad_file(instead(8, "0.06,1,2,3"), "line 8", "found 4 fields", "wanted 3"),
    "short row": bad_file(instead(8, "0.06,1"), "line 8, column 'force_N'", "empty cell"),
    "empty file": bad_file(b"", "the file is empty", "wanted"),
    "header only": bad_file(HEADER.encode(), "line 1", "no data"),
    "binary file": bad_file(bytes(range(256)) * 40, "not a text file"),
    "not utf-8": bad_file(
        instead(3, "0.01,1,2").replace(b"0.01", b"\xff"), "line 3, column 'time_s': found 'ÿ'"
    ),
    "no force at all": Command(
        IDENTIFY,
        ["recording 'a'", "the force is 0 N throughout", "changes with the motion"],
        {"a.csv": "\n".join([HEADER, *(f"{t},{np.sin(t)},0" for t in T)]).encode()},
    ),
    "a folder": Command(["identify", "/proc", *IDENTIFY[2:]], ["/proc: is a folder without recordings"]),
    "a device": Command(
        ["identify", "/dev/zero", *IDENTIFY[2:]], ["/dev/zero: is no regular file", "write it out"]
    ),
    "too many columns": bad_file(
        "\n".join([HEADER + ",c" * 998, *(row + ",1" * 998 for row in GOOD)]).encode(),
        *("line 1: has 1001 columns", "at most 1000"),
    ),
    "missing file": Command(["identify", "b.csv", *IDENTIFY[2:]], ["b.csv: there is no such file"]),
    "second file": Command(
        ["identify", "a.csv", "b.csv", *IDENTIFY[2:]],
        ["b.csv: line 4, column 'force_N'", "'x'"],
        {"b.csv": instead(4, "0.02,1,x")},
    ),
}
