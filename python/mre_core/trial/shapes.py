"""What the files of a trial hold: anybody may have written them."""

from typing import Any, Final

CASES: Final[Any] = [{"id": str, "base": str}]

ANSWER: Final[Any] = {
    "case": {
        "effects": [str],
        "laws": [str],
        "base": str,
        "noise": str,
        "velocity": str,
        "displacement_noise": float,
        "excitation": (str,),
        "samples": (int,),
    },
    "truth": {
        "effects": [{"effect": str, "law": str, "unexplained": float, "parameters": {"*": float}}],
        "noise_rms": float,
        "reached": bool,
    },
    "error_shown": float,
    "recordings_sha256": str,
}
ANSWERS: Final[Any] = {"seed": int, "cases": {"*": ANSWER}}

_ESTIMATE: Final[Any] = {"unit": str, "value": float, "low": (float,), "high": (float,)}
DIAGNOSIS: Final[Any] = {
    "recordings_sha256": str,
    "seconds": float,
    "diagnosis": (
        {
            "verdict": str,
            "effects": [{"id": str, "indistinguishable_from": [str], "parameters": {"*": _ESTIMATE}}],
            "fit": {"held_out_rms_before": (float,), "held_out_rms_after": (float,)},
        },
    ),
}
"""No diagnosis where there was an error."""
