"""A diagnosis as one page for a person: no network, no scripts, everything in the file."""

import io
import re
from collections.abc import Iterable, Sequence
from html import escape
from typing import TYPE_CHECKING

import numpy as np

from .words import interval

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from .diagnosis import Diagnosis, History, MissingEffect

_FIGURES = 3
"""Recordings that are drawn: those with the largest mismatch."""

_STYLE = """
body { font: 16px/1.5 system-ui, sans-serif; max-width: 62rem; margin: 2rem auto; padding: 0 1rem }
h1 { font-size: 1.4rem }
h2 { font-size: 1.1rem; margin-top: 2rem }
table { border-collapse: collapse }
th, td { text-align: left; padding: .2rem .8rem .2rem 0; border-bottom: 1px solid #ddd }
td.number { text-align: right; font-variant-numeric: tabular-nums }
figure { margin: 1rem 0 }
figcaption { color: #555 }
svg { max-width: 100%; height: auto }
"""


_METHOD = """<p>The base model was fitted to all recordings, and every effect of the catalogue was tested
beside it: does it explain more than the noise does, once the parameters of the base model may bend? What was
named was fitted together with the base model, and had to help on data that took no part. Noise is what an
autoregression of each recording's remainder cannot predict.</p>"""


def report(found: "Diagnosis") -> str:
    """Write ``report.html``.

    Parameters
    ----------
    found : Diagnosis
        What to show.

    Returns
    -------
    str
        A whole HTML page. Text from files is escaped.
    """
    sections = [
        f"<h1>{escape(str(found))}</h1>",
        *_effects(found.effects),
        "<h2>Before and after</h2>",
        *_figures(found.histories),
        *_rms(found),
        *_where(found),
        *_absorbed(found),
        *_method(found),
    ]
    head = f'<meta charset="utf-8"><title>Diagnosis: {escape(found.verdict)}</title><style>{_STYLE}</style>'
    body = "\n".join(sections)
    return f'<!DOCTYPE html>\n<html lang="en"><head>{head}</head>\n<body>\n{body}\n</body></html>\n'


def _effects(effects: "Sequence[MissingEffect]") -> Iterable[str]:
    if not effects:
        return
    yield "<h2>What was left out</h2>"
    for effect in effects:
        yield f"<p><b>{escape(effect.id)}</b> ({escape(effect.law)}). {escape(effect.statement)}</p>"
        yield f"<p><code>{escape(effect.equation)}</code> ({escape(effect.reference)})</p>"
        rows = [
            (name, f"{p.value:.5g}", interval(p.low, p.high), p.unit) for name, p in effect.parameters.items()
        ]
        yield _table(("parameter", "value", "95 % interval", "unit"), rows, numbers=(1,))
        if effect.form == "approximate":
            share = f"{100 * effect.lack_of_fit:.2g} %"
            yield f"<p>Its law is not exactly this one: about {share} of the force's rms is left.</p>"
        if effect.indistinguishable_from:
            rest = escape(", ".join(effect.indistinguishable_from))
            yield f"<p>These recordings cannot tell it from {rest}.</p>"


def _figures(histories: "Sequence[History]") -> Iterable[str]:
    from .plots import plot_before_after

    worst = sorted(histories, key=lambda h: -_rms_of(h.measured - h.base))[:_FIGURES]
    for number, history in enumerate(worst):
        name = escape(history.recording)
        caption = f"{name}: force against displacement, and what each model leaves over time."
        drawing = _svg(plot_before_after(history), f"figure{number}")
        yield f"<figure>{drawing}<figcaption>{caption}</figcaption></figure>"


def _svg(figure: "Figure", salt: str) -> str:
    """Drawing to stand in a page: the same bytes each time, names that differ between drawings."""
    import matplotlib

    text = io.StringIO()
    with matplotlib.rc_context({"svg.hashsalt": salt, "svg.fonttype": "none"}):
        figure.savefig(text, format="svg", metadata={"Date": None})
    drawing = text.getvalue()
    drawing = re.sub(r"<metadata>.*?</metadata>", "", drawing[drawing.index("<svg") :], flags=re.DOTALL)
    return re.sub(r'(\bid="|href="#|url\(#)', rf"\g<1>{salt}-", drawing)


def _rms(found: "Diagnosis") -> Iterable[str]:
    rows = [
        (h.recording, f"{_rms_of(h.measured - h.base):.4g}", f"{_rms_of(h.measured - h.final):.4g}")
        for h in found.histories
    ]
    yield _table(("rms error / N", "base model", "with effects"), rows, numbers=(1, 2))
    fit = found.fit
    rows = [
        ("trained on", f"{fit.train_rms_before:.4g}", f"{fit.train_rms_after:.4g}"),
        ("held out", f"{fit.held_out_rms_before:.4g}", f"{fit.held_out_rms_after:.4g}"),
    ]
    yield "<p>Trained without the held-out part:</p>"
    yield _table(("rms error / N", "base model", "with effects"), rows, numbers=(1, 2))
    yield f"<p>The noise has an rms of {fit.noise_rms:.4g} N.</p>"


def _where(found: "Diagnosis") -> Iterable[str]:
    if not found.where:
        return
    yield "<h2>Where the base model misses</h2>"
    rows = [(place["what"], f"{place['strength']:.1f}") for place in found.where]
    yield _table(("place", "strength"), rows, numbers=(1,))
    yield "<p>Strength is in standard deviations of the noise.</p>"


def _absorbed(found: "Diagnosis") -> Iterable[str]:
    yield "<h2>What these recordings would hide</h2>"
    if found.absorbed_detail:
        yield _table(("effect", "why"), [(d["id"], d["why"]) for d in found.absorbed_detail])
    else:
        yield "<p>Nothing of the catalogue that carries 5 % of the force's rms.</p>"


def _method(found: "Diagnosis") -> Iterable[str]:
    yield "<h2>How this was computed</h2>"
    yield _METHOD
    rows = [
        ("base model", found.base + (", parameters kept" if found.fixed else "")),
        ("recordings", ", ".join(found.recordings)),
        ("false-alarm rate", f"{found.false_alarm:g}"),
        ("p-value of the base model's mismatch", f"{found.p_values['base']:.2g}"),
        ("p-value of what is left", f"{found.p_values['rest']:.2g}"),
        ("seed", str(found.seed)),
    ]
    yield _table(("", ""), rows)


def _table(header: Sequence[str], rows: Iterable[Sequence[str]], *, numbers: Sequence[int] = ()) -> str:
    lines = ["<tr>" + "".join(f"<th>{escape(cell)}</th>" for cell in header) + "</tr>"] if any(header) else []
    for row in rows:
        opening = ['<td class="number">' if i in numbers else "<td>" for i in range(len(row))]
        cells = (f"{tag}{escape(cell)}</td>" for tag, cell in zip(opening, row, strict=True))
        lines.append(f"<tr>{''.join(cells)}</tr>")
    return "<table>" + "\n".join(lines) + "</table>"


def _rms_of(error: "NDArray[np.float64]") -> float:
    return float(np.sqrt(np.mean(error**2)))
