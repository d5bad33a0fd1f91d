"""Model files of other makes, by `mre-core simulate` and `mre-core identify`."""

import json
from typing import Any

from rig import HEADER

from .made import IDENTIFY, SIMULATE, Command, bad_model, content, headed, instead


def two_levels(model: Any) -> None:
    model["levels"].append(json.loads(json.dumps(model["levels"][0])) | {"current_A": 2.0})


def without_beta(model: Any) -> None:
    del model["levels"][0]["parameters"]["beta"]


def negative_damping(model: Any) -> None:
    model["levels"][0]["parameters"]["c0"]["value"] = -1.5


def infinite_beta(model: Any) -> None:
    model["levels"][0]["parameters"]["beta"]["value"] = float("inf")


def text_for_k0(model: Any) -> None:
    model["levels"][0]["parameters"]["k0"]["value"] = "stiff"


def warm(model: Any) -> None:
    """Stiffness over a recorded temperature."""
    names = ("displacement", "velocity", "force", "step", "duration", "total", "path", "energy")
    model["sizes"] = dict.fromkeys(names, 1.0) | {"temperature": [10.0, 40.0]}
    law = {"id": "thermal_softening", "law": "recorded temperature, stiffness"}
    model["effects"] = [law | {"parameters": {"s": {"value": 0.4, "unit": ""}}}]


MODELS = {
    "model missing": Command(
        ["simulate", "no.json", *SIMULATE[2:]], ["no.json: cannot be read: No such file"]
    ),
    "model is a folder": Command(["simulate", ".", *SIMULATE[2:]], [".: cannot be read: Is a directory"]),
    "model is not JSON": bad_model(b"{", "is not JSON"),
    "model is a list": bad_model(b"[1]", "not a model", "mre-core/model/1"),
    "other schema": bad_model(
        content(lambda m: m.update(schema="x/9")), "schema is 'x/9'", "mre-core/model/1"
    ),
    "no levels": bad_model(content(lambda m: m.update(levels=[])), "no levels", "at least one"),
    "parameter missing": bad_model(content(without_beta), "c0, k0, alpha, F0", "c0, k0, alpha, beta, F0"),
    "value not admissible": bad_model(content(negative_damping), "c0 is -1.5", "from 0"),
    "value is infinite": bad_model(content(infinite_beta), "beta is inf", "finite"),
    "value is text": bad_model(content(text_for_k0), "'stiff'"),
    "unknown model in a file": bad_model(content(lambda m: m.update(model="cinh")), "'cinh'", "sinh"),
    "effects": bad_model(content(lambda m: m.update(effects=[{"id": "inertia"}])), "effects"),
    "start is not JSON": Command([*IDENTIFY, "--model", "m.json"], ["m.json: is not JSON"], {"m.json": b"x"}),
    "several levels and no current": Command(
        SIMULATE, ["recording 'a'", "several levels", "current=VALUE[A]"], {"model.json": content(two_levels)}
    ),
    "a law over the temperature and none": Command(
        SIMULATE, ["recording 'a'", "temperature=VALUE[degC]"], {"model.json": content(warm)}
    ),
    "simulate without displacement": Command(
        SIMULATE, ["a.csv: ", "no column for displacement"], {"a.csv": headed("time_s,x,force_N")}
    ),
    "simulate without out": Command(SIMULATE[:3], ["--out"]),
    "simulate over a folder": Command(
        [*SIMULATE[:2], ".", *SIMULATE[3:]], [".: is a folder", "one of the files"]
    ),
    "simulate over two recordings": Command(
        SIMULATE, ["a.csv: holds 2 recordings: a#1, a#2"], {"a.csv": 2 * (instead(1, HEADER) + b"\n")}
    ),
    "simulate a force": Command([*SIMULATE[:2], "model.json", *SIMULATE[3:]], ["model.json: "]),
}
