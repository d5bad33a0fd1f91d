"""The velocity that a recording makes of its displacement: what it is, and how good it is.

The damping coefficient is where a bad velocity hurts: noise in a regressor pulls its coefficient to zero.
"""

import math
from collections.abc import Callable

import numpy as np
import pytest
from mre_core import Recording
from numpy.polynomial import Chebyshev
from numpy.polynomial.chebyshev import chebvander
from numpy.typing import NDArray
from reference.models import TABLE_2, Motion, jittered, local_slope, multisine, sine, sinh

Array = NDArray[np.float64]

DEGREE = 7

C0, BETA = TABLE_2[0], TABLE_2[3]


def damping(velocity: Array, displacement: Array, force: Array) -> float:
    """Least-squares c0 of the sinh model at the true beta, where the model is linear."""
    rows = np.column_stack([velocity, displacement, np.sinh(BETA * displacement), np.ones(len(force))])
    return float(np.linalg.lstsq(rows, force)[0][0])


def noisy(motion: Motion, size: float, seed: int) -> Motion:
    noise = size * np.random.default_rng(seed).normal(size=len(motion))
    return Motion(motion.time, motion.displacement + noise, motion.velocity)


def rounded(motion: Motion, step: float) -> Motion:
    steps = np.round(motion.displacement / step)
    return Motion(motion.time, step * steps, motion.velocity)


def recorded(shown: Motion, truth: Motion) -> Recording:
    """Displacement as it was measured, with the force of the motion as it was."""
    return Recording(shown.time, shown.displacement, sinh(TABLE_2, truth))


def error_of_damping(recording: Recording) -> float:
    assert recording.force is not None
    return damping(recording.velocity, recording.displacement, recording.force) / C0 - 1.0


def misfit(recording: Recording, truth: Motion) -> float:
    """Rms error of the velocity in shares of its rms."""
    error = recording.velocity - truth.velocity
    return float(np.sqrt(np.mean(error**2) / np.mean(truth.velocity**2)))


def at(time: Array, amplitude: float, frequency: float) -> Motion:
    omega = 2.0 * math.pi * frequency
    return Motion(time, amplitude * np.sin(omega * time), amplitude * omega * np.cos(omega * time))


def sweep(rate: float) -> Motion:
    """0.1 to 10 Hz within 10 s at 2 mm: one window has to do for all of it."""
    t = np.arange(round(10.0 * rate)) / rate
    turn = 2.0 * math.pi
    phase = turn * (0.1 * t + 0.5 * 0.99 * t**2)
    return Motion(t, 2.0 * np.sin(phase), 2.0 * np.cos(phase) * turn * (0.1 + 0.99 * t))


def many_sines(rate: float, duration: float = 20.0) -> Motion:
    """0.2 to 8 Hz."""
    frequencies: Array = 0.2 * np.arange(1, 41, dtype=float)
    return multisine(0, 4.0, frequencies, np.arange(round(duration * rate)) / rate)


def poisson(seed: int, rate: float, duration: float) -> Array:
    """Times as irregular as they get, 10 us apart at least."""
    gaps = np.random.default_rng(seed).exponential(1.0 / rate, round(rate * duration))
    times: Array = np.cumsum(gaps + 1e-5)
    return times


# What it is


@pytest.mark.parametrize("jitter", [False, True])
@pytest.mark.parametrize("noise", [0.0, 0.005, 0.1])
def test_velocity_is_the_slope_of_a_local_polynomial(noise: float, jitter: bool) -> None:
    """With the window of the recording, the twin finds the same velocity, up to the ends."""
    t = jittered(3, 256.0, 2.0) if jitter else np.arange(512) / 256.0
    shown = noisy(at(t, 2.0, 1.0), noise, 0)
    recording = Recording(shown.time, shown.displacement, shown.displacement)
    assert recording.velocity_window is not None
    half = round(0.5 * recording.velocity_window / np.diff(shown.time).mean())
    assert half >= 4
    wanted = local_slope(shown.time, shown.displacement, half)
    # Extrapolation to the ends of long windows multiplies rounding by a few hundreds.
    np.testing.assert_allclose(recording.velocity, wanted, rtol=0, atol=1e-10)


def test_the_window_follows_the_noise() -> None:
    motion = sine(2.0, 1.0, 1000.0, 5.0)
    windows = []
    for noise in (0.0, 0.001, 0.1):
        shown = noisy(motion, noise, 1)
        window = recorded(shown, motion).velocity_window
        assert window is not None
        windows.append(window)
    assert windows == sorted(set(windows))
    # A tenth of a millimetre of 2 mm asks for a good part of a period, but never for a whole one.
    assert windows[-1] < 1.0


@pytest.mark.parametrize("degree", range(1, 8))
@pytest.mark.parametrize("start", [0.0, 1e6])
@pytest.mark.parametrize("jitter", [False, True])
def test_polynomials_up_to_degree_seven_are_exact(degree: int, start: float, jitter: bool) -> None:
    t = jittered(4, 256.0, 2.0) if jitter else np.arange(512) / 256.0
    power = np.polynomial.Polynomial([1.0, -2.0, 3.0, 4.0, -2.0, 0.5, 0.3, -0.2][: degree + 1])
    recording = Recording(start + t, power(t), t)
    # Rounding of the time of 1e-16 * 1e6 s, of the displacement of 1e-14 mm over steps of 4 ms.
    np.testing.assert_allclose(
        recording.velocity, power.deriv()(t), rtol=0, atol=1e-6 if start and jitter else 1e-9
    )


def test_a_ramp_has_its_slope() -> None:
    t = np.arange(500) / 256.0
    recording = Recording(t, 3.0 * t + 1.0, t)
    np.testing.assert_allclose(recording.velocity, 3.0, rtol=1e-12)


@pytest.mark.parametrize("seed", range(5))
def test_eight_samples_of_anything_give_finite_velocities(seed: int) -> None:
    random = np.random.default_rng(seed)
    t = np.cumsum(10.0 ** random.uniform(-4.0, 0.0, 8))
    x = random.normal(size=8)
    for displacement in (x, np.round(x), np.eye(8)[seed]):
        assert np.isfinite(Recording(t, displacement, t).velocity).all()


# How good it is


@pytest.mark.parametrize("rate", [100.0, 256.0, 1000.0, 2048.0])
def test_damping_of_table_2(rate: float) -> None:
    """1 Hz, 2 mm, ten cycles, 5 um of noise: c0 within 1 % however fast it was sampled."""
    motion = sine(2.0, 1.0, rate, 10.0)
    for seed in range(8):
        assert abs(error_of_damping(recorded(noisy(motion, 0.005, seed), motion))) < 0.01


def test_difference_quotients_would_lose_damping() -> None:
    """Otherwise the test above could not fail: central differences lose a third of it at 2048 Hz."""
    motion = sine(2.0, 1.0, 2048.0, 10.0)
    force = sinh(TABLE_2, motion)
    for seed in range(8):
        shown = noisy(motion, 0.005, seed)
        central = np.gradient(shown.displacement, shown.time)
        assert damping(central, shown.displacement, force) < 0.7 * C0


def five_micrometres(motion: Motion, seed: int) -> Motion:
    return noisy(motion, 0.005, seed)


def three_micrometres(motion: Motion, seed: int) -> Motion:
    return noisy(motion, 0.003, seed)


def three_micrometre_steps(motion: Motion, seed: int) -> Motion:
    return rounded(motion, 0.003)


GRADED: dict[str, tuple[Callable[[], Motion], Callable[[Motion, int], Motion]]] = {
    "1 Hz 2 mm, 100 Hz": (lambda: sine(2.0, 1.0, 100.0, 10.0), five_micrometres),
    "1 Hz 2 mm, 2048 Hz": (lambda: sine(2.0, 1.0, 2048.0, 5.0), five_micrometres),
    "1 Hz 4 mm, 256 Hz": (lambda: sine(4.0, 1.0, 256.0, 10.0), five_micrometres),
    "1 Hz 4 mm, 2048 Hz": (lambda: sine(4.0, 1.0, 2048.0, 5.0), five_micrometres),
    "5 Hz 1.6 mm, 200 Hz, steps": (lambda: sine(1.6, 5.0, 200.0, 5.0), three_micrometre_steps),
    "5 Hz 1.6 mm, 1000 Hz, steps": (lambda: sine(1.6, 5.0, 1000.0, 5.0), three_micrometre_steps),
    "4.97 Hz 1.6 mm, 200 Hz, steps": (lambda: sine(1.6, 4.97, 200.0, 5.0), three_micrometre_steps),
    "4.97 Hz 1.6 mm, 1000 Hz, steps": (lambda: sine(1.6, 4.97, 1000.0, 5.0), three_micrometre_steps),
    "5 Hz 1.6 mm, 200 Hz": (lambda: sine(1.6, 5.0, 200.0, 5.0), three_micrometres),
    "5 Hz 1.6 mm, 1000 Hz": (lambda: sine(1.6, 5.0, 1000.0, 5.0), three_micrometres),
    "many sines, 64 Hz": (lambda: many_sines(64.0), five_micrometres),
    "many sines, 100 Hz": (lambda: many_sines(100.0), five_micrometres),
    "many sines, 256 Hz": (lambda: many_sines(256.0), five_micrometres),
    "many sines, 2048 Hz": (lambda: many_sines(2048.0, 5.0), five_micrometres),
    "sweep, 256 Hz": (lambda: sweep(256.0), five_micrometres),
    "sweep, 1000 Hz": (lambda: sweep(1000.0), five_micrometres),
    "10 Hz 1 mm, 100 Hz": (lambda: sine(1.0, 10.0, 100.0, 10.0), five_micrometres),
}


def regular_slopes(motion: Motion, half: int) -> Array:
    """Local polynomials at regular times, by convolution; those of both ends serve half a window each."""
    place = np.arange(-half, half + 1) / half
    solve = np.linalg.pinv(chebvander(place, DEGREE))
    slopes = np.column_stack([Chebyshev.basis(k).deriv()(place) for k in range(DEGREE + 1)]) @ solve
    x, width = motion.displacement, 2 * half + 1
    middle = np.convolve(x, slopes[half][::-1], "valid")
    first, last = slopes[:half] @ x[:width], slopes[-half:] @ x[-width:]
    dt = float(motion.time[1] - motion.time[0])
    found: Array = np.concatenate([first, middle, last]) / (half * dt)
    return found


def best_of_any_window(shown: Motion, truth: Motion) -> float:
    """Least misfit of a local polynomial, the truth being known: a choice from the data cannot do better."""
    scale = float(np.mean(truth.velocity**2))
    widths = np.unique(np.geomspace(4, 0.1 * len(truth), 25).astype(int)).tolist()
    errors = [np.mean((regular_slopes(shown, half) - truth.velocity) ** 2) for half in widths]
    return math.sqrt(float(min(errors)) / scale)


@pytest.mark.parametrize("case", GRADED)
def test_velocity_of_other_motions(case: str) -> None:
    make, disturb = GRADED[case]
    motion = make()
    for seed in range(4):
        shown = disturb(motion, seed)
        recording = recorded(shown, motion)
        off = misfit(recording, motion)
        # The window that predicts the displacement best is narrower than the one best for the slope. The
        # noise of the slope grows with window^-1.5: one of a third of the best width has five times as much.
        assert off < 5.0 * best_of_any_window(shown, motion)
        # Noise in a regressor takes its square off c0, here less than 0.2 %; what is left is for a window
        # too wide, which flattens the velocity and raises c0.
        assert off < 0.045
        assert abs(error_of_damping(recording)) < 0.006


@pytest.mark.parametrize("rate", [256.0, 1000.0, 2048.0])
@pytest.mark.parametrize("times", [jittered, poisson])
def test_velocity_at_irregular_times(times: Callable[[int, float, float], Array], rate: float) -> None:
    motion = at(times(9, rate, 10.0), 2.0, 1.0)
    for seed in range(3):
        recording = recorded(noisy(motion, 0.005, seed), motion)
        # As good as at regular times: 0.3 % at the best window, five times that at a third of it.
        assert misfit(recording, motion) < 0.015
        assert abs(error_of_damping(recording)) < 0.002


def nine_points(angle: float) -> float:
    """Share of a sine's velocity that nine samples find, at `angle` a sample (difference of eighth order)."""
    weights = (4 / 5, -1 / 5, 4 / 105, -1 / 280)
    return 2.0 * sum(w * math.sin((k + 1) * angle) for k, w in enumerate(weights)) / angle


def missed_at_an_end() -> float:
    """What the slope of degree 7 at the end of nine samples misses of u^8 / 8!, the first term it has not."""
    u = np.arange(-4.0, 5.0)
    fitted = Chebyshev.fit(u, u**8, DEGREE).deriv()(4.0)
    return abs(8.0 * 4.0**7 - fitted) / math.factorial(8)


@pytest.mark.parametrize(
    ("frequency", "amplitude", "rate"),
    [(1.0, 2.0, 50.0), (1.0, 2.0, 100.0), (1.0, 2.0, 2048.0), (5.0, 1.6, 200.0), (5.0, 1.6, 1000.0)],
)
def test_smooth_data_without_noise(frequency: float, amplitude: float, rate: float) -> None:
    """As exact as nine samples allow: angle^8 / 630 inside, less exact at the ends."""
    motion = sine(amplitude, frequency, rate, 10.0)
    recording = recorded(motion, motion)
    angle = 2.0 * math.pi * frequency / rate
    assert 1.0 - nine_points(angle) == pytest.approx(angle**8 / 630.0, rel=0.1, abs=1e-12)
    top = float(np.abs(motion.velocity).max())
    # Rounding of 2 mm over one sampling period.
    slack = 1e-14 * rate
    error = np.abs(recording.velocity - motion.velocity) / top
    assert error[4:-4].max() <= 1.01 * angle**8 / 630.0 + slack
    assert error.max() <= 1.1 * missed_at_an_end() * angle**7 + slack


def test_many_sines_without_noise() -> None:
    motion = many_sines(256.0)
    # The fastest, 8 Hz, at nine points; the ends of 20 s are less exact.
    lost = 1.0 - nine_points(2.0 * math.pi * 8.0 / 256.0)
    assert misfit(recorded(motion, motion), motion) < 30.0 * lost < 1e-6


def test_ramps_and_rests_beside_the_steady_part() -> None:
    """Rests ask for wide windows, the sine for narrow ones: the sine is not flattened."""
    for rate in (256.0, 2048.0):
        t = np.arange(round(16.0 * rate)) / rate
        up, down = np.clip((t - 1.0) / 3.0, 0.0, 1.0), np.clip((14.0 - t) / 3.0, 0.0, 1.0)
        slope = ((t > 1.0) & (t < 4.0)) / 3.0 - ((t > 11.0) & (t < 14.0)) / 3.0
        moved = at(t - 1.0, 2.0, 1.0)
        motion = Motion(
            t, up * down * moved.displacement, up * down * moved.velocity + slope * moved.displacement
        )
        for seed in range(3):
            recording = recorded(noisy(motion, 0.005, seed), motion)
            assert misfit(recording, motion) < 0.015
            assert abs(error_of_damping(recording)) < 0.002


# Where it is poor: known limits, so that a change of them is seen


def test_four_samples_a_period_are_too_few() -> None:
    """No window is narrower than nine samples, which lose 1.3 % of the velocity of 22 Hz at 100 Hz."""
    motion = at(np.arange(1000) / 100.0, 1.0, 22.0)
    recording = recorded(noisy(motion, 0.005, 0), motion)
    lost = 1.0 - nine_points(2.0 * math.pi * 22.0 / 100.0)
    assert lost == pytest.approx(0.0125, abs=0.001)
    assert error_of_damping(recording) == pytest.approx(1.0 / (1.0 - lost) - 1.0, abs=0.002)


def test_mains_hum_passes_through() -> None:
    """50 Hz is smooth at 1000 Hz, hence motion: c0 loses the share of the hum in the squared velocity."""
    motion = sine(2.0, 1.0, 1000.0, 10.0)
    hum = at(motion.time, 0.005, 50.0)
    shown = Motion(motion.time, motion.displacement + hum.displacement, motion.velocity)
    share = float(np.mean(hum.velocity**2) / np.mean(motion.velocity**2))
    assert share == pytest.approx(0.0156, abs=1e-3)
    assert -1.05 * share <= error_of_damping(recorded(shown, motion)) <= 0.0


def test_the_corners_of_a_triangle_are_rounded_off() -> None:
    """A jump of the velocity is spread over the window; half of the jump is missed beside it at most."""
    t = np.arange(2560) / 256.0
    phase = (t + 0.05) % 1.0
    motion = Motion(
        t, np.where(phase < 0.5, 8.0 * phase, 8.0 - 8.0 * phase), np.where(phase < 0.5, 8.0, -8.0)
    )
    recording = recorded(noisy(motion, 0.005, 0), motion)
    # 20 corners, 9 samples each: 7 % of the samples are off by about half of the jump of 16 mm/s.
    assert misfit(recording, motion) < 0.2
    assert abs(error_of_damping(recording)) < 0.01
