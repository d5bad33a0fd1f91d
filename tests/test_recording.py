"""What a recording accepts, what it refuses and how it says so, and its parts: cut and transients."""

import math
import warnings
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from mre_core import MreError, Recording
from numpy.typing import NDArray
from reference.models import Motion, jittered, multisine, sine

Array = NDArray[np.float64]

MOTION = sine(2.0, 1.0, 64.0, 3.0)
T, X, F = MOTION.time, MOTION.displacement, 5.0 * MOTION.displacement + 0.1
N = len(T)


def with_one(values: Array, place: int, value: float) -> Array:
    changed = values.copy()
    changed[place] = value
    return changed


# Good input


def test_what_is_given_comes_back() -> None:
    recording = Recording(
        T,
        X,
        F,
        velocity=MOTION.velocity,
        current=np.linspace(0.0, 2.0, N),
        temperature=np.linspace(20.0, 21.0, N),
        simulated=F + 1.0,
        name="3A-1Hz-2mm",
    )
    assert recording.name == "3A-1Hz-2mm"
    assert len(recording) == N
    for found, wanted in (
        (recording.time, T),
        (recording.displacement, X),
        (recording.velocity, MOTION.velocity),
        (recording.force, F),
        (recording.simulated, F + 1.0),
        (recording.current, np.linspace(0.0, 2.0, N)),
        (recording.temperature, np.linspace(20.0, 21.0, N)),
    ):
        np.testing.assert_array_equal(np.asarray(found), wanted)
    assert recording.velocity_window is None
    assert recording.sampling_rate == pytest.approx(64.0, rel=1e-12)
    assert recording.scored == (0, N)


def test_what_is_not_given_is_none() -> None:
    recording = Recording(T, X, None)
    assert recording.force is None
    assert recording.simulated is None
    assert recording.current is None
    assert recording.current_level is None
    assert not recording.current_varies
    assert recording.temperature is None
    assert recording.name == ""
    assert recording.velocity_window is not None


def strided(values: Array) -> Array:
    wide = np.zeros(2 * len(values))
    wide[::2] = values
    return wide[::2]


def backwards(values: Array) -> Array:
    return values[::-1].copy()[::-1]


def read_only(values: Array) -> Array:
    values = values.copy()
    values.flags.writeable = False
    return values


def column(values: Array) -> Array:
    table = np.asfortranarray(np.column_stack([values, np.zeros(len(values))]))
    return table[:, 0]


def row_of_columns(values: Array) -> Array:
    table: Array = np.asfortranarray(np.vstack([values, np.zeros(len(values))]))
    row: Array = table[0]
    return row


KINDS: dict[str, Callable[[Array], Any]] = {
    "list": lambda values: values.tolist(),
    "tuple": lambda values: tuple(values.tolist()),
    "list of numpy scalars": list,
    "big-endian": lambda values: values.astype(">f8"),
    "strided": strided,
    "negative stride": backwards,
    "read-only": read_only,
    "column of a Fortran table": column,
    "row of a Fortran table": row_of_columns,
}


@pytest.mark.parametrize("kind", KINDS)
def test_any_form_of_the_same_numbers(kind: str) -> None:
    made = KINDS[kind]
    recording = Recording(made(T), made(X), made(F), velocity=made(F), current=made(T), simulated=made(X))
    np.testing.assert_array_equal(recording.time, T)
    np.testing.assert_array_equal(recording.displacement, X)
    np.testing.assert_array_equal(recording.velocity, F)
    np.testing.assert_array_equal(np.asarray(recording.force), F)
    np.testing.assert_array_equal(np.asarray(recording.current), T)


@pytest.mark.parametrize("kind", ["f4", ">f4", "f2", "i1", "i8", ">i2", "u2"])
def test_numbers_of_other_types(kind: str) -> None:
    whole = np.arange(20) % 7
    recording = Recording(np.arange(20).astype(kind), whole.astype(kind), whole.astype(kind))
    np.testing.assert_array_equal(recording.displacement, whole)
    assert recording.displacement.dtype == np.float64


def test_float32_is_not_rounded_again() -> None:
    single = X.astype(np.float32)
    np.testing.assert_array_equal(Recording(T, single, F).displacement, single.astype(np.float64))


def test_the_recording_keeps_its_own_copy() -> None:
    mine = X.copy()
    recording = Recording(T, mine, F)
    mine[:] = 0.0
    theirs = recording.displacement
    theirs[:] = 0.0
    np.testing.assert_array_equal(recording.displacement, X)
    with pytest.raises(AttributeError):
        recording.name = "other"  # type: ignore[misc]


def test_eight_samples_are_enough() -> None:
    recording = Recording(T[:8], X[:8], F[:8])
    assert len(recording) == 8
    assert np.isfinite(recording.velocity).all()


def test_sampling_rate_of_irregular_times() -> None:
    t = jittered(1, 100.0, 10.0)
    recording = Recording(t, np.sin(t), np.sin(t))
    # Each period is 0.01 s with a spread of 0.6 / sqrt(6) of it; the median of 999 is good to 3 %.
    assert recording.sampling_rate == pytest.approx(100.0, rel=0.03)


def test_times_that_were_rounded_are_even() -> None:
    t = np.round(np.arange(2000) / 256.0, 3)
    recording = Recording(t, np.sin(t), np.sin(t))
    assert recording.evenly_sampled
    # Of the median step it would be 250 Hz.
    assert recording.sampling_rate == pytest.approx(256.0, rel=1e-4)
    # They are put back on their grid, whose step the rounded ends give nearly.
    np.testing.assert_allclose(np.diff(recording.time), 1 / 256.0, rtol=1e-3)
    np.testing.assert_allclose(recording.time, t, atol=1.1e-3)


def test_times_that_truly_differ_are_left_alone() -> None:
    t = jittered(1, 100.0, 10.0)
    np.testing.assert_array_equal(Recording(t, np.sin(t), np.sin(t)).time, t)


def test_a_gap_is_not_even() -> None:
    t = np.arange(2000) / 256.0 + (np.arange(2000) > 1000) * 0.1
    recording = Recording(t, np.sin(t), np.sin(t))
    assert not recording.evenly_sampled
    assert recording.sampling_rate == pytest.approx(256.0, rel=1e-9)


# Coil current


@pytest.mark.parametrize("level", [0, 2, -1.5, np.float32(0.5)])
def test_a_number_is_a_constant_current(level: float) -> None:
    recording = Recording(T, X, F, current=level)
    assert recording.current == level
    assert recording.current_level == level
    assert not recording.current_varies


@pytest.mark.parametrize("mean", [0.0, 1.0, -3.0])
def test_a_measured_current_is_constant_within_its_scatter(mean: float) -> None:
    """The limit is a standard deviation of 0.01 A + 2 % of the mean; alternating values have it exactly."""
    limit = 0.01 + 0.02 * abs(mean)
    sign = np.where(np.arange(N) % 2 == 0, 1.0, -1.0)
    steady = Recording(T, X, F, current=mean + 0.99 * limit * sign)
    assert not steady.current_varies
    assert steady.current_level == pytest.approx(mean, abs=1e-12)
    changing = Recording(T, X, F, current=mean + 1.01 * limit * sign)
    assert changing.current_varies
    assert changing.current_level is None


# Bad input

NOTHING: Any = [None] * N

BAD: dict[str, tuple[Callable[[], object], list[str]]] = {
    "seven samples": (lambda: Recording(T[:7], X[:7], F[:7]), ["7 samples", "at least 8"]),
    "nothing": (lambda: Recording([], [], []), ["0 samples", "at least 8"]),
    "short displacement": (
        lambda: Recording(T, X[:-1], F),
        [f"displacement has {N - 1} samples", f"time has {N}", "same length"],
    ),
    "long force": (lambda: Recording(T[:-1], X[:-1], F), [f"force has {N} samples", f"time has {N - 1}"]),
    "short velocity": (lambda: Recording(T, X, F, velocity=X[1:]), [f"velocity has {N - 1} samples"]),
    "short current": (lambda: Recording(T, X, F, current=X[1:]), [f"current has {N - 1} samples"]),
    "short temperature": (lambda: Recording(T, X, F, temperature=[20.0]), ["temperature has 1 samples"]),
    "short simulated": (lambda: Recording(T, X, F, simulated=X[1:]), [f"simulated has {N - 1} samples"]),
    "nan in time": (
        lambda: Recording(with_one(T, 5, math.nan), X, F),
        ["time is NaN at sample 5", "finite number"],
    ),
    "nan in displacement": (
        lambda: Recording(T, with_one(X, 0, math.nan), F),
        ["displacement is NaN at sample 0"],
    ),
    "inf in force": (
        lambda: Recording(T, X, with_one(F, N - 1, math.inf)),
        [f"force is inf at sample {N - 1}"],
    ),
    "-inf in velocity": (
        lambda: Recording(T, X, F, velocity=with_one(X, 9, -math.inf)),
        ["velocity is -inf at sample 9"],
    ),
    "nan in current": (
        lambda: Recording(T, X, F, current=with_one(X, 3, math.nan)),
        ["current is NaN at sample 3"],
    ),
    "current is nan": (lambda: Recording(T, X, F, current=math.nan), ["current is NaN"]),
    "temperature is inf": (lambda: Recording(T, X, F, temperature=math.inf), ["temperature is inf"]),
    "nan in simulated": (
        lambda: Recording(T, X, F, simulated=with_one(X, 7, math.nan)),
        ["simulated is NaN at sample 7"],
    ),
    "None among numbers": (lambda: Recording(T, NOTHING, F), ["displacement"]),
    "time stands still": (
        lambda: Recording(with_one(T, 5, T[4]), X, F),
        ["time goes from 0.0625 s to 0.0625 s at sample 5", "increase"],
    ),
    "time runs backwards": (lambda: Recording(T[::-1], X, F), ["time goes from", "at sample 1", "increase"]),
    "no motion": (lambda: Recording(T, np.full(N, 3.0), F), ["displacement is 3 mm throughout", "moving"]),
    "a table": (lambda: Recording(T, X[:, None], F), ["displacement", f"({N}, 1)", "one-dimensional"]),
    "two forces": (lambda: Recording(T, X, np.column_stack([F, F])), ["force", f"({N}, 2)"]),
    "ragged": (lambda: Recording(T, [[1.0], [2.0, 3.0]], F), ["displacement", "one-dimensional"]),
    "words": (lambda: Recording(T, ["a"] * N, F), ["displacement", "numbers"]),
    "a word": (lambda: Recording("T", X, F), ["time is str", "one-dimensional array of numbers"]),
    "a number": (lambda: Recording(1.0, X, F), ["time", "one-dimensional"]),
    "current in words": (lambda: Recording(T, X, F, current="2 A"), ["current is str"]),
    "cut to nothing": (
        lambda: Recording(T, X, F).cut(100.0),
        ["cut is 100 s", "at least 8 samples", "0 s to"],
    ),
    "cut to seven": (lambda: Recording(T, X, F).cut(stop=float(T[6])), ["cut is", "at least 8 samples"]),
    "cut backwards": (lambda: Recording(T, X, F).cut(2.0, 1.0), ["cut is 2 s to 1 s"]),
    "unknown part": (
        lambda: Recording(T, X, F).exclude("start_transient", "noise"),
        ["'noise'", "one of start_transient, stop_transient"],
    ),
}


@pytest.mark.parametrize("case", BAD)
def test_bad_input_is_named_in_one_line(case: str) -> None:
    make, pieces = BAD[case]
    with pytest.raises(MreError) as caught:
        make()
    assert isinstance(caught.value, ValueError)
    for piece in pieces:
        assert piece in str(caught.value)
    assert "\n" not in str(caught.value)


def test_the_name_is_said_first() -> None:
    with pytest.raises(MreError, match=r"^recording '3A-1Hz': force is NaN at sample 4"):
        Recording(T, X, with_one(F, 4, math.nan), name="3A-1Hz")


# What only looks like numbers: a silent conversion would change what is identified.
DISGUISED: dict[str, Callable[[], object]] = {
    "numbers as words": lambda: Recording(T, X.astype(str), F),
    "complex": lambda: Recording(T, X + 1.0j, F),
    "dates": lambda: Recording(np.arange(N).astype("datetime64[s]"), X, F),
    "durations": lambda: Recording(np.arange(N).astype("timedelta64[ns]"), X, F),
    "masked": lambda: Recording(T, np.ma.masked_less(X, 0.0), F),
    "cut at nan": lambda: Recording(T, X, F).cut(math.nan),
}


@pytest.mark.parametrize("case", DISGUISED)
def test_disguised_numbers_are_refused(case: str) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # NumPy's remark about complex numbers is no refusal
        with pytest.raises(MreError):
            DISGUISED[case]()


# Cut


def test_cut_keeps_both_ends() -> None:
    whole = Recording(
        T, X, F, current=np.linspace(0.0, 2.0, N), temperature=T, simulated=F + 1.0, name="a test"
    )
    part = whole.cut(float(T[10]), float(T[99]))
    kept = slice(10, 100)
    np.testing.assert_array_equal(part.time, T[kept])
    np.testing.assert_array_equal(part.displacement, X[kept])
    np.testing.assert_array_equal(np.asarray(part.force), F[kept])
    np.testing.assert_array_equal(np.asarray(part.current), np.linspace(0.0, 2.0, N)[kept])
    np.testing.assert_array_equal(np.asarray(part.temperature), T[kept])
    np.testing.assert_array_equal(np.asarray(part.simulated), F[kept] + 1.0)
    # The velocity at a sample does not depend on what is cut away beside it.
    np.testing.assert_array_equal(part.velocity, whole.velocity[kept])
    assert part.name == "a test"
    assert len(part) == 90
    assert len(whole) == N


def test_cut_at_one_end_or_none() -> None:
    whole = Recording(T, X, F)
    np.testing.assert_array_equal(whole.cut(1.0).time, T[T >= 1.0])
    np.testing.assert_array_equal(whole.cut(stop=1.0).time, T[T <= 1.0])
    np.testing.assert_array_equal(whole.cut().time, T)
    # Between two samples.
    np.testing.assert_array_equal(whole.cut(0.99, 2.01).time, T[(T >= 0.99) & (T <= 2.01)])


# Transients

RAMP_UP, RAMP_DOWN, END = (1.0, 4.0), (11.0, 14.0), 16.0


def rig_test(frequency: float, rate: float, noise: float = 0.0, seed: int = 0) -> tuple[Array, Array]:
    """Rest, ramp up, steady sine of 2 mm, ramp down, rest."""
    t = np.arange(round(rate * END)) / rate
    up = np.clip((t - RAMP_UP[0]) / (RAMP_UP[1] - RAMP_UP[0]), 0.0, 1.0)
    down = np.clip((RAMP_DOWN[1] - t) / (RAMP_DOWN[1] - RAMP_DOWN[0]), 0.0, 1.0)
    x = 2.0 * up * down * np.sin(2.0 * math.pi * frequency * (t - RAMP_UP[0]))
    return t, x + noise * np.random.default_rng(seed).normal(size=len(t))


@pytest.mark.parametrize("noise", [0.0, 0.005, 0.02])
@pytest.mark.parametrize("rate", [50.0, 256.0, 1000.0])
@pytest.mark.parametrize("frequency", [0.5, 1.0, 5.0])
def test_transients_of_a_rig_test(frequency: float, rate: float, noise: float) -> None:
    t, x = rig_test(frequency, rate, noise)
    whole = Recording(t, x, 5.0 * x)
    assert whole.scored == (0, len(t))
    start, stop = whole.exclude("start_transient", "stop_transient").scored
    # A stroke of the ramp is within 10 % of the full one from 0.3 s before the ramp ends; the steady
    # part begins at a reversal, which is up to half a period away from there.
    half = 0.5 / frequency
    assert RAMP_UP[1] - 0.3 - half <= t[start] <= RAMP_UP[1] + half
    assert RAMP_DOWN[0] - half <= t[stop - 1] <= RAMP_DOWN[0] + 0.3 + half
    assert whole.exclude("start_transient").scored == (start, len(t))
    assert whole.exclude("stop_transient").scored == (0, stop)


def test_exclusion_changes_nothing_but_the_scored_samples() -> None:
    t, x = rig_test(1.0, 100.0)
    whole = Recording(t, x, 5.0 * x, current=2.0, name="a test")
    part = whole.exclude("start_transient", "stop_transient")
    assert len(part) == len(whole)
    assert part.name == whole.name
    np.testing.assert_array_equal(part.time, whole.time)
    np.testing.assert_array_equal(part.velocity, whole.velocity)
    np.testing.assert_array_equal(np.asarray(part.force), np.asarray(whole.force))
    assert whole.scored == (0, len(t))
    # One after the other, in any order, and nothing at all.
    first_stop = whole.exclude("stop_transient").exclude("start_transient")
    assert first_stop.scored == part.scored
    assert part.exclude().scored == part.scored


def test_only_the_transient_that_is_there() -> None:
    t, x = rig_test(1.0, 100.0)
    # Steady until its last sample: at most the stroke that the end interrupts is not a full one.
    begun = Recording(t, x, 5.0 * x).cut(stop=10.0)
    start, stop = begun.exclude("start_transient", "stop_transient").scored
    assert t[start] > 3.0
    assert t[stop - 1] >= 10.0 - 0.51


def earthquake(seed: int) -> Motion:
    """Random strokes under an envelope, no two alike."""
    t = np.arange(4000) / 100.0
    motion = multisine(seed, 1.0, np.arange(0.3, 5.0, 0.17), t)
    envelope = np.minimum(t / 4.0, 1.0) * np.exp(-t / 15.0)
    return Motion(t, 30.0 * envelope * motion.displacement, motion.velocity)


@pytest.mark.parametrize("seed", range(10))
def test_an_earthquake_has_no_transients(seed: int) -> None:
    motion = earthquake(seed)
    whole = Recording(motion.time, motion.displacement, motion.displacement)
    assert whole.exclude("start_transient", "stop_transient").scored == (0, len(motion))


def test_a_push_without_reversals_has_no_transients() -> None:
    recording = Recording(T, T, T)
    assert recording.exclude("start_transient", "stop_transient").scored == (0, N)


def test_another_current_changes_nothing_else() -> None:
    recording = Recording(T, X, F, name="run").exclude("start_transient")
    moved = recording.at_current(T + 1.0)
    np.testing.assert_array_equal(moved.current, T + 1.0)
    np.testing.assert_array_equal(moved.velocity, recording.velocity)
    assert (moved.name, moved.scored, moved.velocity_window) == (
        "run",
        recording.scored,
        recording.velocity_window,
    )
    with pytest.raises(MreError, match=r"'run': number of currents is 2: wanted .* one a sample"):
        recording.at_current([1.0, 2.0])
    with pytest.raises(MreError, match=r"'run': current .* NaN"):
        recording.at_current(with_one(T, 3, math.nan))
