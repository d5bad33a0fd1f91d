"""One page a case: what was withheld, what the tool said, before and after."""

from collections.abc import Iterator
from pathlib import Path

import mre_core
import numpy as np
from cases import Proof
from mre_core.plots import plot_before_after


def answered(proof: Proof) -> str:
    """Tell whether the question of the case was answered: named, and what was put in right within 10 %.

    `as a rival` where the recordings cannot tell the answer from the effect that was named.
    """
    unknown = proof.diagnosis.unknown or {"depends_on": []}
    named = {effect.id for effect in proof.diagnosis.effects} | {d["on"] for d in unknown["depends_on"]}
    rivals = {rival for effect in proof.diagnosis.effects for rival in effect.indistinguishable_from}
    if not named & set(proof.expected):
        return "as a rival" if rivals & set(proof.expected) else "no"
    return "yes" if all(abs(error) <= 0.1 for *_, error in sizes(proof)) else "in part"


def sizes(proof: Proof) -> Iterator[tuple[str, float, float, float]]:
    """Name, wanted, found, and the error as a share of what was put in; an amplitude has two parts."""
    for (effect, names), true in proof.sizes.items():
        parts = [
            estimate.value
            for one in proof.diagnosis.effects
            if one.id == effect
            for name, estimate in one.parameters.items()
            if name.split("(")[0] in names.split(", ")
        ]
        if parts:
            found = float(np.hypot.reduce(parts)) if len(parts) > 1 else parts[0]
            yield f"{names} of {effect}", true, found, (found - true) / proof.put_in[names]


def write(proof: Proof, folder: Path) -> None:
    """Page and figure."""
    figure = f"{proof.name}.png"
    found = proof.diagnosis
    worst = max(found.histories, key=lambda h: float(np.mean((h.measured - h.base) ** 2)))
    plot_before_after(worst).savefig(folder / figure, dpi=75)
    text = "\n\n".join(_paragraphs(proof, f"![{worst.recording}]({figure})"))
    (folder / f"{proof.name}.md").write_text(text + "\n", encoding="utf-8")


def _paragraphs(proof: Proof, figure: str) -> Iterator[str]:
    found = proof.diagnosis
    yield f"# {proof.title}"
    yield f"**Withheld.** {proof.withheld}"
    wanted = "; ".join(f"`{name}` ({why})" for name, why in proof.expected.items())
    yield f"**Would answer it:** {wanted}. **Answered:** {answered(proof)}."
    yield f"**What the tool said** (base `{found.base}`, seed {found.seed}): {found.verdict}. {found}"
    for effect in found.effects:
        yield f"- `{effect.id}` ({effect.law}; form {effect.form}): {effect.statement}"
        rows = [
            f"| {name} | {p.value:.5g} | {_end(p.low)} to {_end(p.high)} | {p.unit} |"
            for name, p in list(effect.parameters.items())[:8]
        ]
        if rows:
            yield "\n".join(["| parameter | value | 95 % interval | unit |", "|---|---:|---:|---|", *rows])
        if effect.indistinguishable_from:
            yield f"Not to be told from: {', '.join(effect.indistinguishable_from)}."
    if found.unknown:
        yield f"**Unexplained:** {found.unknown['statement']}"
    if found.where:
        yield "**Where:**"
        yield "\n".join(f"- {place['what']}" for place in found.where[:5])
    true = [f"| {name} | {t:.5g} | {f:.5g} | {100 * error:+.1f} % |" for name, t, f, error in sizes(proof)]
    if true:
        head = "| parameter | put in | found | error over what was put in |"
        yield "\n".join([head, "|---|---:|---:|---:|", *true])
    yield figure
    fit = found.fit
    rows = [
        f"| training | {fit.train_rms_before:.4g} | {fit.train_rms_after:.4g} |",
        f"| held out of the fit | {fit.held_out_rms_before:.4g} | {fit.held_out_rms_after:.4g} |",
    ]
    for recording in proof.held_out:
        force = np.asarray(recording.force)[slice(*recording.scored)]
        errors = [
            float(np.sqrt(np.mean((force - mre_core.simulate(m, recording)[slice(*recording.scored)]) ** 2)))
            for m in (found.base_model, found.model)
        ]
        share = ", ".join(f"{100 * e / np.std(force):.1f} %" for e in errors)
        rows.append(
            f"| {recording.name}, never shown ({share} of its force) | {errors[0]:.4g} | {errors[1]:.4g} |"
        )
    yield "\n".join(["| rms error / N | base model | with effects |", "|---|---:|---:|", *rows])
    yield f"Noise as the tool estimates it: {fit.noise_rms:.4g} N. Made by `benches/real_proof`."


def _end(value: float | None) -> str:
    return "?" if value is None else f"{value:.5g}"
