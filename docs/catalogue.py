"""The page of the catalogue, made from the code whenever the site is built: a hook of MkDocs."""

import io
from collections import defaultdict
from typing import TYPE_CHECKING, Any, Final

import matplotlib
import mre_core
import numpy as np
from matplotlib.figure import Figure
from mre_core import Effect, Level, Model, Recording, _core

if TYPE_CHECKING:
    from mkdocs.config.defaults import MkDocsConfig
    from mkdocs.structure.files import Files

PAGE: Final = "catalogue.md"

EXAMPLES: Final[dict[str, tuple[str, dict[str, float]]]] = {
    "maxwell_relaxation": ("one branch", {"k_m": 4, "tau": 0.3}),
    "fractional_viscoelasticity": ("springpot", {"c_a": 4, "a": 0.4}),
    "coulomb_friction": ("Dahl", {"F_c": 8, "z_y": 0.1}),
    "stribeck_friction": ("Gaussian", {"F_c": 5, "F_b": 6, "v_s": 5, "z_y": 0.004}),
    "hysteresis": ("Bouc-Wen", {"k_w": 12, "rho": 1, "sigma": 1, "n": 1.5}),
    "inertia": ("moving mass", {"m": 60}),
    "time_delay": ("pure delay", {"d": 0.03}),
    "cubic_stiffness": ("cubic", {"k_3": 0.4}),
    "asymmetric_stiffness": ("square", {"k_2": 1}),
    "quadratic_damping": ("square", {"c_2": 0.02}),
    "mullins_softening": ("Ogden-Roxburgh, stiffness", {"s": 0.5, "x_m": 1, "b": 0.1}),
    "cyclic_degradation": ("path, stiffness", {"s": 0.4}),
    "thermal_softening": ("linear, stiffness", {"s": 0.5, "tau": 20}),
    "payne_softening": ("Kraus, stiffness", {"s": 0.7, "x_c": 2, "t_a": 1, "m": 1}),
    "stiffness_jump": ("stiffness", {"s": 0.4, "t_0": 4, "t_r": 0.2}),
    "pinching": ("centred, stiffness", {"s": 0.8, "w": 1.5}),
    "backlash": ("dead zone", {"g": 0.7}),
    "end_stop": ("both ends", {"k_c": 40, "g": 3}),
    "rig_compliance": ("spring in series", {"f_r": 0.02}),
    "filter_lag": ("force, first order", {"T": 0.03}),
    "creep": ("logarithmic", {"k_c": 1.5, "t_0": 0.1}),
    "field_lag": ("first order", {"tau_i": 0.5}),
    "field_remanence": ("play", {"k_q": 6, "c_q": 0.5, "i_r": 0.3}),
    "field_dependence": ("square", {"k_i": 10, "c_i": 0, "k_i3": 0}),
}
"""A law and parameters for a picture of each effect of the device."""

NOT_OF_THE_DEVICE: Final = {"force_drift", "force_clipping", "mains_interference"}
"""Effects of the measurement, which a simulation of the device leaves out."""

_INTRODUCTION = """# The catalogue

What `mre-core diagnose` can name. This page is made from the code: {effects} effects in {laws} laws.
A picture shows one law: the force of a sinh model in grey, and with the effect in colour, over a motion
of 2 mm, then 4 mm, then 2 mm at 1 Hz. For effects of the coil current the current goes up and down once.
Displacement x in mm, velocity v in mm/s, acceleration a, force F in N, current I in A, time t in s.

"""


def on_files(files: "Files", config: "MkDocsConfig") -> "Files":
    """Add the page and its pictures to the site."""
    from mkdocs.structure.files import File

    files.append(File.generated(config, PAGE, content=page()))
    for name in EXAMPLES:
        files.append(File.generated(config, f"catalogue/{name}.svg", content=picture(name)))
    return files


def page() -> str:
    """Make the page, in Markdown."""
    effects: dict[str, list[dict[str, Any]]] = defaultdict(list)
    for row in _core.catalogue():
        effects[row["id"]].append(row)
    laws = sum(map(len, effects.values()))
    text = _INTRODUCTION.format(effects=len(effects), laws=laws)
    return text + "\n".join(_section(name, rows) for name, rows in effects.items())


def _section(name: str, rows: list[dict[str, Any]]) -> str:
    title = name.replace("_", " ")
    lines = [f"## {title[0].upper()}{title[1:]}", "", f"`{name}`: {rows[0]['plain']}.", ""]
    if name in EXAMPLES:
        law, parameters = EXAMPLES[name]
        units = Effect(name, law, parameters).units
        values = ", ".join(f"{p} = {v:g} {units[p]}".rstrip() for p, v in parameters.items())
        lines += [f"![Loop with and without {title}](catalogue/{name}.svg)", "", f"*{law}: {values}*", ""]
    else:
        lines += [
            "It belongs to the measurement: `mre-core simulate` gives the device's force without it.",
            "",
        ]
    lines += ["| law | equation | parameters | source |", "|---|---|---|---|"]
    for row in rows:
        coefficients, shapes, _ = _core.effect_parameters(name, row["law"])
        symbols = ", ".join(f"`{p}` ({unit})" if unit else f"`{p}`" for p, unit in [*coefficients, *shapes])
        equation = row["equation"].replace("|", "\\|")
        lines.append(f"| {row['law']} | `{equation}` | {symbols} | {row['reference']} |")
    limits = list(dict.fromkeys(row["limit"] for row in rows))
    lines += ["", f"Cannot be told apart: {'; '.join(limits)}.", ""]
    return "\n".join(lines)


def motion(name: str) -> Recording:
    """Make the motion of the pictures."""
    time = np.arange(7 * 256 + 1) / 256
    size = np.interp(time, [0, 2, 2.25, 4.75, 5, 7], [2, 2, 4, 4, 2, 2])
    growth = np.gradient(size, time)
    angle = 2 * np.pi * time
    x, v = size * np.sin(angle), growth * np.sin(angle) + 2 * np.pi * size * np.cos(angle)
    current = 0.5 - 0.5 * np.cos(2 * np.pi * time / 7) if name.startswith("field_") else None
    return Recording(time, x, None, velocity=v, current=current)


def forces(name: str) -> tuple[Recording, Any, Any]:
    """Simulate the device without and with an effect.

    Returns
    -------
    Recording, ndarray, ndarray
        The motion, and both forces in N.
    """
    moved = motion(name)
    soft = {"c0": 0.3, "k0": 5.0, "alpha": 8.0, "beta": 0.3, "F0": 0.0}
    stiff = soft | {"c0": 0.5, "k0": 10.0}
    fields = name.startswith("field_")
    levels = (Level(0.0, soft), Level(1.0, stiff)) if fields else (Level(None, soft),)
    without = mre_core.simulate(Model("sinh", levels), moved)
    v, step = np.abs(moved.velocity), float(moved.time[1])
    sizes = {
        "displacement": float(np.abs(moved.displacement).max()),
        "velocity": float(v.max()),
        "force": float(np.abs(without).max()),
        "step": step,
        "duration": float(moved.time[-1]),
        "total": float(moved.time[-1]),
        "path": float(np.trapezoid(v, moved.time)),
        "energy": float(np.trapezoid(np.abs(without * v), moved.time)),
        "current": [0.0, 1.0] if fields else None,
        "current_varies": fields,
        "quantum": None,
    }
    law, parameters = EXAMPLES[name]
    model = Model("sinh", levels, {}, (Effect(name, law, parameters),), sizes)
    return moved, without, mre_core.simulate(model, moved)


def picture(name: str) -> bytes:
    """Draw both loops, as SVG."""
    moved, without, with_effect = forces(name)
    figure = Figure(figsize=(4.6, 3.2), layout="constrained")
    axis = figure.subplots()
    axis.plot(moved.displacement, without, color="0.65", linewidth=2.2, label="without")
    axis.plot(moved.displacement, with_effect, color="#10375c", linewidth=0.9, label="with")
    axis.set_xlabel("displacement / mm")
    axis.set_ylabel("force / N")
    axis.legend(frameon=False, fontsize="small")
    axis.spines[["top", "right"]].set_visible(False)
    drawn = io.BytesIO()
    with matplotlib.rc_context({"svg.hashsalt": name}):
        figure.savefig(drawn, format="svg", metadata={"Date": None})
    return drawn.getvalue()
