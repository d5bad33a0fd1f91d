"""A coil current that changes within recordings: noise of its meter, its jumps, and what follows it."""

from collections.abc import Callable

import mre_core
import numpy as np
import pytest
from mre_core import Diagnosis, Recording

Array = np.ndarray[tuple[int], np.dtype[np.float64]]

RATE = 200
FINE = 10
"""Steps of the device between two samples."""


def current_of(kind: str, time: Array, velocity: Array, place: int) -> Array:
    if kind == "sine":
        return 1.5 + 1.2 * np.sin(2 * np.pi * (0.4 + 0.5 * place) * time)
    if kind == "follows":
        # A controller that follows the speed, with kinks where that turns.
        return lagged(2 * np.abs(np.tanh(velocity / 30)), 0.02, time[1])
    if kind == "on and off":
        return np.where(velocity * (velocity + 20 * np.sin(5.7 * time + 1)) > 0, 2.0, 0.0)
    period = 1.3 + 0.05 * place
    levels: Array = np.array([0.0, 2.0, 1.0, 3.0, 0.0, 2.0])[(time / period + 1e-9).astype(int) % 6]
    return levels


def lagged(series: Array, tau: float, step: float) -> Array:
    field = np.empty_like(series)
    field[0], decay = series[0], np.exp(-step / tau)
    for i in range(1, len(series)):
        field[i] = series[i] + (field[i - 1] - series[i]) * decay
    return field


def campaign(
    kind: str,
    force: Callable[[Array, Array, Array], Array],
    seed: int,
    *,
    meter: float = 0.0,
    field: Callable[[Array, float], Array] = lambda current, _: current,
    follows_the_meter: bool = False,
) -> list[Recording]:
    """Make three of random motions; `force(x, v, field)` has one per cent of noise, the meter some A."""
    recordings = []
    for place in range(3):
        rng = np.random.default_rng([seed, place])
        time = np.arange(8 * RATE * FINE) / (RATE * FINE)
        ramp = np.clip(time / 0.5, 0, 1)
        share, slope = ramp**2 * (3 - 2 * ramp), 12 * ramp * (1 - ramp)
        x, v = np.zeros_like(time), np.zeros_like(time)
        for hertz, amplitude in ((0.6, 4.0), (1.2, 3.0), (2.1, 2.0)):
            turn, phase = 2 * np.pi * hertz, rng.uniform(0, 2 * np.pi)
            x += amplitude * np.sin(turn * time + phase)
            v += amplitude * turn * np.cos(turn * time + phase)
        v = share * v + slope * x
        x = share * x
        current = current_of(kind, time, v, place)
        noise = meter * rng.normal(size=8 * RATE)
        if follows_the_meter:
            current = np.maximum(current + np.repeat(noise, FINE), 0)
        measured = force(x, v, field(current, time[1]))[::FINE]
        measured = measured + 0.01 * measured.std() * rng.normal(size=measured.size)
        shown = current[::FINE] + (0 if follows_the_meter else noise)
        recordings.append(
            Recording(time[::FINE], x[::FINE], measured, velocity=v[::FINE], current=shown, name=f"{place}")
        )
    return recordings


def kelvin_voigt(x: Array, v: Array, field: Array) -> Array:
    return (40 + 15 * field) * x + (0.8 + 0.5 * field) * v


def diagnosed(recordings: list[Recording]) -> Diagnosis:
    return mre_core.diagnose(recordings, "kelvin_voigt", seed=1)


def named(found: Diagnosis) -> list[tuple[str, str]]:
    return [(effect.id, effect.law) for effect in found.effects]


@pytest.mark.parametrize("kind", ["sine", "follows", "on and off", "steps"])
@pytest.mark.parametrize("meter", [0.01, 0.04])
def test_noise_of_the_meter_is_no_effect(kind: str, meter: float) -> None:
    found = diagnosed(campaign(kind, kelvin_voigt, 1, meter=meter))
    assert (found.verdict, named(found)) == ("adequate", [])


@pytest.mark.parametrize("kind", ["sine", "steps"])
def test_a_device_that_follows_what_is_fast_keeps_it(kind: str) -> None:
    recordings = campaign(kind, kelvin_voigt, 2, meter=0.05, follows_the_meter=True)
    found = diagnosed(recordings)
    true = 0.01 * np.sqrt(np.mean([recording.force.std() ** 2 for recording in recordings]))  # type: ignore[union-attr]
    assert found.verdict == "adequate"
    assert 0.9 < found.fit.noise_rms / true < 1.1


@pytest.mark.parametrize("meter", [0.0, 0.02])
@pytest.mark.parametrize("tau", [0.005, 0.04])
def test_a_lag_behind_a_current_that_jumps_is_the_whole_answer(tau: float, meter: float) -> None:
    late = campaign("steps", kelvin_voigt, 3, meter=meter, field=lambda i, step: lagged(i, tau, step))
    found = diagnosed(late)
    (effect,) = found.effects
    assert (found.verdict, effect.id, effect.form) == ("missing_physics", "field_lag", "exact")
    tau_i = effect.parameters["tau_i"]
    assert abs(tau_i.value / tau - 1) < 0.1


@pytest.mark.parametrize("kind", ["sine", "steps"])
def test_a_force_at_rest_that_follows_the_current_is_named(kind: str) -> None:
    found = diagnosed(campaign(kind, lambda x, v, i: kelvin_voigt(x, v, i) + 20 * i, 4))
    assert (found.verdict, named(found)) == ("missing_physics", [("field_dependence", "force at rest")])


@pytest.mark.parametrize(
    ("power", "size", "effect", "law"),
    [
        (3, 0.03, "cubic_stiffness", "cubic, with the current"),
        (2, 0.3, "asymmetric_stiffness", "square, with the current"),
    ],
)
def test_a_spring_that_bends_with_the_current_is_named(
    power: int, size: float, effect: str, law: str
) -> None:
    def bent(x: Array, v: Array, field: Array) -> Array:
        return kelvin_voigt(x, v, field) + size * field * x**power

    found = diagnosed(campaign("sine", bent, 5))
    assert (found.verdict, named(found)) == ("missing_physics", [(effect, law)])


@pytest.mark.parametrize(("kind", "meter"), [("sine", 0.1), ("follows", 0.05)])
def test_a_filter_that_smooths_noise_of_the_meter_does_not_rule_out_a_delay(kind: str, meter: float) -> None:
    def late(x: Array, v: Array, field: Array) -> Array:
        force = kelvin_voigt(x, v, field)
        steps = round(0.006 * RATE * FINE)
        return np.concatenate([np.full(steps, force[0]), force[:-steps]])

    found = diagnosed(campaign(kind, late, 6, meter=meter))
    (effect,) = found.effects
    assert {effect.id, *effect.indistinguishable_from} == {"time_delay", "filter_lag"}
