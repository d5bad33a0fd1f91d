"""Figures of loops against closed forms."""

from typing import Any

import mre_core
import numpy as np
import pytest
from mre_core import Recording
from mre_core.loops.cycles import find_cycles
from numpy.typing import NDArray
from rig import KELVIN_VOIGT, made_of, motion, record

X, RATE = 2.0, 256.0
TURN = 2 * np.pi


def sine(force: Any, *, cycles: float = 3, frequency: float = 1.0, phase: float = 0.0) -> Recording:
    """A sine of X mm with the force given by displacement and velocity."""
    time = np.arange(round(cycles / frequency * RATE) + 1) / RATE
    angle = TURN * frequency * time + phase
    x, v = X * np.sin(angle), X * TURN * frequency * np.cos(angle)
    return Recording(time, x, force(x, v), velocity=v, name="sine")


def only(recording: Recording, **options: Any) -> mre_core.LoopTable:
    (table,) = mre_core.loops(recording, **options)
    return table


def mean(recording: Recording, **options: Any) -> dict[str, float]:
    table = only(recording, **options)
    return {name: row["measured"] for name, row in table.to_dict()["mean"].items()}


@pytest.mark.parametrize(("k", "c", "frequency"), [(5.0, 0.4, 1.0), (40.0, 3.0, 0.25), (2.0, 0.0, 2.0)])
def test_linear_viscoelastic(k: float, c: float, frequency: float) -> None:
    got = mean(sine(lambda x, v: k * x + c * v + 3, frequency=frequency))
    w = TURN * frequency
    peak = X * np.hypot(k, c * w)
    wanted = {
        "effective_stiffness": k,
        "energy": np.pi * c * w * X**2,
        "damping_ratio": c * w / (2 * k),
        "characteristic_strength": c * w * X,
        "post_yield_stiffness": k,
        "storage_stiffness": k,
        "loss_stiffness": c * w,
        "loss_factor": c * w / k,
        "largest_force": peak + 3,
        "smallest_force": 3 - peak,
    }
    assert got == pytest.approx(wanted, rel=2e-3, abs=1e-3 * k)
    by_peak = mean(sine(lambda x, v: k * x + c * v + 3, frequency=frequency), convention="peak_force")
    assert by_peak["effective_stiffness"] == pytest.approx(peak / X, rel=1e-3)
    assert by_peak["damping_ratio"] == pytest.approx(np.pi * c * w * X / (2 * np.pi * peak), rel=1e-3)


def elastoplastic(x: NDArray[np.float64], k: float, strength: float) -> NDArray[np.float64]:
    force = np.zeros_like(x)
    for i in range(1, len(x)):
        force[i] = np.clip(force[i - 1] + k * (x[i] - x[i - 1]), -strength, strength)
    return force


def test_elastoplastic_with_hardening() -> None:
    k1, strength, k2 = 40.0, 12.0, 3.0
    got = mean(sine(lambda x, v: elastoplastic(x, k1, strength) + k2 * x, cycles=6).cut(1.0))
    # The plastic part runs round a parallelogram: height 2 Q, width 2 (X - Q / k).
    energy = 4 * strength * (X - strength / k1)
    stiffness = strength / X + k2
    wanted = {
        "effective_stiffness": stiffness,
        "energy": energy,
        "damping_ratio": energy / (2 * np.pi * stiffness * X**2),
        "characteristic_strength": strength,
        "post_yield_stiffness": k2,
        "loss_stiffness": energy / (np.pi * X**2),
        "largest_force": strength + k2 * X,
        "smallest_force": -strength - k2 * X,
    }
    assert {name: got[name] for name in wanted} == pytest.approx(wanted, rel=5e-3)


def test_the_paper() -> None:
    # Table 2 (0 A, 1 Hz, 2 mm): the two conventions differ by 9 %.
    def force(x: NDArray[np.float64], v: NDArray[np.float64]) -> NDArray[np.float64]:
        return 0.354 * v + 3.572 * x + 4.579 * np.sinh(0.302 * x) + 0.001

    extremes = mean(sine(force, phase=1.0))
    peaks = mean(sine(force, phase=1.0), convention="peak_force")
    assert extremes["effective_stiffness"] == pytest.approx(5.040, abs=2e-3)
    assert peaks["effective_stiffness"] == pytest.approx(5.497, abs=2e-3)
    assert extremes["energy"] == pytest.approx(27.95, abs=0.02)
    assert extremes["damping_ratio"] == pytest.approx(0.2206, abs=2e-4)
    assert peaks["damping_ratio"] == pytest.approx(0.2023, abs=2e-4)


@pytest.mark.parametrize("phase", [0.0, 0.3, 2.0, 3.1, 4.5])
@pytest.mark.parametrize("rate", [20.0, 37.3, 1000.0])
def test_coarse_and_shifted_sampling(phase: float, rate: float) -> None:
    time = np.arange(int(4 * rate)) / rate
    angle = TURN * time + phase
    x, v = X * np.sin(angle), X * TURN * np.cos(angle)
    table = only(Recording(time, x, 5 * x + 0.4 * v, velocity=v))
    assert len(table.measured) == 3
    coarse = 12 / rate**2 + 2e-3  # chords in place of arcs
    assert table.mean("effective_stiffness") == pytest.approx(5, rel=coarse)
    assert table.mean("amplitude") == pytest.approx(X, rel=coarse)
    assert table.mean("energy") == pytest.approx(np.pi * 0.4 * TURN * X**2, rel=coarse)
    assert table.mean("frequency") == pytest.approx(1, rel=coarse)


def test_scaling() -> None:
    one = mean(sine(lambda x, v: 5 * x + 0.4 * v))
    ten = mean(sine(lambda x, v: 50 * x + 4 * v))
    linear = set(one) - {"damping_ratio", "loss_factor"}
    assert ten == pytest.approx({name: one[name] * (10 if name in linear else 1) for name in one})


def test_noise_is_scatter() -> None:
    clean = sine(lambda x, v: 5 * x + 0.4 * v, cycles=40)
    rng = np.random.default_rng(1)
    noisy = Recording(
        clean.time,
        clean.displacement + 0.005 * rng.normal(size=len(clean)),
        np.asarray(clean.force) + 0.2 * rng.normal(size=len(clean)),
        velocity=clean.velocity,
    )
    table = only(noisy)
    assert len(table.measured) == 40
    assert table.mean("energy") == pytest.approx(np.pi * 0.4 * TURN * X**2, rel=0.01)
    assert table.mean("effective_stiffness") == pytest.approx(5, rel=0.01)
    deviation = table.deviation("effective_stiffness")
    assert deviation is not None
    # Two readings with a noise of 0.2 N over a stroke of 4 mm; interpolation takes a part of it.
    assert 0.3 < deviation / (0.2 * np.sqrt(2) / 4) < 1.3


def test_ramps_and_levels() -> None:
    time = np.arange(0, 20, 1 / RATE)
    size = np.interp(time, [0, 3, 8, 10, 16, 20], [0, 2, 2, 4, 4, 0])
    x = size * np.sin(TURN * time)
    cycles = find_cycles(time, x)
    assert [round(c.start) for c in cycles] == [3, 4, 5, 6, 7, 10, 11, 12, 13, 14, 15]


def test_a_part_of_a_period_is_enough_to_compare_with() -> None:
    time = np.arange(0, 12, 1 / RATE)
    x = np.interp(time, [0, 1], [0, 4]) * np.sin(TURN * 0.2 * time)
    # The first of two whole cycles swells; two fifths of a third one repeat the second.
    assert [round(c.start) for c in find_cycles(time, x)] == [5]


def test_one_cycle_and_none() -> None:
    assert len(only(sine(lambda x, v: x, cycles=1)).measured) == 1
    assert only(sine(lambda x, v: x, cycles=1)).deviation("energy") is None
    with pytest.raises(mre_core.InputError, match="'sine' has no closed cycle"):
        mre_core.loops(sine(lambda x, v: x, cycles=0.4))
    rng = np.random.default_rng(0)
    x = np.convolve(rng.normal(size=4000), np.hanning(60), "same")
    with pytest.raises(mre_core.InputError, match="a motion that repeats"):
        mre_core.loops(Recording(np.arange(4000) / 100, x, x))


def test_a_model_beside() -> None:
    model = made_of("kelvin_voigt", KELVIN_VOIGT)
    table = only(record(model, motion()), model=model)
    assert table.model == table.measured
    softer = made_of("kelvin_voigt", KELVIN_VOIGT | {"k0": 4.0})
    table = only(record(model, motion()), model=softer)
    error = table.error("effective_stiffness")
    assert error == pytest.approx(-0.2, rel=1e-3)
    assert table.error("energy") == pytest.approx(0, abs=1e-9)


def test_a_negative_figure_has_a_signed_error() -> None:
    model = made_of("kelvin_voigt", KELVIN_VOIGT)
    moved = motion()
    fading = Recording(moved.time, moved.displacement, -5 * moved.displacement, velocity=moved.velocity)
    assert only(fading, model=model).error("effective_stiffness") == pytest.approx(2, rel=1e-3)


def test_bad_input() -> None:
    with pytest.raises(
        mre_core.InputError, match=r"convention is 'mean', wanted one of displacement_extremes,"
    ):
        mre_core.loops(motion(), convention="mean")  # type: ignore[arg-type]
    with pytest.raises(mre_core.InputError, match="has no force"):
        mre_core.loops(motion(name="m"))
    with pytest.raises(mre_core.InputError, match="have no model"):
        only(sine(lambda x, v: x)).mean("energy", of="model")


def test_measured_damper(real_data: Any) -> None:
    for name, amplitude in (("5mm3Hz0x5A", 4.62), ("25mm0x5Hz1A", 24.81), ("2mm5Hz1A", 1.64)):
        table = only(mre_core.load(real_data / "mr-damper-usm" / f"{name}.csv"))
        assert 8 < len(table.measured) < 12
        assert table.mean("amplitude") == pytest.approx(amplitude, rel=2e-3)
        # Where the motion is a sine, the fundamental carries all the work.
        work = np.pi * table.mean("loss_stiffness") * table.mean("amplitude") ** 2
        assert table.mean("energy") == pytest.approx(work, rel=0.02)
