"""Parameters of effects named right, where the law concealed and the law named are the same formula."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import pi
from typing import Any

Given = Mapping[str, float]

_SAME: dict[tuple[str, str], dict[str, str]] = {
    ("maxwell_relaxation", "branch"): {"k_m": "k_m", "tau": "tau"},
    ("fractional_viscoelasticity", "springpot"): {"c_alpha": "c_a", "alpha": "a"},
    ("coulomb_friction", "sign"): {"F_c": "F_c"},
    ("coulomb_friction", "dahl"): {"F_c": "F_c"},
    ("coulomb_friction", "tanh"): {"F_c": "F_c"},
    ("hysteresis", "bouc_wen"): {"k_w": "k_w", "rho": "rho"},
    ("end_stop", "two_sided"): {"k_c": "k_c", "gap": "g"},
    ("end_stop", "one_sided"): {"k_c": "k_c", "gap": "g"},
    ("end_stop", "hertz"): {"k_c": "k_c", "gap": "g"},
    ("backlash", "dead_zone"): {"gap": "g"},
    ("backlash", "series_play"): {"gap": "g"},
    ("quadratic_damping", "quadratic"): {"c": "c_2"},
    ("time_delay", "force"): {"delay": "d"},
    ("filter_lag", "first_order"): {"tau": "T"},
    ("field_lag", "first_order"): {"tau": "tau_i"},
    ("mains_interference", "line_50"): {"line": "f"},
    ("mains_interference", "line_60"): {"line": "f"},
    ("stiffness_jump", "step"): {"depth": "s"},
}
"""Name in the trial to name in the catalogue, by effect and law."""


def _others(effect: str, law: str, given: Given) -> dict[str, float]:
    """Values in the catalogue's terms, where those are not the trial's own."""
    if (effect, law) == ("inertia", "mass"):
        return {"m": 1000 * given["m"]}
    if (effect, law) == ("cubic_stiffness", "cubic"):
        return {"k_3": given["sign"] * given["k_3"]}
    if (effect, law) == ("asymmetric_stiffness", "quadratic"):
        return {"k_2": given["sign"] * given["k_2"]}
    if (effect, law) == ("filter_lag", "butterworth"):
        return {"f_c": 1 / (2 * pi * given["1/w_c"])}
    if (effect, law) == ("force_clipping", "hard"):
        return {"L": given["peak"] * (1 - given["cut"])}
    if (effect, law) == ("rig_compliance", "spring"):
        return {"f_r": given["k/k_r"] / given["k"]}
    return {}


@dataclass(frozen=True)
class Compared:
    """A parameter as it was concealed and as it was found."""

    effect: str
    parameter: str
    unit: str
    truth: float
    found: float
    low: float | None
    high: float | None

    @property
    def error(self) -> float:
        """As a share of the truth."""
        return self.found / self.truth - 1

    @property
    def inside(self) -> bool | None:
        """Whether the 95 % interval holds the truth; None where there is no interval."""
        if self.low is None or self.high is None:
            return None
        return self.low <= self.truth <= self.high


def compared(
    concealed: Sequence[Mapping[str, Any]], found: Sequence[Mapping[str, Any]]
) -> Iterator[Compared]:
    """Compare the parameters of effects that were concealed and named.

    Parameters
    ----------
    concealed : sequence of mapping
        Effects of the answers.
    found : sequence of mapping
        Effects of the diagnosis.

    Yields
    ------
    Compared
        Those of laws that are the same formula in both.
    """
    named = {effect["id"]: effect for effect in found}
    for one in concealed:
        effect, law, given = one["effect"], one["law"], one["parameters"]
        if effect not in named:
            continue
        same = _SAME.get((effect, law), {})
        wanted = {theirs: given[ours] for ours, theirs in same.items()} | _others(effect, law, given)
        for name, truth in wanted.items():
            estimate = named[effect]["parameters"].get(name)
            if estimate is not None:
                yield Compared(
                    effect,
                    name,
                    estimate["unit"],
                    truth,
                    estimate["value"],
                    estimate["low"],
                    estimate["high"],
                )
