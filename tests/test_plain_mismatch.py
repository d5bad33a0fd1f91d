"""Diagnosis where the base plainly misses: the mismatch is no noise, and real devices are never exact."""

from pathlib import Path

import mre_core
import numpy as np
from mre_core import Recording, simulate
from rig import force_of, made_of

PATTERN = "{amplitude}mm{frequency}Hz{current}A"


def of_the_damper(folder: Path, *names: str) -> list[Recording]:
    files = [folder / "mr-damper-usm" / f"{name}.csv" for name in names]
    loaded = [mre_core.load(file, name_pattern=PATTERN) for file in files]
    return [r.exclude("start_transient", "stop_transient") for r in loaded]


def test_yield_force_of_a_real_damper(real_data: Path) -> None:
    known = of_the_damper(real_data, "5mm3Hz1A", "5mm4Hz1A")
    found = mre_core.diagnose(known, "kelvin_voigt", seed=1)
    assert {e.id for e in found.effects} & {"coulomb_friction", "hysteresis"}
    assert found.verdict == "partly_explained"
    assert found.fit.held_out_rms_after < 0.3 * found.fit.held_out_rms_before


def test_current_withheld_is_something_that_differs_by_recording(real_data: Path) -> None:
    blind = []
    for name in ("5mm3Hz0A", "5mm3Hz0x5A", "5mm3Hz1A"):
        whole = mre_core.load(real_data / "mr-damper-usm" / f"{name}.csv")
        every = slice(None, None, 4)
        slower = Recording(whole.time[every], whole.displacement[every], force_of(whole)[every], name=name)
        blind.append(slower.exclude("start_transient", "stop_transient"))
    found = mre_core.diagnose(blind, "kelvin_voigt", seed=1)
    assert found.unknown is not None
    assert "recording" in {d["on"] for d in found.unknown["depends_on"]}
    ratios = found.unknown["measured_over_model"]
    assert ratios["5mm3Hz0A"] < 0.5 < 1.2 < ratios["5mm3Hz1A"]
    assert "5mm3Hz0A" in found.unknown["statement"]


def slow_noise(seed: int, count: int, size: float) -> np.ndarray:
    """Noise of the first order that forgets over about ten samples."""
    noise, shocks = np.zeros(count), np.random.default_rng(seed).normal(size=count)
    for i in range(1, count):
        noise[i] = 0.9 * noise[i - 1] + shocks[i]
    return size * noise / np.std(noise)


def swept(rate: float = 100.0, seconds: float = 30.0, amplitude: float = 5.0) -> Recording:
    """A sweep that swells from rest, with its true velocity."""
    t = np.arange(0.0, seconds, 1 / rate)
    turn = 2 * np.pi * (0.3 + 0.03 * t) * t
    swell, growth = np.minimum(1.0, t), (t < 1.0).astype(float)
    velocity = amplitude * (growth * np.sin(turn) + swell * np.cos(turn) * 2 * np.pi * (0.3 + 0.06 * t))
    return Recording(t, amplitude * swell * np.sin(turn), np.zeros_like(t), velocity=velocity)


def noisy(force: np.ndarray, moved: Recording, seed: int, size: float) -> Recording:
    measured = force + slow_noise(seed, len(force), size * np.std(force))
    return Recording(moved.time, moved.displacement, measured, velocity=moved.velocity, name=f"r{seed}")


SPRING = made_of("kelvin_voigt", {"c0": 0.4, "k0": 3.0, "F0": 0.0})


def test_large_noise_is_not_taken_for_a_mismatch() -> None:
    moved = swept()
    force = simulate(SPRING, moved)
    found = mre_core.diagnose([noisy(force, moved, seed, 0.1) for seed in (1, 2, 3)], "kelvin_voigt", seed=1)
    assert found.verdict == "adequate", [e.id for e in found.effects]
    assert 0.08 * np.std(force) < found.fit.noise_rms < 0.12 * np.std(force)


def test_a_model_with_effects_is_kept_as_it_is() -> None:
    """Adequate on what it explains; a force channel that is late is all that is found then."""
    moved = swept()
    force = simulate(SPRING, moved) + 3.0 * np.tanh(moved.velocity / 0.5)
    known = [noisy(force, moved, seed, 0.01) for seed in (1, 2, 3)]
    device = mre_core.diagnose(known, "kelvin_voigt", seed=1).model
    assert [e.id for e in device.effects] == ["coulomb_friction"]

    again = mre_core.diagnose(known, device, fixed=True, seed=1)
    assert again.verdict == "adequate", [e.id for e in again.effects]
    assert again.base_model == device

    late = 5
    delayed = [
        Recording(
            r.time[late:],
            r.displacement[late:],
            force_of(r)[:-late],
            velocity=r.velocity[late:],
            name=r.name,
        )
        for r in known
    ]
    found = mre_core.diagnose(delayed, device, fixed=True, seed=1)
    assert [e.id for e in found.effects] == ["time_delay"]
    assert [e.id for e in found.model.effects] == ["coulomb_friction", "time_delay"]
    assert abs(found.effects[0].parameters["d"].value - 0.05) < 0.003
