"""The pages for a person: what stands in them, and that they stand for themselves."""

import base64
import json
import re
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import mre_core
import numpy as np
import pytest
from missing import campaign, record, write_all
from mre_core import Diagnosis, Recording
from mre_core.diagnosis import Comparison, Estimate, History, MissingEffect
from mre_core.report import report_diagnosis, report_identification
from mre_core.report.chart import chart, curves_in
from mre_core.report.page import figures
from mre_core.report.series import MOST_POINTS, Series, kept, pack
from rig import KELVIN_VOIGT, SINH, Cli, made_of, motion
from rig import record as rig_record

HOSTILE = "</script><script>document.title='x'</script><img src=x onerror=alert(1)>&\"'$x$"


class Page(HTMLParser):
    """Whether a page stands for itself: what is in it, and where it points to."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.targets: list[str] = []
        self.ids: list[str] = []
        self.handlers: list[str] = []
        self.blocks: dict[str, str] = {}
        self.text = ""
        self._block: str | None = None
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        self.text += " "
        given = dict(attrs)
        if tag in {"script", "style"}:
            self._block = given.get("id") or tag
            self.blocks[self._block] = ""
        for name, value in attrs:
            if name in {"src", "href", "xlink:href", "srcset", "action", "data"}:
                self.targets.append(value or "")
            if name == "id":
                self.ids.append(value or "")
            if name.startswith("on") or name == "style":
                self.handlers.append(name)

    def handle_endtag(self, tag: str) -> None:
        self._block = None

    def handle_data(self, data: str) -> None:
        if self._block is None:
            self.text += data
        else:
            self.blocks[self._block] += data

    @property
    def words(self) -> str:
        return " ".join(self.text.split())

    def block(self, name: str) -> Any:
        return json.loads(self.blocks[name])


def check_alone(page: Page) -> None:
    assert page.tags.count("script") == 3
    assert set(page.blocks) == {"style", "series", "result", "script"}
    assert not {"link", "iframe", "img", "object", "base", "form"} & set(page.tags)
    assert page.targets == []
    assert page.handlers == []
    assert len(page.ids) == len(set(page.ids))
    for block in (page.blocks["style"], page.blocks["script"]):
        assert not re.search(r"@import|url\(|https?:|fetch|XMLHttp|WebSocket|innerHTML|eval\(", block)


def a_diagnosis(*, name: str = "sine", samples: int = 400, **changed: Any) -> Diagnosis:
    time = np.arange(samples) / 200
    x, v = 4 * np.sin(2 * time), 8 * np.cos(2 * time)
    measured = 3 * x + v
    history = History(name, time, x, v, measured, measured - np.sin(time), measured - 0.1)
    model = made_of("kelvin_voigt", KELVIN_VOIGT)
    effect = MissingEffect(
        id="maxwell_relaxation",
        law="one branch",
        statement=f"Something is left out; this shows most in '{name}'.",
        equation="dF_m/dt = k_m v - F_m/tau",
        reference="Maxwell 1867",
        parameters={"k_m": Estimate(1.05, 0.98, 1.12, "N/mm"), "tau": Estimate(0.5, None, None, "s")},
        p_value=0.0,
        form="approximate",
        lack_of_fit=0.034,
        indistinguishable_from=("fractional_viscoelasticity",),
        no_test_tells=("fractional_viscoelasticity",),
        checks={"fractional_viscoelasticity": "leave it alone for a day"},
        at_the_end=("tau",),
        held_out_rms_before=3.1,
        held_out_rms_after=1.0,
    )
    place = {"recording": name, "kind": "time", "from": 0.4, "to": 0.9, "unit": "s", "strength": 7.3}
    base = Diagnosis(
        base="sinh",
        verdict="missing_physics",
        effects=(effect,),
        where=(place | {"what": f"In '{name}' around 0.65 s: something."},),
        fit=Comparison(3.2, 1.01, 3.3, 1.02, 1.0),
        unknown=None,
        absorbed_detail=({"id": "inertia", "up_to": 12.0, "unit": "kg", "why": "it looks like k0"},),
        next_test=None,
        p_values={"base": 0.0, "rest": 0.4, "effects": {}},
        base_model=model,
        model=model,
        recordings=(name,),
        false_alarm=0.01,
        fixed=False,
        seed=1,
        histories=(history,),
    )
    return replace(base, **changed)


class Later(Diagnosis):
    """A diagnosis with fields that this page does not know."""

    def to_dict(self) -> dict[str, Any]:
        speed = np.linspace(0, 5, 40)
        return super().to_dict() | {
            "suspicion": {
                "depends_on": "velocity",
                "what": HOSTILE,
                "curve": {"velocity_mm_s": speed.tolist(), "force_N": (speed**2).tolist(), "unit": "N"},
            },
            "empty": [],
            "not_given": None,
        }


def test_all_of_a_diagnosis_is_shown() -> None:
    page = Page(report_diagnosis(a_diagnosis()))
    check_alone(page)
    for piece in (
        str(a_diagnosis()),
        "missing physics",
        "Maxwell relaxation maxwell_relaxation",
        "dF_m/dt = k_m v - F_m/tau",
        "0.98 to 1.12",
        "not determined",
        "a further effect would add about 3.4 % of the force's rms",
        "cannot tell it from fractional_viscoelasticity",
        "To tell it from fractional_viscoelasticity, leave it alone for a day.",
        "not to be told from nothing: tau",
        "3.1 N without it and 1 N with it",
        "p-value below 1e-300",
        "In 'sine' around 0.65 s: something.",
        "inertia it looks like k0",
        "false_alarm",
    ):
        assert piece in page.words
    assert page.block("result") == a_diagnosis().to_dict()
    assert "The next test" not in page.words


def test_a_diagnosis_without_a_verdict_says_what_stands() -> None:
    broken_off = a_diagnosis(
        verdict=None, p_values={"base": None, "rest": None, "effects": {}}, interrupted=True
    )
    assert str(broken_off).startswith("Interrupted before a verdict on the base model sinh"), broken_off
    check_alone(Page(report_diagnosis(broken_off)))


@pytest.mark.parametrize("verdict", ["adequate", "missing_physics", "partly_explained", "unexplained"])
def test_every_verdict(verdict: str) -> None:
    effects = a_diagnosis().effects if verdict in {"missing_physics", "partly_explained"} else ()
    found = a_diagnosis(verdict=verdict, effects=effects, where=(), absorbed_detail=())
    page = Page(report_diagnosis(found))
    assert page.words.count(str(found)) == 1
    assert page.words.index(str(found)) < 120
    assert ("What was left out" in page.words) == bool(effects)
    assert page.block("series")["models"] == ["base model", "with effects"][: 1 + bool(effects)]
    assert "Nothing of the catalogue" in page.words


def test_the_next_test() -> None:
    test = {"why": "it separates them", "excitation": "sine", "frequency_hz": 4.0, "separates": ["a", "b"]}
    page = Page(report_diagnosis(a_diagnosis(next_test=test)))
    assert "The next test it separates them excitation sine frequency hz 4 separates a, b" in page.words


def test_what_is_unexplained() -> None:
    unknown = {
        "statement": "A force of about 0.45 N is unexplained.",
        "nearest": ["mullins_softening"],
        "depends_on": [{"on": "state", "share": 0.34, "size": None}],
        "odd": 0.02,
        "map": {"x_mm": [-1.0, 0.0, 1.0], "v_mm_s": [-5.0, 5.0], "force_N": [[None, 1, 2], [3, None, None]]},
    }
    page = Page(report_diagnosis(a_diagnosis(verdict="unexplained", effects=(), unknown=unknown)))
    check_alone(page)
    assert "What is unexplained A force of about 0.45 N is unexplained." in page.words
    assert "nearest mullins_softening" in page.words
    assert page.tags.count("polyline") == 1  # one sample makes no line
    assert "-5 mm/s" in page.words
    later = {"statement": "Something else.", "kind": 3}
    assert "Something else." in Page(report_diagnosis(a_diagnosis(unknown=later))).words


def test_fields_of_later_versions_are_shown() -> None:
    found = a_diagnosis(verdict="unexplained", effects=())
    later = Later(**{name: getattr(found, name) for name in found.__dataclass_fields__})
    page = Page(report_diagnosis(later))
    check_alone(page)
    assert "Suspicion" in page.words
    assert "depends on velocity" in page.words
    assert HOSTILE in page.words
    assert "40 values from 0 to 5" in page.words
    assert page.tags.count("polyline") == 1
    assert "Empty" not in page.words
    assert "Not given" not in page.words


def test_text_from_files_is_text() -> None:
    found = a_diagnosis(name=HOSTILE)
    page = Page(report_diagnosis(found))
    check_alone(page)
    assert HOSTILE in page.words
    assert page.block("series")["recordings"][0]["name"] == HOSTILE
    r = rig_record(made_of("sinh", SINH), motion(), noise=0.5, name=HOSTILE)
    page = Page(report_identification(mre_core.identify(r, "sinh", optimizer="exact"), [r]))
    check_alone(page)
    assert HOSTILE in page.words


def test_an_identification_is_shown() -> None:
    recordings = [
        rig_record(made_of("sinh", SINH), motion(current=a), noise=0.5, seed=int(a), name=f"at {a}")
        for a in (0.0, 1.0)
    ]
    found = mre_core.identify(
        recordings, "sinh", optimizer="mafsa", seed=1, max_iterations=5, bounds={"c0": (0, 0.5)}
    )
    page = Page(report_identification(found, recordings, found.profile(), found.bootstrap(5)))
    check_alone(page)
    for run, level in zip(found.runs, ("0 A", "1 A"), strict=True):
        assert level in page.words
        assert f"{run.values['k0']:.6g}" in page.words
    for piece in (
        "sinh follows the 2 recordings",
        "c0 is on its upper bound",
        "not determined",
        "at 1.0",
        "k0 + alpha beta",
        "max iterations",
        "by profile likelihood",
        "by bootstrap",
    ):
        assert piece in page.words
    assert page.tags.count("polyline") == 2
    assert page.block("result")["seed"] == 1


def test_what_is_excluded_is_not_drawn() -> None:
    time = np.arange(0, 12, 0.01)
    x = np.where(time < 2, 0, 4 * np.sin(2 * np.pi * time))
    r = Recording(time, x, 5 * x).exclude("start_transient")
    page = Page(report_identification(mre_core.identify(r, "kelvin_voigt", optimizer="exact"), [r]))
    shown = page.block("series")["recordings"][0]
    assert shown["samples"] == r.scored[1] - r.scored[0] < len(r)


def series(n: int, *, seed: int = 0, spike: int | None = None) -> Series:
    rng = np.random.default_rng(seed)
    time = np.arange(n) / 1000
    measured = 100 * np.sin(time) + rng.normal(size=n)
    if spike is not None:
        measured[spike] += 1000
    model = 100 * np.sin(time)
    return Series(
        "a", time, 4 * np.sin(time), 4 * np.cos(time), measured, {"base": model, "final": model - 0.5}
    )


@pytest.mark.parametrize("n", [2, 1000, 1001, 50_000])
@pytest.mark.parametrize("most", [300, 1000])
def test_thinning_keeps_the_extremes(n: int, most: int) -> None:
    r = series(n, spike=n // 3)
    at = kept(r, most)
    assert len(at) <= most
    assert np.all(np.diff(at) > 0)
    if n <= most:
        assert len(at) == n
    assert (at[0], at[-1]) == (0, n - 1)
    for values in (r.measured, r.displacement, *(r.measured - force for force in r.models.values())):
        assert values[at].max() == values.max()
        assert values[at].min() == values.min()
    # Every stretch keeps its own: no gap is longer than two stretches.
    assert np.diff(at).max() <= max(1, 2 * n / ((most - 2) // 8) + 1)


def test_what_is_packed_is_what_was_given() -> None:
    r = series(5000)
    packed = pack([r])["recordings"][0]
    time = np.frombuffer(base64.b64decode(packed["time"]), "<f8")
    np.testing.assert_array_equal(time, r.time)
    force = np.frombuffer(base64.b64decode(packed["forces"][1]), "<f4")
    np.testing.assert_allclose(force, r.models["final"], rtol=1e-6)
    cells = packed["map"]["cells"]
    base, final = (np.frombuffer(base64.b64decode(m), "<f4") for m in packed["map"]["means"])
    assert len(base) == cells**2
    # The two models differ by half a newton everywhere.
    np.testing.assert_allclose((final - base)[~np.isnan(base)], 0.5, atol=1e-4)


def test_large_forces_are_drawn_in_kilonewtons() -> None:
    small, r = series(1000), series(1000)
    large = replace(
        r, measured=1000 * r.measured, models={name: 1000 * force for name, force in r.models.items()}
    )
    assert pack([small])["unit"] == "N"
    packed = pack([large])
    assert packed["unit"] == "kN"
    assert packed["recordings"][0]["rms"] == pytest.approx(pack([small])["recordings"][0]["rms"])
    for key in ("measured", "forces", "map"):
        one, other = (json.dumps(p["recordings"][0][key]) for p in (packed, pack([small])))
        assert len(one) == len(other)
    force = np.frombuffer(base64.b64decode(packed["recordings"][0]["measured"]), "<f4")
    np.testing.assert_allclose(force, r.measured, rtol=1e-6)


@pytest.mark.parametrize("lengths", [[100_000], [1000] * 100, [500, 200_000]])
def test_pages_stay_small(lengths: list[int]) -> None:
    packed = pack([series(n) for n in lengths])
    shown = [r["shown"] for r in packed["recordings"]]
    assert sum(shown) <= max(MOST_POINTS, 300 * len(lengths))
    if len(lengths) == 2:
        assert shown[0] == 500
        assert shown[1] > MOST_POINTS / 2
    history = [
        History(f"r{i}", s.time, s.displacement, s.velocity, s.measured, s.models["base"], s.models["final"])
        for i, s in enumerate(map(series, lengths))
    ]
    page = report_diagnosis(a_diagnosis(histories=tuple(history)))
    assert len(page.encode()) < 6_000_000


def test_commands_write_it(cli: Cli, tmp_path: Path) -> None:
    hostile = "a<script>alert(1)<_script>&'$x$"
    paths = write_all(tmp_path / "in", [record(1.0, 4.0, 3.0, name=hostile), record(3.0, 4.0, 3.0, seed=1)])
    out = tmp_path / "r"
    assert cli("diagnose", *paths, "--base", "sinh", "--seed", "1", "--out", out, "--quiet")[0] == 0
    page = Page((out / "report.html").read_text(encoding="utf-8"))
    check_alone(page)
    assert hostile in page.words
    content = json.loads((out / "diagnosis.json").read_text(encoding="utf-8"))
    assert page.block("result") == content
    for piece in (content["statement"], *(effect["equation"] for effect in content["effects"])):
        assert piece in page.words
    for place in content["where"]:
        assert place["what"] in page.words
    assert (
        cli(
            "identify",
            *paths,
            "--model",
            "sinh",
            "--optimizer",
            "exact",
            "--no-figures",
            "--quiet",
            "--out",
            out,
        )[0]
        == 0
    )
    page = Page((out / "report.html").read_text(encoding="utf-8"))
    check_alone(page)
    assert "sinh follows the 2 recordings" in page.words


def test_same_bytes() -> None:
    recordings = campaign()[:2]
    pages = {
        report_identification(mre_core.identify(recordings, "sinh", seed=1), recordings) for _ in range(2)
    }
    assert len(pages) == 1


def test_numbers_in_words() -> None:
    assert [figures(v) for v in (None, True, 60000, 1.23456, 1e-12, 123456.0, 1e9, "a")] == [
        "not known",
        "yes",
        "60000",
        "1.235",
        "1e-12",
        "123500",
        "1e+09",
        "a",
    ]


def test_charts() -> None:
    assert chart({"a": ([1, 2], [0.0, -1.0])}, "x", "y", logarithmic=True) is None
    drawn = chart({"a": ([0, 1, 2], [1.0, 10.0, 100.0])}, "x", "y", logarithmic=True)
    assert drawn is not None
    heights = [float(point.split(",")[1]) for point in drawn.lines[0][1].split()]
    assert np.diff(heights, 2) == pytest.approx([0], abs=0.11)
    assert "10" in [text for _, text in drawn.y_ticks]
    constant = chart({"a": ([0, 1], [5, 5])}, "x", "y")
    assert constant is not None
    for value, count in (
        ({"speed": [1, 2, 3], "force": [1, 4, 9]}, 1),
        ({"a": {"x": [1.0, 2, 3], "y": [0, 1, 0], "z": [1, 1, 2]}}, 1),
        ([[0, 1], [1, 2], [2, 5]], 1),
        ({"speed": [1, 2, 3], "force": [1, 4]}, 0),
        ({"flags": ["a", "b"], "n": 3, "e": []}, 0),
        ("text", 0),
    ):
        assert len(curves_in(value)) == count
