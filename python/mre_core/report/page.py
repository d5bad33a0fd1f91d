"""From a template and its content to one page that needs nothing else."""

import hashlib
import json
from base64 import b64encode
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING, Any

from .._core import __version__
from ..words import interval

if TYPE_CHECKING:
    from jinja2 import Environment

_SCRIPTS = ("data.js", "panel.js", "draw.js", "viewer.js", "input.js", "controls.js")
_STYLES = ("style.css", "viewer.css")


def render(template: str, **content: Any) -> str:
    """Fill a template of the folder ``page``; text in the content is escaped.

    Parameters
    ----------
    template : str
        File name.
    **content
        What it shows.

    Returns
    -------
    str
        A whole HTML page, which may run no script but its own and load nothing.
    """
    style, script = _bundle(_STYLES), f'(() => {{\n"use strict";\n{_bundle(_SCRIPTS)}}})();\n'
    policy = (
        f"default-src 'none'; style-src 'sha256-{_digest(style)}'; script-src 'sha256-{_digest(script)}';"
        " base-uri 'none'; form-action 'none'"
    )
    page = _environment().get_template(template)
    return page.render(style=style, script=script, policy=policy, **content) + "\n"


@cache
def _environment() -> "Environment":
    from jinja2 import Environment, PackageLoader

    environment = Environment(
        loader=PackageLoader("mre_core.report", "page"), autoescape=True, trim_blocks=True, lstrip_blocks=True
    )
    environment.filters |= {
        "figures": figures,
        "probability": lambda p: "below 1e-300" if p < 1e-300 else figures(p, 2),
        "words": lambda name: str(name).replace("_", " "),
        "first": lambda text: str(text)[:1].upper() + str(text)[1:],
        "indented": lambda content: json.dumps(content, indent=1, ensure_ascii=False),
    }
    environment.globals |= {"interval": interval, "version": __version__}
    environment.tests["nested"] = lambda value: isinstance(value, Mapping | list | tuple)
    return environment


def figures(value: Any, digits: int = 4) -> str:
    """Write a value of a result: a number with some digits, anything else as text."""
    if value is None:
        return "not known"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if not isinstance(value, float):
        return str(value)
    short = f"{value:.{digits}g}"
    return f"{float(short):.0f}" if 1e4 <= abs(value) < 1e7 and "e" in short else short


def _bundle(names: tuple[str, ...]) -> str:
    folder = files("mre_core.report") / "page"
    return "".join((folder / name).read_text(encoding="utf-8") for name in names)


def _digest(text: str) -> str:
    return b64encode(hashlib.sha256(text.encode()).digest()).decode()
