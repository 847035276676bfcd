"""Notebooks: a summary of each result, and its animation in a frame; one player serves all frames of a notebook."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as some

import acausal as ac
import models
from acausal.result import notebook
from tests.acausal.animation.browser import Browser
from tests.acausal.animation.test_page_use import until

PLAYER = '"acausal-player"));'
RUN = "(window.acausal?.renders?.() > 0)"


@pytest.fixture(scope="module")
def result() -> ac.Result:
    return ac.simulate(models.SimplePendulum(), stop_time=0.2, intervals=10)


@pytest.fixture
def display(result: ac.Result, monkeypatch: pytest.MonkeyPatch) -> Callable[..., str]:
    """A function that shows the result in an execution of a cell, and returns the HTML."""
    request: dict[str, Any] = {}
    shell = SimpleNamespace(get_parent=lambda: request)
    monkeypatch.setitem(sys.modules, "IPython", SimpleNamespace(get_ipython=lambda: shell))  # type: ignore[arg-type]
    monkeypatch.setattr(notebook, "_holder", None)

    def show(session: str, cell: str, execution: str, known: bool = True) -> str:
        metadata = {"cellId": cell} if known else {}
        header = {"session": session, "msg_id": execution}
        request.update(header=header, metadata=metadata, content={"code": cell})
        return result._repr_html_()

    return show


def opened(browser: Browser, tmp_path: Path, *outputs: str) -> list[int]:
    """Show a page of outputs, and return the contexts of the frames that play, once there are so many as outputs."""
    file = tmp_path / "notebook.html"
    file.write_text(f"<!DOCTYPE html><meta charset=utf-8>{''.join(outputs)}", encoding="utf-8")
    browser.open(file)
    return playing(browser)


def playing(browser: Browser) -> list[int]:
    frames = browser.run("document.querySelectorAll('iframe').length")
    found: list[int] = []
    for _ in range(200):
        found = []
        for context in browser.contexts()[1:]:
            try:
                found += [context] if browser.run(RUN, contextId=context) else []
            except RuntimeError:
                continue  # the frame has another page now
        if len(found) == frames:
            break
        browser.run("new Promise((done) => setTimeout(done, 50))")
    return found


def test_without_a_notebook_the_frame_is_complete(result: ac.Result) -> None:
    text = result._repr_html_()
    assert text == result._repr_html_()
    assert text.count(PLAYER) == text.count('<iframe id="acausal-') == text.count("<script>") == 1
    assert 'sandbox="allow-scripts allow-downloads"' in text


def test_summary_tells_times_outputs_and_warnings() -> None:
    for model in (models.FlexiblePendulum(), models.SimplePendulum()):
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr("warnings.warn", lambda *_, **__: None)
            result = ac.simulate(model, stop_time=0.1, intervals=4)
        text = result._repr_html_().partition("<iframe")[0]
        assert all(name in text for name in (type(model).__name__, "5 times", *result.outputs))
        assert text.count("Warning: ") == len(result.stats.doubts)


runs = some.lists(some.tuples(some.sampled_from("abc"), some.integers(1, 2)), min_size=1, max_size=12)


@pytest.mark.parametrize("known", [True, False])
@settings(max_examples=15, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(cells=runs)
def test_a_notebook_holds_one_player(display: Callable[..., str], known: bool, cells: list[tuple[str, int]]) -> None:
    notebook._holder = None
    outputs: dict[str, str] = {}
    for number, (cell, count) in enumerate(cells):
        outputs[cell] = ""
        for _ in range(count):
            outputs[cell] += display("session", cell, str(number), known)
        assert sum(text.count(PLAYER) for text in outputs.values()) == 1


def test_another_session_gets_a_player(display: Callable[..., str]) -> None:
    assert [
        PLAYER in display(*call) for call in (("1", "a", "1"), ("1", "b", "2"), ("2", "b", "3"), ("2", "a", "4"))
    ] == [
        True,
        False,
        True,
        False,
    ]


@pytest.mark.parametrize("order", [1, -1])
def test_frames_play_wherever_the_player_is(
    display: Callable[..., str], one_browser: Browser, tmp_path: Path, order: int
) -> None:
    outputs = [display("1", "a", "1"), display("1", "b", "2"), display("1", "c", "3")][::order]
    frames = opened(one_browser, tmp_path, *outputs)
    assert len(frames) == 3
    assert [one_browser.run("[location.href, origin]", contextId=k) for k in frames] == [["about:srcdoc", "null"]] * 3
    assert one_browser.requests() == []
    assert one_browser.faults() == []


def test_frame_without_a_player_says_what_to_do(
    display: Callable[..., str], one_browser: Browser, tmp_path: Path
) -> None:
    first, second = display("1", "a", "1"), display("1", "b", "2")
    assert len(second) < 0.1 * len(first)
    file = tmp_path / "notebook.html"
    file.write_text(f"<!DOCTYPE html><meta charset=utf-8><div id=out></div>{second}", encoding="utf-8")
    one_browser.open(file)
    inside = {"contextId": one_browser.contexts()[-1]}
    assert "Run this cell again" in one_browser.run("document.body.innerText", **inside)
    # As when the cell with the player runs.
    script = re.search(r"<script>(.*)</script>", first, re.DOTALL)
    assert script
    one_browser.run(script[1])
    assert len(playing(one_browser)) == 1
    assert one_browser.faults() == []


def test_executed_and_exported_notebook(one_browser: Browser, tmp_path: Path) -> None:
    client, convert = pytest.importorskip("nbclient"), pytest.importorskip("nbconvert")
    format_ = pytest.importorskip("nbformat")
    pytest.importorskip("ipykernel")
    head = "import acausal as ac, models\na = ac.simulate(models.SimplePendulum(), stop_time=0.2, intervals=10)"
    fault = "def run():\n    ac.simulate(models.SimplePendulum(), stop_time=-1)\nrun()"
    cells = [format_.v4.new_code_cell(text) for text in (head, "a", "a  # again", fault)]
    book = format_.v4.new_notebook(cells=cells)
    client.NotebookClient(book, kernel_name="python3", allow_errors=True).execute()
    first, second = (cell.outputs[0].data["text/html"] for cell in book.cells[1:3])
    assert (PLAYER in first, PLAYER in second) == (True, False)
    error = "\n".join(book.cells[3].outputs[0].traceback)
    assert re.findall(r"^  (\S+ \S+, line \d+)", error, re.MULTILINE) == ["Cell In[4], line 3", "Cell In[4], line 2"]
    text, _ = convert.HTMLExporter().from_notebook_node(book)
    assert len(opened(one_browser, tmp_path, text)) == 2
    until(one_browser, "document.readyState == 'complete'")
