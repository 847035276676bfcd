"""The page as a text: what stands in it, what may not, and how its bundle was made."""

from __future__ import annotations

import hashlib
import re

import pytest

from acausal.animation import page
from tests.acausal.animation.conftest import Show
from tests.acausal.animation.made import document, every_kind

NASTY = "</script><script>document.title='no'</script><img src=x onerror=\"document.title='no'\"> & 'q' \u2028 @policy@ \\u003c"


def test_bundle_is_what_its_recipe_tells() -> None:
    told = dict(re.findall(r"\| `(three\.\S+)` \| `(\w{64})` \|", page.part("BUNDLE.md")))
    assert set(told) == {"three.entry.js", "three.min.js"}
    assert told == {name: hashlib.sha256((page.FOLDER / name).read_bytes()).hexdigest() for name in told}


def test_bundle_keeps_its_licence() -> None:
    assert "@license" in page.bundled()
    assert "SPDX-License-Identifier: MIT" in page.bundled()


def test_every_file_of_the_page_is_used_and_short() -> None:
    names = {path.name for path in page.FOLDER.iterdir()}
    viewer = {f"{name}.js" for name in page.SCRIPTS}
    assert names == viewer | {"index.html", "viewer.css", "three.min.js", "three.entry.js", "BUNDLE.md", "DOCUMENT.md"}
    assert not [name for name in names - {"three.min.js"} if page.part(name).count("\n") > 300]


def test_nothing_that_asks_or_evaluates() -> None:
    words = r"\b(eval|fetch|importScripts)\(|new (Function|Worker|SharedWorker|XMLHttpRequest|WebSocket|EventSource)\b|\bimport\("
    text = page.html(document(every_kind()[0]))
    assert not re.search(words, text)
    assert not re.search(r"\b(src|href)=", re.sub(r"<script>.*?</script>", "", text, flags=re.DOTALL))
    assert "localStorage" not in text
    assert "sessionStorage" not in text


def test_size() -> None:
    assert len(page.html(document(every_kind()[0]))) < 0.75e6


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
