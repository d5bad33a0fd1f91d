"""Text as rigs write it: every way of writing gives the same recording. Folders, blocks, what users say."""

from collections.abc import Callable
from pathlib import Path

import mre_core
import numpy as np
import pytest
from known import known, rows, same
from mre_core import InputError, Recording, SkippedWarning
from rig import force_of


@pytest.fixture(scope="module")
def truth() -> Recording:
    return known()


def text(
    truth: Recording, header: str, *, separator: str = ",", decimal: str = ".", scale: float = 1.0
) -> str:
    """Header as it is, then rows; the force in units of `scale` N."""
    lines = [
        separator.join(f"{value!r}".replace(".", decimal) for value in (t, x, f / scale))
        for t, x, f in rows(truth)
    ]
    return "\n".join([header, *lines]) + "\n"


PREAMBLE = "Prüfung;Nr. 12\nDatum;21.11.2026 10:30\nAbtastrate;200\n\n"
TEXTS: dict[str, Callable[[Recording], bytes]] = {
    "cp1252, decimal comma, units in brackets": lambda r: (
        PREAMBLE + text(r, "Zeit [s];Weg [mm];Kraft [kN]", separator=";", decimal=",", scale=1e3)
    ).encode("cp1252"),
    "units row under the header": lambda r: (
        PREAMBLE + text(r, "Zeit;Weg;Kraft\ns;mm;kN", separator=";", decimal=",", scale=1e3)
    ).encode("cp1252"),
    "units row in brackets, and labels": lambda r: text(
        r, "Time\tDisp\tForce\nCh 1\tCh 2\tCh 3\n[s]\t[mm]\t[N]", separator="\t"
    ).encode(),
    "a preamble wider than any table": lambda r: (
        "# config: "
        + ",".join(map(str, range(1500)))
        + "\nwords,"
        + ",".join("ab" * 1500)
        + "\n"
        + text(r, "time_s,disp_mm,force_N")
    ).encode(),
    "GBK": lambda r: ("试验,隔震支座\n" + text(r, "时间(s),位移(mm),力(kN)", scale=1e3)).encode("gbk"),
    "GBK, full brackets": lambda r: text(r, "时间（s）,位移（mm）,力（N）").encode("gbk"),
    "UTF-8 with a mark": lambda r: text(r, "Zeit / s;Weg / mm;Kraft / N", separator=";").encode("utf-8-sig"),
    "UTF-16 with a mark": lambda r: text(r, "t [s]\tWeg [mm]\tKraft [N]", separator="\t").encode("utf-16"),
    "UTF-16 without a mark": lambda r: text(r, "t [s]\tdisp [mm]\tload [N]", separator="\t").encode(
        "utf-16-le"
    ),
    "UTF-16 the other way": lambda r: text(r, "t [s]\tdisp [mm]\tload [N]", separator="\t").encode(
        "utf-16-be"
    ),
    "blanks": lambda r: (
        "Station 3   Test 12\n"
        + text(r, "  Time (s)   Axial Disp (mm)   Axial Force (N)", separator="   ").replace("\n", "\n  ")
    ).encode(),
    "single blanks": lambda r: text(r, "Time (s) Disp (mm) Load (N)", separator=" ").encode(),
    "bars": lambda r: text(r, "time_s|disp_mm|force_N", separator="|").encode(),
    "header in a comment": lambda r: text(r, "# time_s disp_mm force_N", separator=" ").encode(),
    "quoted decimal commas": lambda r: "\n".join(
        ["time_s,disp_mm,force_N"]
        + [",".join(f'"{value!r}"'.replace(".", ",") for value in row) for row in rows(r)]
    ).encode(),
    "a separator at every end": lambda r: (
        text(r, "time_s;disp_mm;force_N;", separator=";").replace("\n", ";\n").replace(";;", ";").encode()
    ),
    "a separator behind the numbers only": lambda r: "\n".join(
        line if i == 0 else line + ";"
        for i, line in enumerate(text(r, "time_s;disp_mm;force_N", separator=";").splitlines())
    ).encode(),
    "numbers in the preamble": lambda r: (
        "Rate;200\nLimits;-10;10\nArea;12;mm2\n" + text(r, "Zeit [s];Weg [mm];Kraft [N]", separator=";")
    ).encode(),
    "times of day": lambda r: "\n".join(
        ["Zeit;Weg [mm];Kraft [N]"]
        + [f"10:31:{5 + t:06.3f};{x!r};{f!r}".replace(".", ",") for t, x, f in rows(r)]
    ).encode(),
    "dates over midnight": lambda r: "\n".join(
        ["Time;Disp [mm];Force [N]"]
        + [f"{'20.11.2026 ' if t < 0.1 else '21.11.2026 '}{_clock(t)};{x!r};{f!r}" for t, x, f in rows(r)]
    ).encode(),
    "marks between thousands": lambda r: "\n".join(
        ["Time [s];Disp [mm];Force [mN]"] + [f"{t};{x};{1e3 * f:,.3f}" for t, x, f in rows(r)]
    ).encode(),
    "units in capitals": lambda r: text(r, "Time;Disp;Force\nSec;mm;KN", separator=";", scale=1e3).encode(),
    "LabVIEW measurement": lambda r: (
        "LabVIEW Measurement\t\nSeparator\tTab\n***End_of_Header***\t\n\t\nChannels\t2\t\t\n"
        "Samples\t60\t60\t\nDelta_X\t0.005\t0.005\t\n***End_of_Header***\t\t\t\n"
        + text(r, "Time [s]\tDisplacement [mm]\tForce [N]\tComment", separator="\t")
    ).encode(),
    "a footer": lambda r: (text(r, "time_s,disp_mm,force_N") + "\nEnd of test\n").encode(),
    "blocks in which time goes on": lambda r: "".join(
        f"Segment {i}\nTime\tDisp\tForce\ns\tmm\tN\n"
        + "".join("\t".join(map(repr, row)) + "\n" for row in rows(r)[20 * i : 20 * (i + 1)])
        + "\n"
        for i in range(3)
    ).encode(),
}


def _clock(t: float) -> str:
    """Time of day that passes midnight after 0.1 s."""
    return f"23:59:{59.9 + t:06.3f}" if t < 0.0999 else f"00:00:{t - 0.1:06.3f}"


@pytest.mark.parametrize("case", TEXTS)
def test_text(tmp_path: Path, truth: Recording, case: str) -> None:
    path = tmp_path / "a.txt"
    path.write_bytes(TEXTS[case](truth))
    same(mre_core.load(path), truth)


def test_an_error_in_any_of_them_has_its_line(tmp_path: Path, truth: Recording) -> None:
    lines = TEXTS["units row under the header"](truth).split(b"\n")
    lines[20] = b"0,5;soft;1,0"
    path = tmp_path / "a.txt"
    path.write_bytes(b"\n".join(lines))
    with pytest.raises(InputError, match=r"a\.txt: line 21, column 'Weg \[mm\]': found 'soft', wanted a num"):
        mre_core.load(path)
    lines[20] = b"0.5;1;1,0"
    path.write_bytes(b"\n".join(lines))
    with pytest.raises(InputError, match=r"line 21, column 'Zeit \[s\]': found '0\.5', wanted a number"):
        mre_core.load(path)
    blocks = TEXTS["blocks in which time goes on"](truth).split(b"\n")
    blocks[34] = blocks[33]
    path.write_bytes(b"\n".join(blocks))
    with pytest.raises(InputError, match=r"line 35, column 'Time \[s\]': time is repeated"):
        mre_core.load(path)


def test_what_the_user_says_wins(tmp_path: Path, truth: Recording) -> None:
    path = tmp_path / "a.txt"
    path.write_bytes(text(truth, "Время [s];Ход [mm];Сила [N]", separator=";").encode("cp1251"))
    columns = {"time": "Время", "displacement": "Ход", "force": "Сила"}
    with pytest.raises(InputError):
        mre_core.load(path, map=columns)
    same(mre_core.load(path, map=columns, read={"encoding": "cp1251"}), truth)
    path.write_text("1 2 3\n4 5 6\n7 8 9\n" + text(truth, "time_s,x,force_N"))
    read = {"header": 4, "separator": "comma", "decimal": "point"}
    same(mre_core.load(path, map={"displacement": "x[mm]"}, read=read), truth)


def test_numbers_without_header_or_time(tmp_path: Path, truth: Recording) -> None:
    path = tmp_path / "a.dat"
    path.write_text("\n".join(f"{x!r}\t{f!r}" for _, x, f in rows(truth)))
    columns = {"displacement": "column 1[mm]", "force": "column 2[N]"}
    same(mre_core.load(path, map=columns, read={"rate": "200Hz"}), truth)
    with pytest.raises(InputError, match="no column for time among column 1, column 2"):
        mre_core.load(path, map=columns)


@pytest.mark.parametrize(
    ("read", "piece"),
    [
        ({"encodng": "utf-8"}, "'encodng', wanted one of encoding"),
        ({"encoding": "klingon"}, "encoding is 'klingon'"),
        ({"separator": "x"}, "separator is 'x', wanted comma"),
        ({"decimal": "x"}, "decimal is 'x', wanted point or comma"),
        ({"header": "0"}, "header is '0'"),
        ({"rate": "-1"}, "rate is '-1', wanted samples in a second"),
        ({"header": 999}, "wanted a header in line 999"),
        ({"table": "Sheet9"}, "there is no table 'Sheet9'"),
    ],
)
def test_wrong_reading(tmp_path: Path, truth: Recording, read: dict[str, object], piece: str) -> None:
    path = tmp_path / "a.txt"
    path.write_text(text(truth, "time_s,disp_mm,force_N"))
    with pytest.raises(InputError) as caught:
        mre_core.load(path, read=read)
    assert piece in str(caught.value)


def test_a_sign_that_is_the_other_way_round(tmp_path: Path, truth: Recording) -> None:
    path = tmp_path / "a.csv"
    path.write_text(text(truth, "time_s,disp_mm,load"))
    found = mre_core.load(path, map={"force": "-load[kN]"})
    np.testing.assert_allclose(force_of(found), -1e3 * force_of(truth), rtol=1e-12)


def test_blocks_in_which_time_starts_anew(tmp_path: Path, truth: Recording) -> None:
    path = tmp_path / "a.txt"
    path.write_text(2 * ("Segment\n" + text(truth, "time_s,disp_mm,force_N")))
    with pytest.raises(InputError, match="holds 2 recordings: a#1, a#2, wanted load_all"):
        mre_core.load(path)
    for recording in mre_core.load_all(path):
        same(recording, truth)
    same(mre_core.load(path, read={"table": 2}), truth)


def test_a_folder_is_a_campaign(tmp_path: Path, truth: Recording) -> None:
    for name in ("b.csv", "a.txt"):
        (tmp_path / name).write_text(text(truth, "time_s,disp_mm,force_N"))
    (tmp_path / "notes.md").write_text("no recording")
    (tmp_path / ".hidden.csv").write_text("no recording")
    (tmp_path / "results").mkdir()
    assert [recording.name for recording in mre_core.load_all(tmp_path)] == ["a", "b"]
    (tmp_path / "readme.txt").write_text("Rig 3\n")
    with pytest.warns(SkippedWarning, match=r"passed over: .*readme\.txt: no rows of numbers"):
        assert len(mre_core.load_all([tmp_path])) == 2
    with pytest.raises(InputError, match=r"results: is a folder without recordings, wanted files that end"):
        mre_core.load_all(tmp_path / "results")
    # A file of numbers that cannot be used is no file to pass over.
    (tmp_path / "readme.txt").write_text("time_s,disp_mm,force_N\n1,2,x\n1,2,3")
    with pytest.raises(InputError, match="line 2, column 'force_N': found 'x'"):
        mre_core.load_all(tmp_path)


def test_a_time_of_day_that_is_none(tmp_path: Path, truth: Recording) -> None:
    lines = TEXTS["times of day"](truth).decode().splitlines()
    lines[9] = lines[9].replace("10:31", "late")
    path = tmp_path / "a.txt"
    path.write_text("\n".join(lines))
    with pytest.raises(
        InputError, match=r"line 10, column 'Zeit \[s\]': found 'late:05,04.', wanted a time of"
    ):
        mre_core.load(path)
