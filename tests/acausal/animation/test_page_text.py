"""The page as a text: what stands in it, what may not, and what becomes of three.js."""

from __future__ import annotations

import re
import sys

import pytest

from acausal.animation import page
from acausal.errors import DeclarationError
from tests.acausal.animation.conftest import Show
from tests.acausal.animation.made import document, every_kind

NASTY = "</script><script>document.title='no'</script><img src=x onerror=\"document.title='no'\"> & 'q' \u2028 @policy@ \\u003c"


def test_three_js_keeps_its_licence() -> None:
    text = page.html(document(every_kind()[0]))
    assert "@license\n * Copyright 2010-2021 Three.js Authors\n * SPDX-License-Identifier: MIT" in text


def test_missing_three_js_is_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "jupyter_threejs_sage", None)
    with pytest.raises(DeclarationError, match=r"pip install 'jupyter-threejs-sage>=130'"):
        page.three_js.__wrapped__()


def test_every_file_of_the_page_is_used_and_short() -> None:
    names = {path.name for path in page.FOLDER.iterdir()}
    viewer = {f"{name}.js" for name in (*page.SCRIPTS, *page.EXPLORER)}
    assert names == viewer | {"index.html", "viewer.css", "explorer.css", "frame.js", "DOCUMENT.md"}
    assert not [name for name in names if page.part(name).count("\n") > 300]


def test_nothing_that_asks_or_evaluates() -> None:
    words = r"\b(eval|fetch|importScripts)\(|new (Function|Worker|SharedWorker|XMLHttpRequest|WebSocket|EventSource)\b|\bimport\("
    # three.js has loaders, which the viewer does not use and the page's policy forbids.
    text = page.html(document(every_kind()[0])).replace(page.three_js(), "")
    assert not re.search(words, text)
    assert not re.search(r"\b(src|href)=", re.sub(r"<script>.*?</script>", "", text, flags=re.DOTALL))
    assert "localStorage" not in text
    assert "sessionStorage" not in text


def test_size() -> None:
    assert len(page.html(document(every_kind()[0]))) < 0.765e6


@pytest.mark.parametrize("value", [float("nan"), float("inf")])
def test_numbers_are_finite(value: float) -> None:
    run = every_kind()[0]
    with pytest.raises(ValueError, match=r"JSON"):
        page.html(document({**run, "size": value}))


def test_any_characters_in_title_and_names(show: Show) -> None:
    run = every_kind()[0]
    parts = [{"path": NASTY, "type": NASTY} for _ in run["parts"]]
    plots = [{**plot, "name": NASTY, "unit": NASTY} for plot in run["plots"][:1]]
    run = {**run, "name": NASTY, "stopped": NASTY, "parts": parts, "plots": plots}
    browser = show(document(run, run, title=NASTY))
    browser.run("acausal.viewer.colour('bending moment')")
    browser.run("acausal.viewer.choose('0/1')")
    assert browser.run("document.images.length") == 0
    assert browser.run("document.scripts.length") == 3
    assert browser.run("document.title").split() == NASTY.split()
    assert NASTY in browser.run("document.querySelector('#stopped').textContent")
    assert NASTY in browser.run("document.querySelector('.legend').textContent")


def test_policy_lets_nothing_else_run(show: Show) -> None:
    browser = show(document(every_kind()[0]))
    said = browser.run(
        "new Promise((done) => { addEventListener('securitypolicyviolation', (e) => done(e.effectiveDirective));"
        " const s = document.createElement('script'); s.textContent = 'acausal.errors.push(1)'; document.body.append(s); })"
    )
    assert said == "script-src-elem"
    asked = browser.run("fetch('https://example.org').then(() => 'answered', () => 'refused')")
    assert asked == "refused"
    browser.events.clear()  # the console told both
