"""One browser for all tests of a process, or the reason why there is none."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from acausal.animation.page import html
from tests.acausal.animation.browser import Browser, installed

Show = Callable[..., Browser]


@pytest.fixture(scope="session")
def one_browser() -> Iterator[Browser]:
    path = installed()
    if path is None:
        pytest.skip("no headless Chromium is installed (Debian: apt-get install chromium-headless-shell)")
    with Browser(path) as browser:
        yield browser


@pytest.fixture
def show(one_browser: Browser, tmp_path: Path) -> Iterator[Show]:
    """A function that opens a document's page from a file; afterwards nothing may have failed or asked the network."""
    opened = []

    def opening(document: dict[str, Any], address: str = "#t=0") -> Browser:
        file = tmp_path / "page.html"
        file.write_text(html(document), encoding="utf-8", newline="")
        one_browser.open(file.as_uri() + address)
        one_browser.run("acausal.ready.then(() => null)")
        opened.append(file)
        return one_browser

    yield opening
    if opened:
        assert one_browser.faults() == []
        assert one_browser.requests() == []
        assert one_browser.run("acausal.errors") == []
