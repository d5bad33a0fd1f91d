"""Which column is taken for what."""

import re

import mre_core
import pytest
from mre_core.columns import CANONICAL, assumption, find_columns

BASE = ["time_s", "displacement_mm", "force_N"]


def test_canonical_headers() -> None:
    found = find_columns(list(CANONICAL.values()))
    assert {role: column.header for role, column in found.items()} == CANONICAL
    assert all(column.conversion == (1.0, 0.0) and not column.assumed for column in found.values())


@pytest.mark.parametrize(
    ("header", "role", "factor"),
    [
        ("Force [kN]", "force", 1e3),
        ("Force (kN)", "force", 1e3),
        ("FORCE[kN]", "force", 1e3),
        ("Kraft_kN", "force", 1e3),
        ("load kN", "force", 1e3),
        ("disp_mm", "displacement", 1.0),
        ("Stroke (in)", "displacement", 25.4),
        ("position_m", "displacement", 1e3),
        ("vel_m_s", "velocity", 1e3),
        ("Velocity [m/s]", "velocity", 1e3),
        ("t [ms]", "time", 1e-3),
        ("Zeit_s", "time", 1.0),
        ("Strom (mA)", "current", 1e-3),
        ("Temp [°C]", "temperature", 1.0),
        ("simulated_kN", "simulated", 1e3),
        ("Simulated Force [kN]", "simulated", 1e3),
        ("simulated_force_kN", "simulated", 1e3),
    ],
)
def test_alias_with_unit(header: str, role: str, factor: float) -> None:
    headers = [header, *(name for name in BASE if name != CANONICAL[role])]
    column = find_columns(headers)[role]
    assert (column.header, column.conversion.factor, column.assumed) == (header, factor, False)


@pytest.mark.parametrize(
    "header",
    [
        *("force_max", "force_mm", "displacement_rod", "disp_link", "velocity_c", "time_step", "time_a"),
        *("isolator_disp_m", "my force [N]", "position_1", "T [degC]", "current_V", "forces_N", ""),
    ],
)
def test_anything_else_is_left_alone(header: str) -> None:
    assert [column.header for column in find_columns([*BASE, header]).values()] == BASE


def test_header_without_unit_is_assumed_and_said_so_in_one_line() -> None:
    columns = find_columns(["t", "disp", "Force [kN]"])
    assert [column.assumed for column in columns.values()] == [True, True, False]
    message = assumption(columns.values(), "a.csv")
    assert message is not None
    assert message.startswith("a.csv: no unit in the header of 't' (taken as s), 'disp' (taken as mm);")
    assert "time='t[s]'" in message
    assert assumption(find_columns(BASE).values()) is None


@pytest.mark.parametrize(
    ("text", "header", "factor", "assumed"),
    [
        ("base_shear_kN", "base_shear_kN", 1e3, False),
        ("base_shear_kN[N]", "base_shear_kN", 1.0, False),
        ("F [lbf]", "F [lbf]", 4.4482216152605, False),
        ("F [lbf][kN]", "F [lbf]", 1e3, False),
        ("raw", "raw", 1.0, True),
        ("raw[kN]", "raw", 1e3, False),
        ("raw [kN]", "raw", 1e3, False),
        ("sensor_A", "sensor_A", 1.0, True),
    ],
)
def test_map(text: str, header: str, factor: float, assumed: bool) -> None:
    headers = [*BASE, "base_shear_kN", "F [lbf]", "raw", "sensor_A"]
    column = find_columns(headers, {"force": text})["force"]
    assert column.header == header
    assert column.conversion.factor == pytest.approx(factor, rel=1e-15)
    assert column.assumed is assumed


def test_map_reads_units_with_an_underscore() -> None:
    found = find_columns([*BASE, "isolator_vel_m_s"], {"velocity": "isolator_vel_m_s"})
    assert found["velocity"].conversion == (1e3, 0.0)


def test_a_mapped_role_is_not_ambiguous_and_a_fixed_one_needs_no_column() -> None:
    headers = [*BASE, "load_kN", "current_A", "strom_A"]
    found = find_columns(headers, {"force": "load_kN", "current": "current_A"}, fixed={"current"})
    assert found["force"].header == "load_kN"
    assert "current" not in found


def test_force_may_be_left_out() -> None:
    assert "force" not in find_columns(BASE[:2], require_force=False)


MANY = [f"channel{i}" for i in range(40)]


@pytest.mark.parametrize(
    ("headers", "mapping", "pieces"),
    [
        (BASE[1:], {}, ["no column for time", "displacement_mm, force_N", "wanted time_s", "time=NAME[s]"]),
        (BASE[::2], {}, ["no column for displacement", "wanted displacement_mm"]),
        (BASE[:2], {}, ["no column for force", "wanted force_N"]),
        (MANY, {}, ["channel0, channel1", "(32 more)"]),
        ([*BASE, "load_kN"], {}, ["'force_N' and 'load_kN' both read as force", "force=load_kN"]),
        ([*BASE, "Current [banana]"], {}, ["column 'Current [banana]'", "'banana'", "current", "mA"]),
        ([*BASE[:2], "Force [mm]"], {}, ["column 'Force [mm]'", "unit of displacement, not of force", "kN"]),
        (BASE, {"forec": "force_N"}, ["map names the role 'forec'", "wanted time, displacement"]),
        (BASE, {"force": "forse_N"}, ["column 'forse_N' for force", "nearest: force_N", "one of time_s"]),
        (BASE, {"force": "FORCE_N"}, ["column 'FORCE_N'", "nearest: force_N"]),
        (BASE, {"force": "xyz[kN]"}, ["column 'xyz' for force, which is not there, wanted one of"]),
        (BASE, {"force": "force_N[mm]"}, ["column 'force_N'", "'mm' is a unit of displacement"]),
        (BASE, {"force": "force_N[parsnip]"}, ["'parsnip' is not a known unit of force"]),
        (BASE, {"simulated": "displacement_mm"}, ["'displacement_mm'", "mapped to simulated, but 'mm'"]),
        (BASE, {"simulated": "force_N", "force": "force_N"}, ["mapped to both simulated and force"]),
        (BASE, {"force": ""}, ["map gives '' for force", "wanted the name of a column"]),
    ],
)
def test_errors_say_what_and_what_was_wanted(
    headers: list[str], mapping: dict[str, str], pieces: list[str]
) -> None:
    with pytest.raises(mre_core.InputError) as caught:
        find_columns(headers, mapping, file="a.csv")
    text = str(caught.value)
    assert re.match(r"a\.csv: \S", text)
    assert "\n" not in text
    for piece in pieces:
        assert piece in text
