"""Figures as SVG text: the same bytes each time."""

import io
import re
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def inline_svg(figure: "Figure", salt: str) -> str:
    """Drawing to stand in a page.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
        What to draw.
    salt : str
        Prefix of all names in it, which keeps those of several drawings in one page apart.

    Returns
    -------
    str
        An ``svg`` element.
    """
    drawing = _draw(figure, salt)
    drawing = re.sub(r"<metadata>.*?</metadata>", "", drawing[drawing.index("<svg") :], flags=re.DOTALL)
    return re.sub(r'(\bid="|href="#|url\(#)', rf"\g<1>{salt}-", drawing)


def write_svg(figure: "Figure", path: Path, salt: str) -> None:
    """Write a drawing as a file of its own."""
    path.write_text(_draw(figure, salt), encoding="utf-8")


def _draw(figure: "Figure", salt: str) -> str:
    import matplotlib

    text = io.StringIO()
    with matplotlib.rc_context({"svg.hashsalt": salt, "svg.fonttype": "none"}):
        figure.savefig(text, format="svg", metadata={"Date": None})
    return text.getvalue()
