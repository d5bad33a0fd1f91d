"""Model files that somebody has tampered with."""

import json
from typing import Any

from .made import SIMULATE, Command, bad_model, content

EFFECT = {"id": "inertia", "law": "moving mass", "parameters": {"m": {"value": 1}}}
SIZES = dict.fromkeys(
    ["displacement", "velocity", "force", "step", "duration", "total", "path", "energy"], 1.0
)


def with_(**entries: Any) -> bytes:
    """A good model with other entries."""
    return content(lambda model: model.update(entries))


def beta(text: str) -> bytes:
    """A good model with another text for the value of beta."""
    return content().replace(b"0.302", text.encode())


def effect(**entries: Any) -> bytes:
    return with_(effects=[EFFECT | entries], sizes=SIZES)


def sizes(**entries: Any) -> bytes:
    return with_(effects=[EFFECT], sizes=SIZES | entries)


STRANGERS = {
    "nested a hundred thousand times": bad_model(b"[" * 100_000, "is not JSON", "nested too deeply"),
    "a number of 400 digits": bad_model(beta("1" + "0" * 400), "beta is 1000", "a finite number"),
    "a number of 5000 digits": bad_model(beta("1" + "0" * 5000), "is not JSON", "4300 digits"),
    "NaN for a number": bad_model(beta("NaN"), "beta is nan", "a finite number"),
    "a truth value for a number": bad_model(beta("true"), "beta is True", "a finite number"),
    "text for a number": bad_model(beta('"stiff"'), "beta is 'stiff'", "a finite number"),
    "a list for a number": bad_model(beta("[1]"), "beta is [1]", "a finite number"),
    "half a character": bad_model(b'{"schema": "\xff"}', "is not JSON", "0xff"),
    "the entry schema twice": bad_model(
        b'{"schema": "mre-core/model/1", "schema": "x"}', "schema is 'x'", "mre-core/model/1"
    ),
    "a pickle": bad_model(b"\x80\x04cposix\nsystem\n(S'touch owned'\ntR.", "is not JSON"),
    "code for a name": bad_model(with_(model="__import__('os').system('x')"), "model is", "sinh"),
    "a path for a name": bad_model(with_(model="../../etc/passwd"), "'../../etc/passwd'", "sinh"),
    "levels that are a word": bad_model(with_(levels="abc"), "not a model"),
    "no level but null": bad_model(with_(levels=None), "not a model"),
    "a current that is NaN": bad_model(
        content().replace(b'"current_A": 1.0', b'"current_A": NaN'), "current of a level is nan"
    ),
    "a current that is a word": bad_model(
        content().replace(b'"current_A": 1.0', b'"current_A": "x"'), "current of a level is 'x'"
    ),
    "a tested range that is a word": bad_model(
        with_(tested={"displacement_mm": "x"}), "tested displacement_mm is 'x'"
    ),
    "a tested range below zero": bad_model(
        with_(tested={"displacement_mm": -1}), "tested displacement_mm is -1", "from 0"
    ),
    "a law of nobody": bad_model(
        with_(laws={"c0": {"law": "x", "at": [1], "value": [1]}}), "the law is 'x'", "linear"
    ),
    "a law with a word": bad_model(
        with_(laws={"c0": {"law": "linear", "at": [1, "b"], "value": [1, 2]}}),
        *("a current of a linear law is 'b'", "a finite number"),
    ),
    "a law over something else": bad_model(with_(over="phase"), "over is 'phase'", "temperature"),
    "an effect of nobody": bad_model(effect(id="magic"), "effect is 'magic'", "inertia"),
    "a law of no effect": bad_model(effect(law="magic"), "law of inertia is 'magic'", "moving mass"),
    "an effect without parameters": bad_model(effect(parameters={}), "parameters of inertia", "m"),
    "an effect of NaN": bad_model(
        effect(parameters={"m": {"value": float("nan")}}), "m of inertia is nan", "a finite number"
    ),
    "an effect without sizes": bad_model(with_(effects=[EFFECT]), "effects and no sizes"),
    "a size below zero": Command(
        SIMULATE, ["sizes have no usable 'step'", "above 0"], {"model.json": sizes(step=-1.0)}
    ),
    "a size of 1e300": Command(
        SIMULATE, ["sizes have no usable 'total'"], {"model.json": sizes(total=1e300)}
    ),
    "a size that is a word": Command(
        SIMULATE, ["sizes have no usable 'force'"], {"model.json": sizes(force="x")}
    ),
    "currents that are one": Command(
        SIMULATE, ["sizes have no usable 'current'", "lowest"], {"model.json": sizes(current=3)}
    ),
    "a beta that overflows": Command(
        SIMULATE, ["cannot be computed", "for these parameters"], {"model.json": beta("1e4")}
    ),
    "fifty million bytes": Command(
        SIMULATE,
        ["model.json: has more than 50000000 bytes", "a smaller file"],
        {"model.json": b" " * 50_000_001},
    ),
    "something else in JSON": bad_model(json.dumps("sinh").encode(), "not a model"),
}
