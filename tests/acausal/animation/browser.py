"""A headless Chromium that opens pages and answers, spoken to through a pair of pipes (no package, no port)."""

from __future__ import annotations

import base64
import contextlib
import json
import os
import select
import shutil
import signal
import subprocess
import tempfile
import time
from pathlib import Path
from typing import Any

NAMES = ("chromium-headless-shell", "chrome-headless-shell", "chromium", "google-chrome")
# A software renderer: WebGL without a graphics card; no sandbox, which root cannot have.
OPTIONS = (
    *(
        "--headless",
        "--no-sandbox",
        "--use-angle=swiftshader",
        "--enable-unsafe-swiftshader",
        "--remote-debugging-pipe",
    ),
    *("--no-first-run", "--hide-scrollbars", "--mute-audio", "--disable-dev-shm-usage"),
    *("--disable-background-networking", "--disable-features=IsolateSandboxedIframes"),
)
PATIENCE = 60.0  # seconds for one answer, on a machine that does much else


def installed() -> str | None:
    """Return the path of a browser, or None; descriptors are handed over as POSIX has it."""
    return next((path for name in NAMES if (path := shutil.which(name))), None) if os.name == "posix" else None


class Browser:
    """One page of one browser, which runs in a process group of its own."""

    def __init__(self, path: str, width: int = 720, height: int = 600, *options: str) -> None:
        self._home = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        theirs_in, self._out = os.pipe()
        self._in, theirs_out = os.pipe()
        # The protocol is spoken on descriptors 3 and 4; the shell moves the pipes there whatever numbers they have.
        moved = f'exec "$@" 3<&{theirs_in} 4>&{theirs_out}'
        size = f"--window-size={width},{height}"
        self._process = subprocess.Popen(
            ["bash", "-c", moved, "bash", path, *OPTIONS, size, f"--user-data-dir={self._home.name}", *options],
            pass_fds=(theirs_in, theirs_out),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            start_new_session=True,
        )
        os.close(theirs_in)
        os.close(theirs_out)
        self._buffer, self._last = b"", 0
        self._session: str | None = None
        self.group = self._process.pid
        self.events: list[dict[str, Any]] = []
        target = self.call("Target.createTarget", url="about:blank", width=width, height=height)["targetId"]
        self._session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Network", "Log"):
            self.call(f"{domain}.enable")

    def call(self, method: str, **parameters: Any) -> dict[str, Any]:
        """Return the answer to one command; what is told meanwhile goes to `events`."""
        self._last += 1
        message = {"id": self._last, "method": method, "params": parameters}
        if self._session:
            message["sessionId"] = self._session
        os.write(self._out, json.dumps(message).encode() + b"\0")
        end = time.monotonic() + PATIENCE
        while True:
            answer = self._read(end)
            if answer.get("id") == self._last:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']}")
                return answer["result"]

    def _read(self, end: float) -> dict[str, Any]:
        while b"\0" not in self._buffer:
            if not select.select([self._in], [], [], max(0.0, end - time.monotonic()))[0]:
                raise TimeoutError("the browser does not answer")
            piece = os.read(self._in, 1 << 20)
            if not piece:
                raise EOFError("the browser has ended")
            self._buffer += piece
        text, self._buffer = self._buffer.split(b"\0", 1)
        message = json.loads(text)
        if "method" in message:
            self.events.append(message)
        return message

    def open(self, address: str | Path) -> None:
        """Open a file or an address and wait until it is loaded; forget the events before."""
        url = address.as_uri() if isinstance(address, Path) else address
        self._load("about:blank")  # else the same file with another part would not be loaded again
        self._load(url)

    def _load(self, url: str) -> None:
        self.events.clear()
        self.call("Page.navigate", url=url)
        end = time.monotonic() + PATIENCE
        while not any(event["method"] == "Page.loadEventFired" for event in self.events):
            self._read(end)

    def run(self, expression: str, **more: Any) -> Any:
        """Return the value of an expression of JavaScript; promises are awaited."""
        answer = self.call("Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True, **more)
        if "exceptionDetails" in answer:
            details = answer["exceptionDetails"]
            raise RuntimeError(details.get("exception", {}).get("description") or details["text"])
        return answer["result"].get("value")

    def contexts(self) -> list[int]:
        """Return what to evaluate in (`contextId`): the page and the frames in it, as they came."""
        self.run("0")
        return [e["params"]["context"]["id"] for e in self.events if e["method"] == "Runtime.executionContextCreated"]

    def key(self, key: str, text: str = "", modifiers: int = 0) -> None:
        """Press and release a key."""
        for kind in ("keyDown", "keyUp"):
            down = {"text": text} if text and kind == "keyDown" else {}
            self.call("Input.dispatchKeyEvent", type=kind, key=key, modifiers=modifiers, **down)

    def mouse(self, kind: str, x: float, y: float, **more: Any) -> None:
        """Move ("mouseMoved"), press ("mousePressed") or release ("mouseReleased") the mouse at a place of the page."""
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, **more)

    def click(self, x: float, y: float, count: int = 1) -> None:
        """Click at a place of the page."""
        for kind in ("mousePressed", "mouseReleased"):
            self.mouse(kind, x, y, button="left", clickCount=count)

    def picture(self, path: Path | None = None) -> bytes:
        """Return a picture of the page, PNG."""
        data = base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"])
        if path:
            path.write_bytes(data)
        return data

    def faults(self) -> list[str]:
        """Return what the page said it failed at: exceptions, errors and warnings of its console."""
        self.run("0")  # whatever is on its way has come
        found = []
        for event in self.events:
            said = event.get("params", {})
            if event["method"] == "Runtime.exceptionThrown":
                details = said["exceptionDetails"]
                found.append(details.get("exception", {}).get("description") or details["text"])
            elif event["method"] == "Runtime.consoleAPICalled" and said["type"] in ("error", "warning", "assert"):
                found.append(" ".join(str(a.get("value", a.get("description"))) for a in said["args"]))
            elif event["method"] == "Log.entryAdded" and said["entry"]["level"] in ("error", "warning"):
                found.append(said["entry"]["text"])
        return found

    def requests(self) -> list[str]:
        """Return the addresses that the page asked for, its own file and data inside it aside."""
        self.run("0")
        asked = [e["params"]["request"]["url"] for e in self.events if e["method"] == "Network.requestWillBeSent"]
        return [url for url in asked[1:] if not url.startswith(("data:", "blob:"))]

    def close(self) -> None:
        """End the browser and all processes it started."""
        with contextlib.suppress(OSError, RuntimeError, TimeoutError, EOFError):
            self._session = None
            self.call("Browser.close")
            self._process.wait(5)
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self.group, signal.SIGKILL)
        self._process.wait()
        os.close(self._in)
        os.close(self._out)
        self._home.cleanup()

    def __enter__(self) -> Browser:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
