"""Units a user may write, and those that must not be taken for one."""

import subprocess
import sys

import mre_core
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mre_core import units

# Factors and offsets by definition of the units, written out here on purpose.
KNOWN = [
    ("time", "s", 1.0, 0.0),
    ("time", "ms", 1e-3, 0.0),
    ("time", "µs", 1e-6, 0.0),
    ("time", "min", 60.0, 0.0),
    ("displacement", "mm", 1.0, 0.0),
    ("displacement", "m", 1e3, 0.0),
    ("displacement", "cm", 10.0, 0.0),
    ("displacement", "um", 1e-3, 0.0),
    ("displacement", "in", 25.4, 0.0),
    ("displacement", "inch", 25.4, 0.0),
    ("displacement", "ft", 304.8, 0.0),
    ("velocity", "mm/s", 1.0, 0.0),
    ("velocity", "mm_s", 1.0, 0.0),
    ("velocity", "m_s", 1e3, 0.0),
    ("velocity", "mm_per_s", 1.0, 0.0),
    ("velocity", "m per s", 1e3, 0.0),
    ("velocity", "mm / s", 1.0, 0.0),
    ("velocity", "mm·s⁻¹", 1.0, 0.0),
    ("velocity", "m s^-1", 1e3, 0.0),
    ("velocity", "in/s", 25.4, 0.0),
    ("velocity", "ft/min", 5.08, 0.0),
    ("force", "N", 1.0, 0.0),
    ("force", " kN ", 1e3, 0.0),
    ("force", "MN", 1e6, 0.0),
    ("force", "Newton", 1.0, 0.0),
    ("force", "kg*m/s²", 1.0, 0.0),
    ("force", "lbf", 4.4482216152605, 0.0),
    ("force", "kip", 4448.2216152605, 0.0),
    ("force", "kips", 4448.2216152605, 0.0),
    ("force", "kgf", 9.80665, 0.0),
    ("simulated", "kN", 1e3, 0.0),
    ("current", "A", 1.0, 0.0),
    ("current", "mA", 1e-3, 0.0),
    ("temperature", "C", 1.0, 0.0),
    ("temperature", "°C", 1.0, 0.0),
    ("temperature", "degC", 1.0, 0.0),
    ("temperature", "deg_C", 1.0, 0.0),
    ("temperature", "Celsius", 1.0, 0.0),
    ("temperature", "K", 1.0, -273.15),
    ("temperature", "degF", 5 / 9, -160 / 9),
    ("temperature", "F", 5 / 9, -160 / 9),
]

NOT_UNITS = [
    ("force", "banana"),
    ("force", "mm"),
    ("force", "kg"),
    ("force", "lb"),
    ("force", "C"),
    ("force", "max"),
    ("force", "10 N"),
    ("force", "2*N"),
    ("force", "N_m"),
    ("force", ""),
    ("force", "%"),
    ("force", "-"),
    ("force", "nan"),
    ("force", "N" * 50),
    ("force", "N\nkN"),
    ("time", "Hz"),
    ("time", "a"),
    ("time", "step"),
    ("displacement", "rod"),
    ("displacement", "link"),
    ("displacement", "point"),
    ("displacement", "pin"),
    ("displacement", "pc"),
    ("displacement", "mm^2"),
    ("displacement", "9^9^9^9"),
    ("velocity", "c"),
    ("velocity", "mm"),
    ("velocity", "m_s2"),
    ("current", "V"),
    ("current", "C"),
    ("temperature", "delta_degC"),
    ("temperature", "A"),
]


@pytest.mark.parametrize(("role", "unit", "factor", "offset"), KNOWN)
def test_known_unit(role: str, unit: str, factor: float, offset: float) -> None:
    found = units.conversion(unit, role)
    assert found.factor == pytest.approx(factor, rel=1e-15)
    assert found.offset == pytest.approx(offset, rel=1e-15)


@pytest.mark.parametrize(("role", "unit"), NOT_UNITS)
def test_refused_unit_is_named_with_role_and_example(role: str, unit: str) -> None:
    assert units.find_conversion(unit, role) is None
    with pytest.raises(mre_core.InputError) as caught:
        units.conversion(unit, role, file="a.csv", column="x")
    text = str(caught.value)
    assert text.startswith("a.csv: column 'x': unit '")
    assert units.ROLES[role].quantity in text
    assert units.ROLES[role].unit in text
    assert "\n" not in text


def test_a_unit_of_something_else_is_told_apart_from_nonsense() -> None:
    with pytest.raises(mre_core.InputError, match="unit 'mm' is a unit of displacement, not of force"):
        units.conversion("mm", "force")
    with pytest.raises(mre_core.InputError, match="unit 'banana' is not a known unit of force"):
        units.conversion("banana", "force")


@given(st.text(max_size=45), st.sampled_from(sorted(units.ROLES)))
def test_no_text_breaks_the_reading_of_units(text: str, role: str) -> None:
    found = units.find_conversion(text, role)
    assert found is None or (found.factor > 0 and np.isfinite(found.offset))


@given(
    st.lists(
        st.sampled_from(["N", "kN", "mm", "m", "s", "A", "degC", "/", "*", "^", "**", "-1", "2", " ", "_"])
    )
)
def test_no_string_of_pieces_breaks_the_reading_of_units(pieces: list[str]) -> None:
    for role in units.ROLES:
        units.find_conversion("".join(pieces), role)


def test_canonical_values_stay_the_same_array() -> None:
    values = np.arange(3.0)
    assert units.conversion("N", "force").apply(values) is values


def test_conversion_of_an_array() -> None:
    converted = units.conversion("degF", "temperature").apply(np.array([32.0, 212.0, -40.0]))
    np.testing.assert_allclose(converted, [0.0, 100.0, -40.0], atol=1e-12)


def test_units_and_tables_load_on_first_use_only() -> None:
    code = "import sys, mre_core.load; sys.exit(bool({'pint', 'pandas'} & set(sys.modules)))"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
