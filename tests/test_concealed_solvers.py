"""The solution methods against closed forms and other integrators."""

import numpy as np
import pytest
from mre_core.concealed.bench import Bench
from mre_core.concealed.devices import bouc_wen_flow, drawn
from mre_core.concealed.filters import convolved, lag, second_order
from mre_core.concealed.kinematics import Array, rise, sine
from mre_core.concealed.law import drawn_law
from mre_core.concealed.laws.hysteresis import masing
from mre_core.concealed.laws.relaxation import Springpot
from mre_core.concealed.paths import Path, followed, played
from mre_core.concealed.programmes import campaign_of
from mre_core.concealed.track import Track
from scipy.integrate import solve_ivp  # type: ignore[import-untyped]
from scipy.special import gamma  # type: ignore[import-untyped]


def swept() -> tuple[Array, Array, float]:
    """A motion with nested reversals: displacement, velocity, step."""
    h = 1 / 1600
    t = np.arange(0, 6, h)
    jet = rise(t, 0, 0.5) * (sine(t, 0.9).times(5) + sine(t, 2.3, 1.0).times(3))
    return jet.x, jet.v, h


@pytest.mark.parametrize(("sigma", "n"), [(0.7, 1.0), (1.5, 1.4), (0.5, 2.5)])
def test_bouc_wen_is_the_solution_of_its_differential_equation(sigma: float, n: float) -> None:
    x, v, h = swept()
    rho = 0.6
    t = np.arange(len(x)) * h

    def rate(time: float, w: Array) -> Array:
        speed = float(np.interp(time, t, v))
        return rho * (
            speed - sigma * abs(speed) * np.abs(w) ** (n - 1) * w + (sigma - 1) * speed * np.abs(w) ** n
        )

    wanted = solve_ivp(rate, (0, t[-1]), [0.0], t_eval=t, rtol=1e-8, atol=1e-10, max_step=2 * h).y[0]
    found = followed(bouc_wen_flow(sigma, n), Path(x, v, h), rho)
    assert np.max(np.abs(found - wanted)) < 1e-4


def test_masing_is_an_infinite_iwan_system() -> None:
    """The density of the sliders' yield displacements is minus the backbone's second derivative."""
    x, v, h = swept()
    reference = 2.0
    edges = reference * np.expm1(np.linspace(0, np.log(6000), 3001))
    radius = (edges[1:] + edges[:-1]) / 2
    slope = reference / (reference + edges) ** 2
    route = Path(x[::8], v[::8], 8 * h)
    stops = (route.x[:, None] - played(route, radius)) @ -np.diff(slope)
    zero = np.zeros_like(x)
    track = Track(zero, x, v, zero, zero, h, slice(None), 0, 1)
    assert np.max(np.abs(masing(track, reference)[::8] - stops)) < 2e-3


def test_linear_memory_has_its_closed_forms() -> None:
    h, tau, w = 1 / 1600, 0.03, 2 * np.pi * 4
    t = np.arange(0, 3, h)
    late = t > 1
    branch = lag(w * np.cos(w * t), h, tau)
    wanted = np.imag(1j * w * tau / (1 + 1j * w * tau) * np.exp(1j * w * t))
    assert np.max(np.abs(branch - wanted)[late]) < 1e-6
    ringing = second_order(np.sin(w * t), h, 30.0, 0.1)
    r = w / (2 * np.pi * 30)
    wanted = np.imag(np.exp(1j * w * t) / (1 - r**2 + 0.2j * r))
    assert np.max(np.abs(ringing - wanted)[late]) < 1e-6


def test_the_springpot_takes_powers_to_powers() -> None:
    h, order = 1 / 1600, 0.3
    t = np.arange(0, 2, h)
    wanted = gamma(5) / gamma(5 - order) * t ** (4 - order)
    assert np.max(np.abs(convolved(t**4, h, Springpot(order)) - wanted)) < 1e-6 * wanted[-1]


def test_a_compliant_rig_with_a_linear_device_is_a_known_transfer_function() -> None:
    motions, devices = (np.random.default_rng([1, i]) for i in range(2))
    at = Bench(drawn("kelvin_voigt", devices, 8.0), campaign_of("rich", motions, [200.0], None))
    drew = drawn_law("rig_compliance", "spring", np.random.default_rng(1), at.rig())
    size = 0.2
    stiffness = drew.shape["k"] / size
    device = at.device.at(1.0)
    bare, view = at.bare[0], at.show([(drew, size)])[0]
    k, c, offset = device["k0"], device["c0"], device["F0"]
    path = bare.seen.path
    # the whole obeys (k + s) F + c F' = s (k x + c v + F0), here integrated from the recording's own samples
    rate = np.gradient(view.force, path.h)
    left = (k + stiffness) * view.force + c * rate
    right = stiffness * (k * path.x + c * path.v + offset)
    assert np.max(np.abs(left - right)[2:-2]) < 5e-3 * np.max(np.abs(right))
