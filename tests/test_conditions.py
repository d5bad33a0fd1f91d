"""Conditions given outright, as text with a unit, and read from file names."""

from pathlib import Path

import mre_core
import numpy as np
import pytest

PATTERN = "{amplitude}mm{frequency}Hz{current}A"


def write(folder: Path, name: str, header: str = "time_s,displacement_mm,force_N") -> Path:
    path = folder / name
    rows = [f"{0.01 * i},{np.sin(0.5 * i)},{i}{',2.5' * (header.count(',') - 2)}" for i in range(20)]
    path.write_text("\n".join([header, *rows]) + "\n", encoding="utf-8")
    return path


@pytest.mark.parametrize(
    ("given", "amperes"),
    [(1.0, 1.0), (2, 2.0), ("1", 1.0), ("500[mA]", 0.5), (" 1e3 [mA] ", 1.0), (np.float32(0.5), 0.5)],
)
def test_current(tmp_path: Path, given: float | str, amperes: float) -> None:
    assert mre_core.load(write(tmp_path, "a.csv"), current=given).current == pytest.approx(amperes, rel=1e-15)


def test_temperature(tmp_path: Path) -> None:
    path = write(tmp_path, "a.csv")
    assert mre_core.load(path, temperature=23).temperature == 23.0
    assert mre_core.load(path, temperature="212[degF]").temperature == pytest.approx(100.0, rel=1e-14)
    assert mre_core.load(path, temperature="-5[C]").temperature == -5.0
    assert mre_core.load(path, temperature=None).temperature is None


@pytest.mark.parametrize(
    ("name", "pattern", "current", "temperature"),
    [
        ("10mm2Hz0x5A.csv", PATTERN, 0.5, None),
        ("10mm2Hz1A.csv", PATTERN, 1.0, None),
        ("25mm0x25Hz0A.csv", PATTERN, 0.0, None),
        ("2.5mm1e1Hz1.5A.csv", PATTERN, 1.5, None),
        ("run_500mA.csv", "run_{current}mA", 0.5, None),
        ("run_500mA_x.csv", "run_{current}mA_x", 0.5, None),
        ("run_2.csv", "run_{current}", 2.0, None),
        ("I1e-1_T-2.csv", "I{current}_T{temperature}", 0.1, -2.0),
        ("1x5A_-2C.csv", "{current}A_{temperature}C", 1.5, -2.0),
        ("1A300K.csv", "{current}A{temperature}K", 1.0, 300 - 273.15),
        ("77°F.csv", "{temperature}°F", None, 25.0),
        ("a.b(3).csv", "a.b({n})", None, None),
    ],
)
def test_name_pattern(
    tmp_path: Path, name: str, pattern: str, current: float | None, temperature: float | None
) -> None:
    recording = mre_core.load(write(tmp_path, name), name_pattern=pattern)
    assert recording.current == (None if current is None else pytest.approx(current, rel=1e-14))
    assert recording.temperature == (None if temperature is None else pytest.approx(temperature, rel=1e-14))
    assert recording.name == name.removesuffix(".csv")


def test_what_wins(tmp_path: Path) -> None:
    path = write(tmp_path, "5mm3Hz1A.csv", "time_s,displacement_mm,force_N,current_A")
    np.testing.assert_array_equal(mre_core.load(path).current, np.full(20, 2.5))
    assert mre_core.load(path, name_pattern=PATTERN).current == 1.0
    assert mre_core.load(path, name_pattern=PATTERN, current=3).current == 3.0


@pytest.mark.parametrize(
    ("name", "pattern", "pieces"),
    [
        ("5mm3Hz.csv", PATTERN, ["the name '5mm3Hz' does not match", PATTERN]),
        ("5mm3Hz1A_b.csv", PATTERN, ["does not match"]),
        ("x5mm3Hz1A.csv", PATTERN, ["does not match"]),
        ("5mm3HzoneA.csv", PATTERN, ["does not match", "a number for each field"]),
        ("1e999A.csv", "{current}A", ["current is '1e999'", "a finite number in A"]),
        ("a.csv", "a", ["name pattern 'a': no field in braces", "such as '{amplitude}mm"]),
        ("a.csv", "{current", ["name pattern '{current'"]),
        ("a.csv", "{}A", ["'{}' is no field name"]),
        ("a.csv", "{current}A{current}", ["'{current}' stands there twice"]),
        ("a.csv", "{current}{n}", ["nothing between '{current}' and '{n}'"]),
        ("a.csv", "{current:3}", ["a format behind 'current'"]),
    ],
)
def test_bad_name_or_pattern(tmp_path: Path, name: str, pattern: str, pieces: list[str]) -> None:
    path = write(tmp_path, name)
    with pytest.raises(mre_core.InputError) as caught:
        mre_core.load(path, name_pattern=pattern)
    text = str(caught.value)
    assert text.startswith(f"{path}: ")
    assert "\n" not in text
    for piece in pieces:
        assert piece in text
