"""Sentences about a diagnosis."""

from dataclasses import replace
from typing import Any

import pytest
from mre_core import words
from rig import diagnosed

FIT = {"held_out_rms_before": 3.2, "held_out_rms_after": 1.02, "noise_rms": 1.0}


@pytest.mark.parametrize(
    ("kind", "effects", "pieces"),
    [
        ("adequate", [], ["base model sinh", "down to their noise (rms 1 N)"]),
        ("missing_physics", ["inertia"], ["leaves out inertia: with it", "falls from 3.2 N to 1.02 N"]),
        ("missing_physics", ["inertia", "creep"], ["inertia and creep: with them", "noise has 1 N"]),
        ("inexact", ["inertia"], ["what inertia comes nearest to, in a form", "with it"]),
        ("inexact", ["inertia", "creep"], ["inertia and creep come nearest to", "with them"]),
        ("partly_explained", ["a", "b", "c"], ["a, b and c: with them", "a mismatch is left"]),
        ("unexplained", [], ["no effect of the catalogue explains", "3.2 N", "1 N"]),
    ],
)
def test_verdict(kind: str, effects: list[str], pieces: list[str]) -> None:
    sentence = words.verdict(kind, "sinh", effects, FIT)
    assert sentence.endswith(".")
    for piece in pieces:
        assert piece in sentence


def test_a_rise_is_no_fall() -> None:
    worse = FIT | {"held_out_rms_after": 4.0}
    assert "rises from 3.2 N to 4 N" in words.verdict("missing_physics", "sinh", ["inertia"], worse)
    assert words.verdict("adequate", "simulated", [], FIT).startswith("The given simulation explains")


def test_a_name_that_worsens_held_out_data_is_the_nearest_one() -> None:
    found = diagnosed(("coulomb_friction",), ("sign",), "kelvin_voigt", "white", 2.0, 5, 4000)
    assert found.verdict == "missing_physics" and found.effects
    hint = replace(found, verdict="partly_explained", p_values={**found.p_values, "rest": 0.5})
    assert "comes nearest to" in str(hint)
    assert words.WORSE in str(hint)
    assert words.WORSE not in str(replace(hint, p_values={**found.p_values, "rest": 0.0}))


HARMONIC = {"kind": "harmonic", "recording": "a", "harmonic": 1, "drive_hz": 3.0, "in_phase": 0.99}
PLACES: list[tuple[dict[str, Any], list[str]]] = [
    ({"kind": "time", "recording": "a", "from": 2.0, "to": 3.0}, ["In 'a' around 2.5 s", "before and after"]),
    ({"kind": "state", "x_mm": [-2, 1], "v_mm_s": [0, 40]}, ["Between -2 mm and 1 mm, moving up"]),
    ({"kind": "state", "x_mm": [-2, 1], "v_mm_s": [-40, 0]}, ["moving down"]),
    ({"kind": "state", "x_mm": [-2, 1], "v_mm_s": [-40, 40]}, ["Between -2 mm and 1 mm: "]),
    (HARMONIC, ["at the frequency of its drive (3 Hz)", "as a stiffness"]),
    (HARMONIC | {"in_phase": 0.1}, ["as a damping"]),
    (HARMONIC | {"harmonic": 3}, ["at 3 times the frequency", "(9 Hz)"]),
    ({"kind": "recording", "recording": "a", "damping": True}, ["In 'a' as a whole", "damping"]),
    ({"kind": "recording", "recording": "a", "damping": False}, ["stiffness"]),
]


@pytest.mark.parametrize(("found", "pieces"), PLACES)
def test_places(found: dict[str, Any], pieces: list[str]) -> None:
    for piece in pieces:
        assert piece in words.mismatch(found)


def test_intervals() -> None:
    assert words.interval(1.0, 2.5) == "1 to 2.5"
    assert words.interval(None, 2.5) == "at most 2.5"
    assert words.interval(0.0, None) == "0 or more"
    assert words.interval(None, None) == "not determined"
