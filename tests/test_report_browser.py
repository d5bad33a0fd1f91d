"""The pages in a browser: nothing complains, and the controls do what they say."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import mre_core
import numpy as np
import pytest
from browser import Tab, chromium
from mre_core.diagnosis import History
from mre_core.report import report_diagnosis, report_identification
from rig import SINH, made_of, motion
from rig import record as rig_record
from test_report import HOSTILE, a_diagnosis

RATE = 200.0
MEASURED, BASE, FINAL = (154, 163, 174), (192, 90, 28), (16, 80, 140)
MARKED = (31, 90, 146)
"""Colours of the curves and of marks on a light page."""


def history(name: str, samples: int, frequency: float) -> History:
    time = np.arange(samples) / RATE
    angle = 2 * np.pi * frequency * time
    x, v = 4 * np.sin(angle), 8 * np.pi * frequency * np.cos(angle)
    measured = 3 * x + 0.1 * v
    left = 0.1 * np.random.default_rng(1).choice([-1, 1], samples)
    return History(name, time, x, v, measured, measured - np.sin(angle), measured - left)


@pytest.fixture(scope="module")
def diagnosis(tmp_path_factory: pytest.TempPathFactory) -> Path:
    histories = (history("slow", 2000, 0.5), history(HOSTILE, 100_000, 1.0))
    places = (
        {"recording": HOSTILE, "kind": "time", "from": 100.0, "to": 110.0, "strength": 9.0, "what": "time"},
        {"kind": "state", "x_mm": [1.0, 2.0], "v_mm_s": [-30.0, -20.0], "strength": 5.0, "what": "state"},
        {
            "recording": "slow",
            "kind": "harmonic",
            "harmonic": 3,
            "drive_hz": 0.5,
            "strength": 2,
            "what": "3rd",
        },
    )
    found = a_diagnosis(histories=histories, where=places, recordings=("slow", HOSTILE))
    path = tmp_path_factory.mktemp("pages") / "report.html"
    path.write_text(report_diagnosis(found), encoding="utf-8")
    assert path.stat().st_size < 6_000_000
    return path


@pytest.fixture(scope="module")
def browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Tab]:
    with chromium(tmp_path_factory.mktemp("profile")) as tab:
        yield tab


@pytest.fixture
def page(browser: Tab, diagnosis: Path) -> Iterator[Tab]:
    browser.complaints.clear()
    browser.open(diagnosis)
    yield browser
    assert browser.complaints == []


def readout(page: Tab) -> str:
    page.settle()
    return str(page.run("document.getElementById('readout').textContent"))


def time_of(page: Tab) -> float:
    """Time of the cursor in s."""
    return float(readout(page).split(" s ·")[0])


def ink(page: Tab, canvas: str, colour: tuple[int, int, int] | None = None) -> int:
    """How many pixels of a figure are drawn on; where a colour is given, those of it."""
    test = (
        "d[i + 3] > 0" if colour is None else " && ".join(f"d[i + {k}] === {c}" for k, c in enumerate(colour))
    )
    return int(
        page.run(
            f"(() => {{ const c = document.getElementById('{canvas}'), size = [c.width, c.height];"
            " const pen = new OffscreenCanvas(...size).getContext('2d', { willReadFrequently: true });"
            " pen.drawImage(c, 0, 0); const d = pen.getImageData(0, 0, ...size).data; let n = 0;"
            f" for (let i = 0; i < d.length; i += 4) n += {test}; return n; }})()"
        )
    )


def shown(page: Tab) -> Any:
    return page.run("document.getElementById('recording').value")


def press_button(page: Tab, selector: str) -> None:
    page.run(f"document.querySelector({json.dumps(selector)}).click()")
    page.settle()


def test_it_loads_and_draws(page: Tab) -> None:
    assert readout(page).startswith("slow: rms error base model 0.7071 N, with effects 0.1 N")
    for canvas in ("force", "error", "loop", "map"):
        assert ink(page, canvas) > 3000
    assert page.run("document.title") == "Diagnosis of sinh: missing physics"
    # Nothing sticks out to the right.
    for width in (1200, 360):
        page.ask(
            "Emulation.setDeviceMetricsOverride", width=width, height=700, deviceScaleFactor=1, mobile=False
        )
        page.settle()
        assert page.run("document.documentElement.scrollWidth <= innerWidth")


def test_names_are_only_text(page: Tab) -> None:
    names = page.run("[...document.querySelectorAll('#recording option')].map((o) => o.textContent)")
    assert names == ["slow", HOSTILE]
    press_button(page, "#next")
    assert readout(page).startswith(HOSTILE)
    assert page.run("document.querySelectorAll('img').length") == 0


def test_recordings(page: Tab) -> None:
    for button, wanted in (("#next", "1"), ("#next", "0"), ("#previous", "1")):
        press_button(page, button)
        assert shown(page) == wanted
    thinned = str(page.run("document.getElementById('thinned').textContent"))
    assert thinned.startswith("Drawn are ")
    assert "of 100000 samples" in thinned
    page.run(
        "{ const s = document.getElementById('recording'); s.value = '0';"
        " s.dispatchEvent(new Event('change')) }"
    )
    assert readout(page).startswith("slow")
    assert page.run("document.getElementById('thinned').textContent") == ""


def test_curves(page: Tab) -> None:
    def counts() -> list[int]:
        return [ink(page, "force", MEASURED), ink(page, "force", BASE), ink(page, "error", FINAL)]

    before = counts()
    assert min(before) > 20
    for place in (1, 2, 3):
        press_button(page, f"#curves label:nth-child({place}) input")
        assert counts()[place - 1] == 0
        if place == 2:
            assert page.run("document.getElementById('map-of').textContent") == ", with effects"
        press_button(page, f"#curves label:nth-child({place}) input")
    assert counts() == before
    assert page.run("document.getElementById('map-of').textContent") == ", base model"


def test_hover_reads_the_sample(page: Tab) -> None:
    # The axis runs from 58 pixels at the left to 12 at the right.
    width = page.run("document.getElementById('force').clientWidth")
    at = page.place("#force", (58 + 0.25 * (width - 70)) / width)
    page.mouse("mouseMoved", at)
    t = time_of(page)
    assert t == pytest.approx(0.25 * 1999 / RATE, abs=0.02)
    x = 4 * np.sin(np.pi * t)
    v = 4 * np.pi * np.cos(np.pi * t)
    force = 3 * x + 0.1 * v
    numbers = readout(page).replace("(error ", "").replace(")", "").split(" · ")
    got = [float(piece.removeprefix("x ").removeprefix("v ").split()[0]) for piece in numbers[:3]]
    assert got == pytest.approx([t, x, v], abs=0.1)
    assert float(numbers[3].split()[1]) == pytest.approx(force, abs=0.05)
    # The model without effects is off by the sine of the angle.
    assert float(numbers[4].split()[-1]) == pytest.approx(np.sin(np.pi * t), abs=0.01)


def test_drag_zooms_and_double_click_shows_everything(page: Tab) -> None:
    page.drag("#force", (0.4, 0.5), (0.5, 0.5))
    page.mouse("mouseMoved", (2, 2))
    page.run("document.getElementById('force').focus()")
    page.press("ArrowRight")
    first = time_of(page)
    assert 3.2 < first < 4.0
    page.mouse("mouseMoved", page.place("#force", 0.98))
    assert 4.2 < time_of(page) < 5.0
    page.click("#error", count=2)
    page.mouse("mouseMoved", page.place("#force", 0.98))
    assert time_of(page) > 9.5


def test_keyboard(page: Tab) -> None:
    # Reached by the tabulator alone.
    for _ in range(40):
        page.press("Tab")
        if page.run("document.activeElement.id") == "force":
            break
    else:
        pytest.fail("the tabulator does not reach the figure")
    page.press("ArrowRight")
    assert time_of(page) == 0
    page.press("ArrowRight")
    assert time_of(page) == pytest.approx(1 / RATE, rel=1e-3)
    page.press("ArrowRight", shift=True)
    assert time_of(page) == pytest.approx(26 / RATE, rel=1e-3)
    page.press("ArrowLeft")
    assert time_of(page) == pytest.approx(25 / RATE, rel=1e-3)
    page.press("+")
    page.mouse("mouseMoved", page.place("#force", 0.98))
    assert time_of(page) < 6
    page.press("0")
    page.mouse("mouseMoved", page.place("#force", 0.98))
    assert time_of(page) > 9.5
    page.press("]")
    assert shown(page) == "1"
    page.press("[")
    assert shown(page) == "0"


def test_the_map_marks_samples_in_the_other_figures(page: Tab) -> None:
    def marks() -> list[int]:
        return [ink(page, canvas, MARKED) for canvas in ("force", "error", "loop")]

    assert marks() == [0, 0, 0]
    page.drag("#map", (0.5, 0.05), (0.9, 0.6))
    page.mouse("mouseMoved", (5, 5))
    page.settle()
    assert min(marks()) > 50
    page.run("document.getElementById('map').focus()")
    page.press("Escape")
    assert marks() == [0, 0, 0]
    page.press("ArrowRight")
    page.press("Enter")
    assert min(marks()) > 0


def test_places_lead_to_the_figures(page: Tab) -> None:
    press_button(page, "[data-place='0']")
    assert shown(page) == "1"
    assert page.run("document.activeElement.id") == "force"
    page.press("ArrowRight")
    assert time_of(page) == pytest.approx(90, abs=1)
    page.mouse("mouseMoved", page.place("#force", 0.98))
    assert time_of(page) == pytest.approx(120, abs=1)
    press_button(page, "[data-place='2']")
    assert shown(page) == "0"
    press_button(page, "[data-place='1']")
    # A state belongs to no recording: the first that has been there is shown.
    assert shown(page) == "1"
    assert ink(page, "loop", MARKED) > 10


def test_copies(page: Tab) -> None:
    page.run("window.got = []; navigator.clipboard.writeText = async (text) => { window.got.push(text) }")
    for what in ("result", "samples", "settings"):
        press_button(page, f"[data-copy='{what}']")
    result, samples, settings = page.run("window.got")
    assert json.loads(result)["verdict"] == "missing_physics"
    assert json.loads(settings)["seed"] == 1
    lines = samples.splitlines()
    assert lines[0] == "time_s,displacement_mm,velocity_mm_s,force_N,base_model_N,with_effects_N"
    assert len(lines) == 2001
    assert str(page.run("document.getElementById('copied').textContent")).startswith("Copied ")
    # Where the clipboard is closed, a selection is copied.
    page.run("navigator.clipboard.writeText = async () => { throw new Error() }")
    page.run(
        "document.execCommand = (name) => { window.got.push(document.activeElement.value); return true }"
    )
    press_button(page, "[data-copy='settings']")
    assert page.run("window.got[3]") == settings


def test_nothing_is_fetched_and_no_other_script_runs(page: Tab) -> None:
    assert page.run("performance.getEntriesByType('resource').length") == 0
    page.run(
        "{ const s = document.createElement('script'), i = document.createElement('img');"
        " s.textContent = 'window.ran = 1'; i.src = 'http://127.0.0.1:9/x.png'; document.body.append(s, i) }"
    )
    page.settle()
    assert page.run("window.ran === undefined")
    assert len(page.complaints) == 2
    assert all("Content Security Policy" in complaint for complaint in page.complaints)
    page.complaints.clear()


def test_light_dark_and_paper(browser: Tab, diagnosis: Path) -> None:
    browser.complaints.clear()
    papers = []
    for scheme in ("light", "dark"):
        browser.open(diagnosis, prefers_color_scheme=scheme)
        papers.append(browser.run("getComputedStyle(document.body).backgroundColor"))
    assert papers == ["rgb(251, 251, 249)", "rgb(20, 24, 30)"]
    assert browser.pdf().startswith(b"%PDF")
    browser.ask("Emulation.setEmulatedMedia", media="print")
    browser.settle()
    assert browser.run("getComputedStyle(document.body).backgroundColor") == "rgb(255, 255, 255)"
    assert browser.run("getComputedStyle(document.getElementById('next')).display") == "none"
    assert browser.complaints == []


def test_an_identification(browser: Tab, tmp_path: Path) -> None:
    recordings = [
        rig_record(made_of("sinh", SINH), motion(), noise=0.5, seed=seed, name=name)
        for seed, name in enumerate(("a", "b"))
    ]
    found = mre_core.identify(recordings, "sinh", optimizer="mafsa", seed=1, max_iterations=5)
    path = tmp_path / "report.html"
    path.write_text(report_identification(found, recordings), encoding="utf-8")
    browser.complaints.clear()
    browser.open(path)
    assert readout(browser).startswith("a: rms error model ")
    press_button(browser, "#next")
    assert readout(browser).startswith("b: rms error model ")
    assert ink(browser, "map") > 3000
    assert browser.run("document.querySelectorAll('[data-place]').length") == 0
    assert browser.complaints == []
