"""Recordings and settings that cannot be diagnosed: one line that says what is wrong."""

from collections.abc import Callable
from typing import Any, NamedTuple

import mre_core
import numpy as np
import pytest
from missing import campaign, maxwell, record, with_series
from mre_core import Effect, Level, Model, MreError, Recording
from rig import SINH, force_of, made_of

T = np.arange(2000) / 200
GOOD = record(1.0, 4.0)
NOISE = np.random.default_rng(1).normal(size=len(T))


class Case(NamedTuple):
    recordings: Callable[[], Any]
    pieces: list[str]
    options: dict[str, Any] = {}  # noqa: RUF012


def swapped() -> list[Recording]:
    return [with_series(r, displacement=force_of(r), force=r.displacement) for r in campaign(0.0)]


HELD = made_of("sinh", SINH)
MASS = Effect("inertia", "moving mass", {"m": 1.0})
SIZES = {
    name: 1.0 for name in ("displacement", "velocity", "force", "step", "duration", "total", "path", "energy")
}
WITH_MASS = Model("sinh", (Level(None, SINH),), effects=(MASS,), sizes=SIZES)
TWO = Model("sinh", (Level(0.0, SINH), Level(1.0, SINH)))


def moving_at(times: float) -> Recording:
    """With a velocity that is so many times the rate of its displacement."""
    r = record(2.0, 4.0, name="b")
    return Recording(r.time, r.displacement, r.force, velocity=times * r.velocity, name="b")


CASES = {
    "none": Case(list, ["empty list", "at least one"]),
    "twice": Case(lambda: [GOOD, GOOD], ["given twice"]),
    "no force": Case(
        lambda: [GOOD, Recording(T, np.sin(6 * T), None, name="b")], ["recording 'b'", "no force"]
    ),
    "constant force": Case(
        lambda: Recording(T, np.sin(6 * T), np.full_like(T, 3.0), name="a"), ["'a'", "3 N throughout"]
    ),
    "rest": Case(lambda: Recording(T, 1e-3 * NOISE, NOISE + 3 * T, name="a"), ["jumps like noise"]),
    "ramp": Case(lambda: Recording(T, T, 3 * T + NOISE), ["less than one cycle", "at least one full"]),
    "half a cycle": Case(lambda: record(1.0, 4.0).cut(4.0, 4.5), ["less than one cycle"]),
    "there and not back": Case(
        lambda: Recording(T, np.cos(np.pi * T / 10), 3 * np.cos(np.pi * T / 10) + 0.1 * NOISE),
        ["less than one cycle"],
    ),
    "opposite signs": Case(
        lambda: [GOOD, with_series(record(2.0, 4.0, name="b"), force=-force_of(record(2.0, 4.0)))],
        ["recording 'b'", "opposite signs", "turn the sign"],
    ),
    "velocity of the other sign": Case(
        lambda: [GOOD, moving_at(-1.0)],
        ["recording 'b'", "velocity and displacement have opposite signs", "leave the velocity out"],
    ),
    "velocity in another unit": Case(
        lambda: [GOOD, moving_at(1e-3)],
        ["recording 'b'", "covers 0.001 times the way", "in its unit"],
    ),
    "swapped": Case(swapped, ["give out energy", "not swapped"]),
    "too few samples": Case(
        lambda: Recording(T[::100], np.sin(1.3 * T[::100]), np.sin(1.3 * T[::100] + 0.1)),
        ["20 samples for 5 parameters", "at least 25"],
    ),
    "uneven": Case(
        lambda: Recording(T**1.2, np.sin(6 * T), 3 * np.sin(6 * T) + NOISE, name="a"),
        ["'a'", "evenly spaced"],
    ),
    "currents": Case(
        lambda: [GOOD, record(2.0, 4.0, current=1.0)], ["'1Hz_4mm' has no current", "current=VALUE[A]"]
    ),
    "unknown base": Case(lambda: GOOD, ["'cinh'", "sinh, bouc_wen", "model.json"], {"base": "cinh"}),
    "false alarm 0": Case(lambda: GOOD, ["false_alarm is 0", "above 0"], {"false_alarm": 0}),
    "false alarm 0.5": Case(lambda: GOOD, ["false_alarm is 0.5", "below 0.5"], {"false_alarm": 0.5}),
    "false alarm nan": Case(lambda: GOOD, ["false_alarm is nan"], {"false_alarm": float("nan")}),
    "false alarm true": Case(lambda: GOOD, ["false_alarm is True"], {"false_alarm": True}),
    "seed": Case(lambda: GOOD, ["seed is -1"], {"seed": -1}),
    "threads": Case(lambda: GOOD, ["threads is 0"], {"threads": 0}),
    "fixed without values": Case(lambda: GOOD, ["'sinh' and fixed", "model.json"], {"fixed": True}),
    "fixed without current": Case(
        lambda: GOOD, ["several levels", "'1Hz_4mm'"], {"base": TWO, "fixed": True}
    ),
    "no simulation": Case(
        lambda: GOOD, ["'1Hz_4mm' has no simulated force", "simulated_force_N"], {"base": "simulated"}
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_one_clear_line(name: str) -> None:
    case = CASES[name]
    with pytest.raises(MreError) as caught:
        mre_core.diagnose(case.recordings(), **({"seed": 1} | case.options))
    message = str(caught.value)
    assert "\n" not in message
    for piece in case.pieces:
        assert piece in message


def heavy(mass: float) -> list[Recording]:
    """Recordings with a moving mass in kg, from the exact acceleration of steady sines."""
    found = []
    for i, (f, amplitude) in enumerate([(0.5, 4.0), (1.0, 2.0), (2.0, 4.0), (3.0, 4.0), (6.0, 1.0)]):
        r = record(f, amplitude, seed=i, seconds=8.0)
        acceleration = np.gradient(r.velocity, r.time)
        found.append(with_series(r, force=force_of(r) + 1e-3 * mass * acceleration))
    return found


def late(shift: float) -> list[Recording]:
    """Recordings whose force comes late by some seconds."""
    return [with_series(r, force=np.interp(r.time - shift, r.time, force_of(r))) for r in campaign(0.0)]


@pytest.mark.parametrize(
    ("recordings", "effect"), [(heavy(60.0), "inertia"), (late(0.01), "time_delay")], ids=["mass", "delay"]
)
def test_strange_recordings_of_the_catalogue_are_no_errors(recordings: list[Recording], effect: str) -> None:
    # With so much mass the force runs against the displacement in the fastest recording.
    found = mre_core.diagnose(recordings, seed=1)
    assert found.effects[0].id == effect


def test_relaxation_beside_cycles_is_no_error() -> None:
    x = 3 * np.clip(T, 0, 1)
    held = Recording(T, x, 8 * x + 3 * maxwell(T, np.gradient(x, T), 0.4) + 0.3 * NOISE, name="held")
    found = mre_core.diagnose([*campaign()[:3], held], seed=1)
    assert found.verdict in {"missing_physics", "partly_explained"}


def test_one_cycle_is_enough_wherever_it_starts() -> None:
    for start in (0.0, 0.5):
        turn = 2 * np.pi * (T / 10 + start / 2)
        x, v = 3 * np.cos(turn), -0.6 * np.pi * np.sin(turn)
        found = mre_core.diagnose(Recording(T, x, 3 * x + v + 0.1 * NOISE), "kelvin_voigt", seed=1)
        assert found.verdict == "adequate"


def test_a_late_force_of_a_device_with_little_damping_is_named_and_not_refused() -> None:
    def late(frequency: float) -> Recording:
        """A spring that hardly dampens, its force 8 ms late: it seems to give out energy."""
        x = 3 * np.clip(T, 0, 1) * np.sin(2 * np.pi * frequency * T)
        at = 2 * np.pi * frequency * (T - 0.008)
        force = 3 * 4.0 * np.clip(T - 0.008, 0, 1) * np.sin(at)
        noise = 0.02 * np.random.default_rng(round(10 * frequency)).normal(size=T.size)
        return Recording(T, x, force + noise, name=f"{frequency} Hz")

    found = mre_core.diagnose([late(f) for f in (0.5, 1.7, 4.0)], "kelvin_voigt", seed=1)
    assert [effect.id for effect in found.effects] == ["time_delay"], found
