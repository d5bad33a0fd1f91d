"""The compiled models against plain twins, closed forms, and what physics asks of them."""

import math
from collections.abc import Sequence

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mre_core._core import MreError, Recording, classical, models, parameters, simulate
from numpy.typing import NDArray
from reference import models as twin
from reference.models import TABLE_2, Motion, jittered, multisine, sine

Array = NDArray[np.float64]

PROPERTY = settings(derandomize=True, deadline=None, max_examples=60)

# The twins do the same operations in another order. RK4 adds up the rounding of thousands of steps.
RTOL = {"kelvin_voigt": 1e-10, "sinh": 1e-10, "bouc_wen": 1e-9}

SAMPLES: dict[str, list[list[float]]] = {
    "kelvin_voigt": [[0.3, 5.0, 0.1], [0.0, 0.0, -3.0], [7.5, 0.0, 0.0]],
    "sinh": [
        list(TABLE_2),
        [0.0, 30.0, -4.0, 0.6, -2.0],
        [1.2, 0.0, 1e-3, 2.5, 0.0],
        [0.2, 3.0, 1e4, 1e-5, 7.0],
    ],
    "bouc_wen": [
        [0.2, 3.0, 12.0, 1.5, 0.7, 2.0, 0.4],
        [0.0, 0.0, 1.0, 1.0, 0.5, 1.0, 0.0],
        [0.1, 2.0, 5.0, 0.05, 1.0, 1.3, -1.0],
        [0.1, 2.0, 5.0, 6.0, 2.0, 9.7, 0.0],
        [0.0, 1.0, 8.0, 60.0, 0.6, 3.0, 0.0],
        [1.0, 1.0, 0.0, 0.0, 5.0, 40.0, 0.0],
    ],
}


def excitation(motion: Motion, current: Array | float | None = None) -> Recording:
    return Recording(motion.time, motion.displacement, None, velocity=motion.velocity, current=current)


def compiled(model: str, p: Sequence[float], motion: Motion) -> Array:
    return simulate(model, [(None, p)], excitation(motion))


def hysteretic(motion: Motion, rho: float, sigma: float, n: float) -> Array:
    """The variable w alone: kw = 1, nothing else."""
    return compiled("bouc_wen", [0.0, 0.0, 1.0, rho, sigma, n, 0.0], motion)


def assert_agree(found: Array, wanted: Array, rtol: float) -> None:
    # The share of the peak is for the samples at which the terms of the force cancel.
    np.testing.assert_allclose(found, wanted, rtol=rtol, atol=1e-13 * float(np.abs(wanted).max()))


MOTIONS = {
    "sine": sine(2.0, 1.0, 64.0, 3.0),
    "irregular": multisine(3, 4.0, np.arange(0.3, 5.0, 0.45), jittered(1, 128.0, 3.0)),
    "coarse": multisine(4, 3.0, np.arange(0.5, 3.0, 0.5), np.arange(60) / 12.0),
    "shortest": multisine(5, 1.0, np.array([2.0]), jittered(2, 30.0, 8 / 30.0)),
}


def test_names_and_units() -> None:
    assert models() == ["kelvin_voigt", "sinh", "bouc_wen"]
    assert parameters("kelvin_voigt") == [("c0", "N s/mm"), ("k0", "N/mm"), ("F0", "N")]
    assert [name for name, _ in parameters("sinh")] == ["c0", "k0", "alpha", "beta", "F0"]
    assert [name for name, _ in parameters("bouc_wen")] == ["c0", "kx", "kw", "rho", "sigma", "n", "F0"]
    assert dict(parameters("sinh"))["beta"] == dict(parameters("bouc_wen"))["rho"] == "1/mm"


@pytest.mark.parametrize("motion", MOTIONS)
@pytest.mark.parametrize("model", SAMPLES)
def test_force_of_the_twin(model: str, motion: str) -> None:
    for p in SAMPLES[model]:
        found = compiled(model, p, MOTIONS[motion])
        assert_agree(found, twin.MODELS[model](p, MOTIONS[motion]), RTOL[model])


def test_the_bouc_wen_samples_need_many_substeps_and_none() -> None:
    """Otherwise the agreement above would say nothing about sub-steps."""
    largest = {
        max(twin.substeps(p[3], p[4], p[5], motion))
        for p in SAMPLES["bouc_wen"]
        for motion in MOTIONS.values()
    }
    assert min(largest) == 1
    assert max(largest) > 500


@given(
    seed=st.integers(0, 2**32 - 1),
    linear=st.lists(st.floats(0.0, 50.0), min_size=3, max_size=3),
    rho=st.floats(0.01, 10.0),
    sigma=st.floats(0.5, 2.0),
    n=st.floats(1.0, 8.0),
)
@PROPERTY
def test_bouc_wen_of_the_twin_anywhere(
    seed: int, linear: list[float], rho: float, sigma: float, n: float
) -> None:
    motion = multisine(seed, 2.0, np.arange(0.5, 6.0, 0.7), jittered(seed, 50.0, 0.5))
    p = [*linear, rho, sigma, n, 0.25]
    assert_agree(compiled("bouc_wen", p, motion), twin.bouc_wen(p, motion), RTOL["bouc_wen"])


# Levels of current


@pytest.mark.parametrize("model", SAMPLES)
@pytest.mark.parametrize("order", [(0, 1, 2), (2, 0, 1)])
def test_force_between_the_levels_is_linear_in_the_current(model: str, order: tuple[int, ...]) -> None:
    motion = MOTIONS["irregular"]
    levels = [(at, SAMPLES[model][i]) for i, at in enumerate((0.5, 1.0, 3.0))]
    # From below the lowest level to above the highest, through one level exactly.
    current = np.linspace(-0.5, 4.0, len(motion))
    current[7] = 1.0
    found = simulate(model, [levels[i] for i in order], excitation(motion, current))
    assert_agree(found, twin.simulate(model, levels, motion, current), RTOL[model])
    outside = current < 0.5
    np.testing.assert_array_equal(found[outside], compiled(model, levels[0][1], motion)[outside])


def test_a_constant_current_and_several_levels() -> None:
    motion = MOTIONS["sine"]
    levels = [(0.0, SAMPLES["sinh"][0]), (2.0, SAMPLES["sinh"][1])]
    found = simulate("sinh", levels, excitation(motion, 0.5))
    assert_agree(found, twin.simulate("sinh", levels, motion, 0.5), 1e-10)


@pytest.mark.parametrize("current", [None, 0.0, 7.0])
def test_a_single_level_ignores_the_current(current: float | None) -> None:
    motion, p = MOTIONS["sine"], SAMPLES["sinh"][0]
    found = simulate("sinh", [(2.0, p)], excitation(motion, current))
    np.testing.assert_array_equal(found, compiled("sinh", p, motion))


# Closed forms


def test_table_2_over_a_cycle() -> None:
    """Peak force, secant stiffness and energy of the paper's curve; tolerances are half the last digit."""
    rate = 4096.0  # fine enough for the peak between two samples: its force is flat to 1e-5 N
    motion = sine(2.0, 1.0, rate, 1.0)
    force = compiled("sinh", TABLE_2, motion)
    top, bottom = motion.displacement.argmax(), motion.displacement.argmin()
    assert force.max() == pytest.approx(10.99, abs=0.005)
    assert (force[top] - force[bottom]) / 4.0 == pytest.approx(5.040, abs=0.0005)
    energy = float(np.sum(force * motion.velocity)) / rate
    assert energy == pytest.approx(27.95, abs=0.005)
    # Only the dashpot dissipates; the sum over a full period is exact up to rounding.
    assert energy == pytest.approx(math.pi * TABLE_2[0] * 2.0 * math.pi * 2.0**2, rel=1e-12)


def loading(rate: float, fast: float = 3.0) -> Motion:
    """Constant acceleration over 1 s: the velocity is linear, so that only RK4 errs."""
    t = np.arange(round(rate) + 1) / rate
    return Motion(t, 0.2 * t + 0.5 * (fast - 0.2) * t**2, 0.2 + (fast - 0.2) * t)


@pytest.mark.parametrize("sigma", [0.5, 0.8, 1.0, 2.0])
@pytest.mark.parametrize("rho", [0.3, 1.0, 3.0])
def test_monotone_loading_in_closed_form(rho: float, sigma: float) -> None:
    """On the first loading w follows 1 - exp(-rho x) for n = 1 and tanh(rho x) for n = 2, whatever sigma."""
    motion = loading(2048.0)
    # A step has q = rho n (2 sigma - 1) v dt < 0.03; RK4 errs by less than q^4.
    x = motion.displacement
    np.testing.assert_allclose(hysteretic(motion, rho, sigma, 1.0), 1.0 - np.exp(-rho * x), rtol=0, atol=1e-9)
    np.testing.assert_allclose(hysteretic(motion, rho, sigma, 2.0), np.tanh(rho * x), rtol=0, atol=1e-9)


@pytest.mark.parametrize("n", [1.0, 2.0])
@pytest.mark.parametrize("sigma", [0.5, 0.8, 2.0])
def test_unloading_in_closed_form(sigma: float, n: float) -> None:
    """Between the reversal and w = 0, dw/dx = rho (1 + (2 sigma - 1) w^n): here sigma matters."""
    rho, s = 0.4, 2.0 * sigma - 1.0
    t = np.arange(2049) / 1024.0
    motion = Motion(t, 10.0 * t - 5.0 * t**2, 10.0 - 10.0 * t)  # the reversal is a sample
    w = hysteretic(motion, rho, sigma, n)
    back = (t >= 1.0) & (w >= 0.0)
    assert back.sum() > 200
    way = rho * (5.0 - motion.displacement[back])
    top = w[t == 1.0][0]
    if s == 0.0:
        wanted = top - way
    elif n == 1.0:
        wanted = ((1.0 + s * top) * np.exp(-s * way) - 1.0) / s
    else:
        wanted = np.tan(math.atan(math.sqrt(s) * top) - math.sqrt(s) * way) / math.sqrt(s)
    # q < 0.03 as above.
    np.testing.assert_allclose(w[back], wanted, rtol=0, atol=1e-8)


@pytest.mark.parametrize("sigma", [0.5, 1.0, 2.0])
@pytest.mark.parametrize("n", [1.0, 2.0])
def test_order_of_the_integration(n: float, sigma: float) -> None:
    rates = [64.0, 128.0, 256.0, 512.0]
    rho = 1.0
    errors = []
    for rate in rates:
        motion = loading(rate)
        assert max(twin.substeps(rho, sigma, n, motion)) == 1
        exact = (
            1.0 - math.exp(-rho * motion.displacement[-1])
            if n == 1.0
            else math.tanh(rho * motion.displacement[-1])
        )
        errors.append(abs(hysteretic(motion, rho, sigma, n)[-1] - exact))
    # The last error is still hundreds of roundings, the first is in the asymptotic range.
    slope = np.polynomial.polynomial.polyfit(np.log(rates), np.log(errors), 1)[1]
    assert -slope == pytest.approx(4.0, abs=0.1)


def test_substeps_do_the_same_as_samples_between() -> None:
    """Of a velocity that is a parabola, which is met everywhere."""
    t = np.arange(40) / 12.0
    v = 61.3 - 8.0 * t - 12.0 * t**2
    motion = Motion(t, np.arange(40.0), v)
    rho, sigma, n = 4.0, 1.2, 2.5
    counts = twin.substeps(rho, sigma, n, motion)
    assert max(counts) > 10
    times, samples = [0.0], [0] * len(motion)
    for piece, count in zip(twin.pieces(motion), counts, strict=True):
        times.extend(times[-1] + piece.duration * np.arange(1, count + 1) / count)
        samples[piece.sample + 1] = len(times) - 1
    between = np.array(times)
    fine = Motion(between, np.arange(len(times), dtype=float), 61.3 - 8.0 * between - 12.0 * between**2)
    assert max(twin.substeps(rho, sigma, n, fine)) == 1
    w = hysteretic(fine, rho, sigma, n)[samples]
    # Rounding of the inserted times is 1e-16 of 3 s in steps of 1e-3 s.
    np.testing.assert_allclose(hysteretic(motion, rho, sigma, n), w, rtol=0, atol=1e-9)


@pytest.mark.parametrize("n", [1.0, 1.7])
def test_few_samples_a_cycle_are_enough(n: float) -> None:
    """22 samples a cycle against 1,760: the path of straight lines between them would be 0.7 % short."""
    coarse, fine = sine(4.0, 1.0, 22.0, 4.0), sine(4.0, 1.0, 1760.0, 4.0)
    away = hysteretic(coarse, 0.3, 0.8, n) - hysteretic(fine, 0.3, 0.8, n)[::80]
    assert np.abs(away).max() < 1.2e-3


# What physics asks


@given(
    seed=st.integers(0, 2**32 - 1),
    speed=st.floats(-2.0, 2.5),
    rho=st.floats(-3.0, 1.0),
    sigma=st.floats(0.5, 20.0),
    n=st.floats(1.0, 100.0),
)
@PROPERTY
def test_the_hysteretic_variable_stays_within_one(
    seed: int, speed: float, rho: float, sigma: float, n: float
) -> None:
    """Rough motions: velocities without any order on steps of very different length."""
    random = np.random.default_rng(seed)
    v = random.normal(size=100) * 10.0**speed
    t = np.cumsum(10.0 ** random.uniform(-3.0, -1.0, 100))
    motion = Motion(t, np.cumsum(v), v)
    if max(twin.substeps(10.0**rho, sigma, n, motion)) > twin.MOST_SUBSTEPS:
        with pytest.raises(MreError):
            hysteretic(motion, 10.0**rho, sigma, n)
        return
    w = hysteretic(motion, 10.0**rho, sigma, n)
    assert np.abs(w).max() <= 1.0 + 1e-12  # rounding on the plateau, where dw/dt is zero


@given(
    seed=st.integers(0, 2**32 - 1),
    rho=st.floats(0.05, 5.0),
    sigma=st.floats(0.5, 2.0),
    n=st.floats(1.0, 10.0),
)
@PROPERTY
def test_no_energy_comes_out_of_the_hysteresis(seed: int, rho: float, sigma: float, n: float) -> None:
    """From rest, the work done so far is never negative, and a closed loop never gives any back."""
    rate = 1024
    motion = multisine(seed, 2.0, np.array([1.0, 2.0, 3.0]), np.arange(3 * rate + 1) / rate)
    # Rest at first: w starts from zero at any place.
    power = hysteretic(motion, rho, sigma, n) * motion.velocity
    steps = 0.5 * (power[1:] + power[:-1]) / rate
    # The trapezoid errs by (dt^2 / 12) times the bend of the power, about (2 pi 3)^2 of it: 3e-5.
    slack = 1e-4 * float(np.abs(steps).sum())
    assert np.cumsum(steps).min() >= -slack
    assert steps[-rate:].sum() >= -slack


def test_a_yielding_loop_dissipates_four_times_force_and_stroke() -> None:
    """With a sharp, early yield the loop is the parallelogram of Coulomb: W = 4 kw (X - 1 / rho)."""
    motion = sine(2.0, 1.0, 4096.0, 3.0)
    force = hysteretic(motion, 50.0, 0.5, 50.0)
    energy = float(np.sum((force * motion.velocity)[-4096:])) / 4096.0
    # 1 / rho is the yield displacement; the rounded corners of n = 50 are worth 1 % of it.
    assert energy == pytest.approx(4.0 * (2.0 - 0.02), rel=5e-3)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_accuracy_of_sinh(sign: float) -> None:
    """Relative error of 18 units in the last place at most, down to the smallest number there is."""
    x = np.unique(
        np.concatenate([[0.0, 5e-324], np.geomspace(1e-320, 700.0, 20_001), np.linspace(0.0, 30.0, 30_001)])
    )
    motion = Motion(np.arange(len(x), dtype=float), sign * x, np.zeros(len(x)))
    found = compiled("sinh", [0.0, 0.0, 1.0, 1.0, 0.0], motion)
    wanted = np.array([math.sinh(value) for value in sign * x])
    assert found[0] == 0.0
    assert found[1] == sign * 5e-324
    with np.errstate(under="ignore"):
        error = np.abs(found[1:] - wanted[1:]) / np.abs(wanted[1:])
    assert error.max() <= 4e-15


# Bouc-Wen as eq. 1 and 2 of the paper


@given(
    seed=st.integers(0, 2**32 - 1),
    kx=st.floats(0.0, 20.0),
    kw=st.floats(0.1, 50.0),
    rho=st.floats(0.1, 5.0),
    sigma=st.floats(0.5, 2.0),
    n=st.floats(1.0, 5.0),
    scale=st.floats(0.2, 5.0),
)
@PROPERTY
def test_classical_parameters_give_the_same_force(
    seed: int, kx: float, kw: float, rho: float, sigma: float, n: float, scale: float
) -> None:
    motion = multisine(seed, 2.0, np.arange(0.5, 4.0, 0.5), jittered(seed, 64.0, 1.0))
    wanted = compiled("bouc_wen", [0.3, kx, kw, rho, sigma, n, 0.0], motion)
    k0, alpha, a, beta, gamma = classical(kx, kw, rho, sigma, n)
    assert a == 1.0
    assert alpha is not None
    # z is a multiple of w, and RK4 keeps multiples: the same sub-steps give the same force. The bound
    # of z is (A / (beta + gamma))^(1/n); large powers cost digits.
    counts = twin.substeps(rho, sigma, n, motion)
    p = (k0, alpha, a, beta, gamma)
    assert_agree(twin.classical_bouc_wen(p, n, 0.3, counts, motion), wanted, 1e-9)
    # A, beta and gamma are redundant: z times s, A times s, beta and gamma times s^(1 - n).
    assert_agree(twin.classical_bouc_wen(p, n, 0.3, counts, motion, scale), wanted, 1e-9)
    assert -beta <= gamma * (1.0 + 1e-12) <= beta * (1.0 + 1e-12)


def test_classical_parameters_by_hand() -> None:
    # k0 = kx + kw rho, alpha = kx / k0, beta + gamma = rho^n, beta = sigma rho^n.
    assert classical(1.0, 2.0, 3.0, 0.7, 2.0) == pytest.approx((7.0, 1.0 / 7.0, 1.0, 6.3, 2.7), rel=1e-14)
    k0, alpha, *_ = classical(0.0, 0.0, 3.0, 0.7, 2.0)
    assert (k0, alpha) == (0.0, None)  # a ratio of stiffnesses needs a stiffness


# Bad input

RIGHT = SAMPLES["sinh"][0]


def bouc_wen_with(name: str, value: float) -> list[float]:
    p = dict(zip(("c0", "kx", "kw", "rho", "sigma", "n", "F0"), SAMPLES["bouc_wen"][0], strict=True))
    return list((p | {name: value}).values())


BAD: dict[str, tuple[str, list[tuple[float | None, Sequence[float]]], list[str]]] = {
    "unknown model": ("dahl", [(None, RIGHT)], ["model is 'dahl'", "kelvin_voigt, sinh, bouc_wen"]),
    "no level": ("sinh", [], ["levels", "at least one"]),
    "too few values": ("sinh", [(None, RIGHT[:4])], ["parameters of sinh is 4", "5 values"]),
    "too many values": ("kelvin_voigt", [(None, RIGHT)], ["parameters of kelvin_voigt is 5", "3 values"]),
    "wrong count in the second level": ("sinh", [(0.0, RIGHT), (1.0, RIGHT[1:])], ["is 4", "5 values"]),
    "one level twice": ("sinh", [(1.0, RIGHT), (1.0, RIGHT)], ["1 A twice"]),
    "a level without current": ("sinh", [(None, RIGHT), (1.0, RIGHT)], ["current of a level is missing"]),
    "a level at nan": ("sinh", [(math.nan, RIGHT), (1.0, RIGHT)], ["current of a level"]),
    "negative damping": ("sinh", [(None, [-1.0, *RIGHT[1:]])], ["c0 is -1", "from 0"]),
    "negative stiffness": ("kelvin_voigt", [(None, [1.0, -2.5, 0.0])], ["k0 is -2.5", "from 0"]),
    "nan": ("kelvin_voigt", [(None, [1.0, 2.0, math.nan])], ["F0 is NaN", "finite"]),
    "infinite": ("sinh", [(None, [*RIGHT[:4], math.inf])], ["F0 is inf", "finite"]),
    "negative kx": ("bouc_wen", [(None, bouc_wen_with("kx", -1.0))], ["kx is -1", "from 0"]),
    "negative kw": ("bouc_wen", [(None, bouc_wen_with("kw", -1.0))], ["kw is -1", "from 0"]),
    "negative rho": ("bouc_wen", [(None, bouc_wen_with("rho", -1.0))], ["rho is -1", "from 0"]),
    "sigma below a half": ("bouc_wen", [(None, bouc_wen_with("sigma", 0.4999))], ["sigma is 0.4999", "0.5"]),
    "n below one": ("bouc_wen", [(None, bouc_wen_with("n", 0.9))], ["n is 0.9", "from 1"]),
    "overflow": ("sinh", [(None, [0.0, 0.0, 1.0, 1e4, 0.0])], ["force of sinh cannot be computed at"]),
    "too stiff": ("bouc_wen", [(None, bouc_wen_with("rho", 1e6))], ["force of bouc_wen cannot be computed"]),
}


@pytest.mark.parametrize("case", BAD)
def test_bad_input_is_named_in_one_line(case: str) -> None:
    model, levels, pieces = BAD[case]
    with pytest.raises(MreError) as caught:
        simulate(model, levels, excitation(MOTIONS["sine"], 1.0))
    assert isinstance(caught.value, ValueError)
    for piece in pieces:
        assert piece in str(caught.value)
    assert "\n" not in str(caught.value)


def test_several_levels_need_a_current() -> None:
    with pytest.raises(MreError, match="several levels of current, and the recording none"):
        simulate("sinh", [(0.0, RIGHT), (1.0, RIGHT)], excitation(MOTIONS["sine"]))


def test_parameters_of_an_unknown_model() -> None:
    with pytest.raises(MreError, match=r"model is 'nope'.*kelvin_voigt, sinh, bouc_wen"):
        parameters("nope")


def test_a_thousand_substeps_and_not_one_more() -> None:
    """Constant 10 mm/s and 0.01 s: a fifth of rho, rounded up to a power of two, for n = 1, sigma = 0.5."""
    t = 0.01 * np.arange(20, dtype=float)
    motion = Motion(t, 10.0 * t, np.full(20, 10.0))
    assert hysteretic(motion, 4096.0, 0.5, 1.0)[-1] == pytest.approx(1.0, abs=1e-12)
    with pytest.raises(MreError, match="cannot be computed: the samples are too far apart"):
        hysteretic(motion, 4097.0, 0.5, 1.0)
