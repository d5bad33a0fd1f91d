"""The study as one page for a person: no network, no scripts, everything in the file."""

from typing import TYPE_CHECKING

from ..svg import inline_svg

if TYPE_CHECKING:
    from .compose import Study


def page(found: "Study") -> str:
    """Write ``study.html``.

    Parameters
    ----------
    found : Study
        What to show.

    Returns
    -------
    str
        A whole HTML page. Text from files is escaped.
    """
    from jinja2 import Environment, PackageLoader, StrictUndefined
    from markupsafe import Markup

    environment = Environment(
        loader=PackageLoader("mre_core.study", ""),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    drawings = {
        stem: Markup(inline_svg(figure, stem))  # made by Matplotlib, which escapes its text
        for section in found.sections
        for stem, figure in section.figures.items()
    }
    return environment.get_template("page.html").render(study=found, drawings=drawings) + "\n"
