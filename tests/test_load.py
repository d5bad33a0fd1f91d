"""Recordings from CSV files: what is read, and how exactly."""

import warnings
from pathlib import Path

import mre_core
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

HEADER = "time_s,displacement_mm,force_N"
N = 12


def rows(n: int = N, seed: int = 7) -> NDArray[np.float64]:
    rng = np.random.default_rng(seed)
    time = 0.01 * np.arange(n)
    return np.column_stack([time, 5 * np.sin(40 * time) + 0.1, 300 * rng.standard_normal(n)])


def lines(n: int = N) -> list[str]:
    return [",".join(repr(float(value)) for value in row) for row in rows(n)]


def write(folder: Path, *text: str, name: str = "a.csv") -> Path:
    path = folder / name
    path.write_text("\n".join(text) + "\n", encoding="utf-8")
    return path


def test_reads_every_digit(tmp_path: Path) -> None:
    recording = mre_core.load(write(tmp_path, HEADER, *lines()))
    expected = rows()
    assert recording.name == "a"
    np.testing.assert_array_equal(recording.time, expected[:, 0])
    np.testing.assert_array_equal(recording.displacement, expected[:, 1])
    assert recording.force is not None
    np.testing.assert_array_equal(recording.force, expected[:, 2])


@pytest.mark.parametrize(
    "change",
    [
        lambda text: "\ufeff" + text,
        lambda text: "# rig 3\n\n  # second run\n" + text,
        lambda text: text.replace("\n", "\r\n"),
        lambda text: text.replace("\n", "\r"),
        lambda text: text.replace("\n", "\n\n"),
        lambda text: text.replace("\n", "\n   \n"),
        lambda text: text.replace(",", " , "),
        lambda text: text.rstrip("\n"),
        lambda text: "\n".join('"' + line.replace(",", '","') + '"' for line in text.splitlines()),
        lambda text: "\n".join(line + ",note" for line in text.splitlines()),
        lambda text: "\n".join(line + ',"a, b"' for line in text.splitlines()),
        lambda text: "\n".join(
            line + ',"a\nb"' if i else line + ",x" for i, line in enumerate(text.splitlines())
        ),
        lambda text: text.replace(HEADER, HEADER + ",remark"),
    ],
)
def test_harmless_variants_read_the_same(tmp_path: Path, change: object) -> None:
    assert callable(change)
    path = tmp_path / "a.csv"
    path.write_bytes(change("\n".join([HEADER, *lines()]) + "\n").encode())
    recording = mre_core.load(str(path))
    np.testing.assert_array_equal(recording.displacement, rows()[:, 1])


def test_optional_columns(tmp_path: Path) -> None:
    extra = "velocity [m/s],current_A,temp_F,simulated (kN)"
    text = [f"{line},0.5,{i},212,2" for i, line in enumerate(lines())]
    recording = mre_core.load(write(tmp_path, f"{HEADER},{extra}", *text))
    np.testing.assert_array_equal(recording.velocity, np.full(N, 500.0))
    np.testing.assert_array_equal(recording.current, np.arange(N, dtype=float))
    assert np.asarray(recording.temperature) == pytest.approx(np.full(N, 100.0), rel=1e-14)
    assert recording.simulated is not None
    np.testing.assert_array_equal(recording.simulated, np.full(N, 2000.0))
    assert recording.velocity_window is None


def test_only_needed_columns_have_to_be_numbers(tmp_path: Path) -> None:
    path = write(tmp_path, HEADER + ",current_A", *(line + ",off" for line in lines()))
    assert mre_core.load(path, current=0).current == 0.0
    with pytest.raises(mre_core.InputError, match="line 2, column 'current_A': found 'off', wanted a number"):
        mre_core.load(path)


def test_force_may_be_missing_on_request(tmp_path: Path) -> None:
    path = write(tmp_path, "time_s,displacement_mm", *(line.rsplit(",", 1)[0] for line in lines()))
    assert mre_core.load(path, require_force=False).force is None
    with pytest.raises(mre_core.InputError, match="no column for force"):
        mre_core.load(path)


def test_assumed_unit_warns_once_at_the_caller(tmp_path: Path) -> None:
    path = write(tmp_path, "t,disp,load", *lines())
    with pytest.warns(mre_core.UnitAssumedWarning) as caught:
        mre_core.load(path)
    assert len(caught) == 1
    assert caught[0].filename == __file__
    text = str(caught[0].message)
    assert "\n" not in text
    for piece in [str(path), "'t' (taken as s)", "'disp' (taken as mm)", "'load' (taken as N)"]:
        assert piece in text
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        mre_core.load(path, map={"time": "t[s]", "displacement": "disp[mm]", "force": "load[kN]"})


# Factor and offset by definition of the unit.
UNITS = {
    "Time": [("s", 1.0, 0.0), ("ms", 1e-3, 0.0), ("min", 60.0, 0.0)],
    "Displacement": [("mm", 1.0, 0.0), ("m", 1e3, 0.0), ("inch", 25.4, 0.0), ("µm", 1e-3, 0.0)],
    "Velocity": [("mm/s", 1.0, 0.0), ("m/s", 1e3, 0.0), ("in/s", 25.4, 0.0)],
    "Force": [
        ("N", 1.0, 0.0),
        ("kN", 1e3, 0.0),
        ("lbf", 4.4482216152605, 0.0),
        ("kip", 4448.2216152605, 0.0),
    ],
    "Current": [("A", 1.0, 0.0), ("mA", 1e-3, 0.0)],
    "Temperature": [("°C", 1.0, 0.0), ("degF", 5 / 9, -160 / 9), ("K", 1.0, -273.15)],
}


@settings(deadline=None, max_examples=60)
@given(
    st.fixed_dictionaries({role: st.sampled_from(units) for role, units in UNITS.items()}),
    st.integers(0, 2**32 - 1),
    st.booleans(),
)
def test_round_trip(
    tmp_path_factory: pytest.TempPathFactory,
    unit: dict[str, tuple[str, float, float]],
    seed: int,
    quoted: bool,
) -> None:
    rng = np.random.default_rng(seed)
    n = 20
    values = {role: rng.uniform(-1, 1, n) * 10.0 ** rng.integers(-3, 4) for role in UNITS}
    values["Time"] = np.cumsum(rng.uniform(0.1, 1, n))
    values["Temperature"] = np.abs(values["Temperature"])  # above absolute zero in any unit
    quote = '"' if quoted else ""
    text = [",".join(f"{quote}{role} [{unit[role][0]}]{quote}" for role in UNITS)]
    for row in zip(*values.values(), strict=True):
        text.append(",".join(f"{quote}{float(value)!r}{quote}" for value in row))
    recording = mre_core.load(write(tmp_path_factory.getbasetemp(), *text, name="round_trip.csv"))
    for role, (_, factor, offset) in unit.items():
        expected = values[role] * factor + offset
        # Relative to the terms, since a sum near zero keeps fewer digits.
        size = np.abs(values[role] * factor) + abs(offset)
        assert np.all(np.abs(getattr(recording, role.lower()) - expected) <= 1e-12 * size)


@settings(deadline=None, max_examples=300)
@given(st.text("0123456789.eE+-xnaif_ ", max_size=6) | st.floats().map(repr))
def test_both_ways_of_reading_accept_the_same(tmp_path_factory: pytest.TempPathFactory, cell: str) -> None:
    # A quotation mark anywhere sends the file through the reader that tells the line.
    outcomes = []
    for remark in ["x", '"x"']:
        text = [*(f"{line},x" for line in lines()), f"0.5,1,{cell},{remark}"]
        path = write(tmp_path_factory.getbasetemp(), HEADER + ",remark", *text, name="both.csv")
        try:
            force = mre_core.load(path).force
            assert force is not None
            outcomes.append(repr(force[-1]))
        except mre_core.InputError as error:
            outcomes.append(str(error))
    assert outcomes[0] == outcomes[1]
