"""Laws of textbooks beside the first of an effect: named as what they are, with an exact form."""

from collections.abc import Callable

import mre_core
import numpy as np
import pytest
from missing import campaign, with_series
from mre_core import Recording
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline  # type: ignore[import-untyped]

Force = Callable[[Recording], NDArray[np.float64]]


def slider(r: Recording) -> NDArray[np.float64]:
    """2 N of friction that is elastic over 0.06 mm."""
    z = np.zeros(len(r))
    for i, step in enumerate(np.diff(r.displacement)):
        z[i + 1] = np.clip(z[i] + step / 0.06, -1, 1)
    return 2.0 * z


def contact(r: Recording) -> NDArray[np.float64]:
    """A spring beyond 3 mm that dissipates by its depth."""
    depth = np.maximum(np.abs(r.displacement) - 3, 0)
    return np.asarray(depth * (6 * np.sign(r.displacement) + 0.15 * r.velocity))


def narrow(r: Recording) -> NDArray[np.float64]:
    """A third of the stiffness is lost within 0.7 mm, with sharp edges."""
    return -4 * r.displacement * np.exp(-((r.displacement / 0.7) ** 6))


def wear(r: Recording) -> NDArray[np.float64]:
    """Softening with the logarithm of the path."""
    path = np.concatenate([[0], np.cumsum(np.abs(np.diff(r.displacement)))])
    elastic = 8 * r.displacement + 10 * np.sinh(0.3 * r.displacement)
    return np.asarray(-0.05 * elastic * np.log1p(path / 2))


def ageing(r: Recording) -> NDArray[np.float64]:
    """Softening by a power of the time: by a third after 13 s."""
    elastic = 8 * r.displacement + 10 * np.sinh(0.3 * r.displacement)
    return np.asarray(elastic * ((1 + r.time / 2) ** -0.2 - 1))


def bristles(r: Recording) -> NDArray[np.float64]:
    """LuGre friction of 2 to 4 N, of bristles of 20 N/mm, in steps of a fortieth of a sample."""
    fine = 40
    time = np.interp(np.arange((len(r) - 1) * fine + 1) / fine, np.arange(len(r)), r.time)
    v = CubicSpline(r.time, r.velocity)(0.5 * (time[1:] + time[:-1]))
    g = 2 + 2 * np.exp(-((v / 8) ** 2))
    z = np.zeros(len(time))
    for i, (speed, held, step) in enumerate(zip(v, g, np.diff(time), strict=True)):
        end = np.sign(speed) * held / 20
        z[i + 1] = end + (z[i] - end) * np.exp(-20 * abs(speed) / held * step)
    return np.asarray(20 * z[::fine])


def loose(r: Recording) -> NDArray[np.float64]:
    """A spring of 2 N/mm that is loose by 0.3 mm to both sides."""
    return np.asarray(2 * (r.displacement - np.clip(r.displacement, -0.3, 0.3)))


def dragging(r: Recording) -> NDArray[np.float64]:
    """The spring of the device is dragged with a play of 0.15 mm, its damper is not."""
    dragged = np.zeros(len(r))
    for i, x in enumerate(r.displacement[1:]):
        dragged[i + 1] = np.clip(dragged[i], x - 0.15, x + 0.15)
    sprung = [8 * x + 10 * np.sinh(0.3 * x) for x in (dragged, r.displacement)]
    return np.asarray(sprung[0] - sprung[1])


def beside_the_middle(r: Recording) -> NDArray[np.float64]:
    """A play of 0.2 mm to both sides of 0.8 mm, in which the device is not moved."""
    off = r.displacement - 0.8
    within = np.abs(off) <= 0.2
    seen = [8 * x + 10 * np.sinh(0.3 * x) for x in (r.displacement - np.clip(off, -0.2, 0.2), r.displacement)]
    return np.asarray(seen[0] - seen[1] - 0.4 * np.where(within, r.velocity, 0.0))


def rebound(r: Recording) -> NDArray[np.float64]:
    """A valve that damps more one way, by 0.05 N s/mm."""
    return np.asarray(0.05 * np.abs(r.velocity))


@pytest.mark.parametrize(
    ("law", "name", "parameters"),
    [
        (bristles, ("stribeck_friction", "LuGre"), {"F_c": 2, "r": 1, "v_s": 8, "z_y": 0.1}),
        (loose, ("backlash", "spring with a dead zone"), {"k_g": 2, "g": 0.3}),
        (beside_the_middle, ("backlash", "dead zone off centre, without damping"), {"g": 0.2, "c": 0.8}),
        (dragging, ("backlash", "play of the spring"), {"g": 0.15}),
        (slider, ("coulomb_friction", "elastic slider"), {"F_c": 2, "z_y": 0.06}),
        (contact, ("end_stop", "both ends with damping"), {"k_c": 6, "c_c": 0.15, "g": 3}),
        (narrow, ("pinching", "edged, stiffness"), {"w": 0.7}),
        (rebound, ("quadratic_damping", "by direction"), {"c_d": 0.05, "p": 1}),
        (ageing, ("creep", "ageing by a power, stiffness"), {"p": 0.2}),
        (wear, ("cyclic_degradation", "path, logarithmic, stiffness"), {"P_c": 2}),
    ],
)
def test_a_law_is_named_with_its_parameters(
    law: Force, name: tuple[str, str], parameters: dict[str, float]
) -> None:
    recordings = [with_series(r, force=np.asarray(r.force) + law(r)) for r in campaign(0.0)]
    found = mre_core.diagnose(recordings, "sinh", seed=1)
    (effect,) = found.effects
    assert (effect.id, effect.law, effect.form) == (*name, "exact")
    assert found.verdict == "missing_physics"
    for symbol, wanted in parameters.items():
        assert effect.parameters[symbol].value == pytest.approx(wanted, rel=0.1)
