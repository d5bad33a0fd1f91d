"""A page in headless Chromium, driven over its debugging port."""

import json
import os
import shutil
import subprocess
import time
from base64 import b64decode
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from websockets.sync.client import ClientConnection, connect

_PATIENCE = 60.0


class Tab:
    """One page; everything that it complains of is kept."""

    def __init__(self, socket: ClientConnection) -> None:
        self._socket = socket
        self._number = 0
        self.complaints: list[str] = []
        for domain in ("Page", "Runtime", "Log"):
            self.ask(f"{domain}.enable")

    def ask(self, method: str, **parameters: Any) -> Any:
        """Send a command of the protocol and wait for its answer."""
        self._number += 1
        self._socket.send(json.dumps({"id": self._number, "method": method, "params": parameters}))
        while True:
            message = self._receive()
            if message.get("id") == self._number:
                assert "error" not in message, message
                return message["result"]

    def open(self, page: Path, width: int = 1200, height: int = 900, **media: str) -> None:
        """Load a file in a window of a size; `media` are features such as prefers_color_scheme."""
        self.ask(
            "Emulation.setDeviceMetricsOverride",
            width=width,
            height=height,
            deviceScaleFactor=1,
            mobile=False,
        )
        features = [{"name": name.replace("_", "-"), "value": value} for name, value in media.items()]
        self.ask("Emulation.setEmulatedMedia", features=features)
        self.ask("Page.navigate", url=page.absolute().as_uri())
        deadline = time.monotonic() + _PATIENCE
        while time.monotonic() < deadline and self.run("document.readyState") != "complete":
            time.sleep(0.02)
        self.settle()

    def run(self, script: str) -> Any:
        """Evaluate JavaScript and return its value."""
        found = self.ask("Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True)
        assert "exceptionDetails" not in found, found["exceptionDetails"]
        return found["result"].get("value")

    def settle(self) -> None:
        """Wait until two frames have been drawn."""
        self.run("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(0))))")

    def press(self, key: str, *, shift: bool = False) -> None:
        """Press and release a key."""
        codes = {
            "Tab": 9,
            "Enter": 13,
            "Escape": 27,
            " ": 32,
            "ArrowLeft": 37,
            "ArrowRight": 39,
            "ArrowDown": 40,
        }
        text = "\r" if key == "Enter" else key if len(key) == 1 else ""
        code = codes.get(key, ord(key[0]))
        shared = {"key": key, "modifiers": 8 if shift else 0, "windowsVirtualKeyCode": code}
        self.ask("Input.dispatchKeyEvent", type="keyDown", text=text, **shared)
        self.ask("Input.dispatchKeyEvent", type="keyUp", **shared)
        self.settle()

    def place(self, selector: str, across: float = 0.5, down: float = 0.5) -> tuple[float, float]:
        """Scroll an element into view, and find a point on it by shares of its size."""
        x, y, width, height = self.run(
            f"(() => {{ const e = document.querySelector({json.dumps(selector)});"
            " e.scrollIntoView({block: 'center'}); const r = e.getBoundingClientRect();"
            " return [r.x, r.y, r.width, r.height]; })()"
        )
        return x + across * width, y + down * height

    def mouse(self, kind: str, at: tuple[float, float], buttons: int = 0, count: int = 1) -> None:
        self.ask(
            "Input.dispatchMouseEvent",
            type=kind,
            x=at[0],
            y=at[1],
            button="left" if kind != "mouseMoved" or buttons else "none",
            buttons=buttons,
            clickCount=0 if kind == "mouseMoved" else count,
        )

    def click(self, selector: str, across: float = 0.5, down: float = 0.5, *, count: int = 1) -> None:
        """Click on a point of an element, by shares of its size, once or twice."""
        at = self.place(selector, across, down)
        for number in range(1, count + 1):
            self.mouse("mousePressed", at, 1, number)
            self.mouse("mouseReleased", at, 0, number)
        self.settle()

    def drag(self, selector: str, start: tuple[float, float], stop: tuple[float, float]) -> None:
        """Drag from one point of an element to another, both by shares of its size."""
        first, last = self.place(selector, *start), self.place(selector, *stop)
        middle = ((first[0] + last[0]) / 2, (first[1] + last[1]) / 2)
        self.mouse("mouseMoved", first)
        self.mouse("mousePressed", first, 1)
        self.mouse("mouseMoved", middle, 1)
        self.mouse("mouseMoved", last, 1)
        self.mouse("mouseReleased", last)
        self.settle()

    def picture(self, path: Path, *, whole: bool = True) -> None:
        """Save a screenshot."""
        found = self.ask(
            "Page.captureScreenshot", format="png", captureBeyondViewport=whole, **self._clip(whole)
        )
        path.write_bytes(b64decode(found["data"]))

    def pdf(self) -> bytes:
        """Print."""
        return b64decode(self.ask("Page.printToPDF", printBackground=True)["data"])

    def _clip(self, whole: bool) -> dict[str, Any]:
        if not whole:
            return {}
        size = self.ask("Page.getLayoutMetrics")["cssContentSize"]
        return {"clip": {"x": 0, "y": 0, "width": size["width"], "height": size["height"], "scale": 1}}

    def _receive(self) -> Any:
        message = json.loads(self._socket.recv(timeout=_PATIENCE))
        content = message.get("params", {})
        match message.get("method"):
            case "Runtime.exceptionThrown":
                self.complaints.append(json.dumps(content["exceptionDetails"]))
            case "Log.entryAdded":
                self.complaints.append(content["entry"]["text"])
            case "Runtime.consoleAPICalled":
                self.complaints.append(json.dumps(content["args"]))
        return message


@contextmanager
def chromium(profile: Path) -> Iterator[Tab]:
    """Open a tab; skip where there is no Chromium, fail where CI has none."""
    program = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    if program is None:
        reason = "no chromium in PATH: install the package chromium to test the report in a browser"
        if os.environ.get("CI"):
            pytest.fail(reason)
        pytest.skip(reason)
    options = [
        "--headless=new",
        "--no-sandbox",
        "--disable-gpu",
        "--remote-debugging-port=0",
        "--no-first-run",
    ]
    browser = subprocess.Popen(
        [program, *options, f"--user-data-dir={profile}", "about:blank"],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        with connect(_address(browser, profile), max_size=None, open_timeout=_PATIENCE) as socket:
            yield Tab(socket)
    finally:
        browser.terminate()
        browser.wait(timeout=_PATIENCE)


def _address(browser: "subprocess.Popen[bytes]", profile: Path) -> str:
    """Address of the first tab, once the browser has written its port."""
    from urllib.request import urlopen

    port, deadline = profile / "DevToolsActivePort", time.monotonic() + _PATIENCE
    while not (port.exists() and "\n" in port.read_text()):
        assert browser.poll() is None, "the browser ended at once"
        assert time.monotonic() < deadline, "the browser does not answer"
        time.sleep(0.05)
    number = port.read_text().splitlines()[0]
    with urlopen(f"http://127.0.0.1:{number}/json/list", timeout=_PATIENCE) as answer:
        tabs = json.load(answer)
    return next(str(tab["webSocketDebuggerUrl"]) for tab in tabs if tab["type"] == "page")
