"""The explorer in use: the tree, the filter, plots, events, keys, phones, and a model without a picture."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest

import acausal as ac
from acausal import Model, Scalar, der, discrete, geometry, output, parameter, reinit, variable, when
from acausal.language.types import Vector3
from acausal.result import Result
from tests.acausal.animation.browser import Browser
from tests.acausal.animation.test_page_use import NOW, PAINTED, press, shown, until

ROWS = "[...document.querySelectorAll('[role=treeitem]')].map((e) => e.dataset.path)"
PLOTS = "[...document.querySelectorAll('.legend')].map((e) => [...e.children].map((b) => b.textContent.trim().split(' ')[0]))"


class Ball(ac.Component):
    """A mass that rebounds from a floor."""

    x: Scalar = variable("coordinate", unit="m", start=1.0, fixed=True)
    v: Scalar = variable("velocity", unit="m/s", fixed=True)
    r: Vector3 = variable("place", unit="m")
    hits: Scalar = discrete("rebounds so far")
    e: Scalar = parameter("restitution", default=0.8)

    def equations(self):
        yield self.r == ac.as_expr((0, self.x, 0.5 * self.x))
        yield der(self.x) == self.v
        yield der(self.v) == ac.quantity(-9.81, "m/s2")
        yield when(self.x < 0, reinit(self.v, -self.e * self.v), reinit(self.hits, self.hits + 1))

    def shapes(self):
        yield geometry.Sphere(geometry.Pose(self.r, np.eye(3)), diameter=0.1)


class Bounce(Model):
    """A ball and its height."""

    ball = Ball()
    height: Scalar = output("height", unit="m")

    def equations(self):
        yield self.height == self.ball.x


class Unseen(Bounce):
    """The same without a picture."""

    def shapes(self):
        return iter(())


Show = Callable[..., Browser]


@pytest.fixture(scope="module")
def results() -> dict[str, Result]:
    return {cls.__name__: ac.simulate(cls(), stop_time=2.0, intervals=200) for cls in (Bounce, Unseen)}


@pytest.fixture
def open_explorer(one_browser: Browser, results: dict[str, Result], tmp_path: Path) -> Iterator[Show]:
    """A function that opens the explorer of a model; afterwards nothing may have failed or asked the network."""
    opened = []

    def opening(name: str = "Bounce", address: str = "#t=0") -> Browser:
        file = tmp_path / "page.html"
        results[name].explore(file)
        one_browser.open(file.as_uri() + address)
        one_browser.run("acausal.ready.then(() => null)")
        opened.append(file)
        return one_browser

    one_browser.call("Emulation.setDeviceMetricsOverride", width=1200, height=800, deviceScaleFactor=1, mobile=False)
    yield opening
    one_browser.call("Emulation.clearDeviceMetricsOverride")
    assert one_browser.faults() == []
    assert one_browser.requests() == []
    assert one_browser.run("acausal.errors") == []


def row(path: str) -> str:
    return f'[data-path="{path}"]'


def filtered(browser: Browser, text: str) -> list[str]:
    """Type into the filter, as a user does; return the rows that are left."""
    browser.run("document.querySelector('#filter').value = '', document.querySelector('#filter').focus()")
    browser.call("Input.insertText", text=text)
    return browser.run(ROWS)


def test_the_values_in_the_browser_are_those_of_the_result(open_explorer: Show, results: dict[str, Result]) -> None:
    browser, result = open_explorer(), results["Bounce"]
    seen = browser.run(
        "[...acausal.viewer.explorer.nodes.values()].map((n) => ((c) => [n.path, [...c.series(c.column(n.column))]])"
        "(acausal.viewer.explorer.columns))"
    )
    assert {path.partition("[")[0] for path, _ in seen} == set(result)
    for path, values in seen:
        exact = result[path]
        found = np.broadcast_to(values, exact.shape)
        assert found == pytest.approx(exact, abs=1e-5 * np.ptp(exact) + 1e-12)


def test_a_click_plots_and_another_one_removes(open_explorer: Show, results: dict[str, Result]) -> None:
    browser = open_explorer()
    assert browser.run(PLOTS) == [["height"]]  # the outputs at first
    press(browser, row("ball"))
    assert {"ball.x", "ball.v", "ball.r", "ball.hits", "ball.e"} <= set(browser.run(ROWS))
    press(browser, row("ball.x"))
    press(browser, row("ball.v"))
    assert browser.run(PLOTS) == [["height", "ball.x"], ["ball.v"]]  # of one unit in one plot
    press(browser, row("ball.r"))
    press(browser, row("ball.r[2]"))
    assert browser.run(PLOTS) == [["height", "ball.x", "ball.r[2]"], ["ball.v"]]
    colours = browser.run("acausal.viewer.explorer.chosen.map((one) => one.colour)")
    assert len({colours[k] for k in (0, 1, 3)}) == 3
    press(browser, row("height"))
    assert browser.run(PLOTS) == [["ball.x", "ball.r[2]"], ["ball.v"]]
    assert browser.run("acausal.viewer.explorer.chosen.map((one) => one.colour)") == colours[1:]
    press(browser, ".legend button")  # a curve is removed in its plot, too
    assert browser.run(PLOTS) == [["ball.r[2]"], ["ball.v"]]
    assert not browser.run(f"document.querySelector('{row('ball.x')}').ariaSelected === 'true'")
    press(browser, row("ball.hits"))
    browser.run("acausal.seek(0.445)")  # just before the first rebound: a cubic would undershoot
    browser.run(PAINTED)
    assert browser.run(f"document.querySelector('{row('ball.hits')} .value').textContent") == "0"
    press(browser, row("ball.hits"))
    browser.run("acausal.seek(0.2)")
    browser.run(PAINTED)
    value = results["Bounce"]["ball.v"][20]
    assert browser.run("document.querySelectorAll('.legend output')[1].textContent") == f"\u2212{-value:.3f}"
    assert browser.run(f"document.querySelector('{row('ball.v')} .value').textContent") == f"\u2212{-value:.3f} m/s"


def test_tooltips_describe(open_explorer: Show) -> None:
    browser = open_explorer()
    press(browser, row("ball"))
    assert browser.run(f"document.querySelector('{row('ball')}').title") == "ball\nA mass that rebounds from a floor."
    assert browser.run(f"document.querySelector('{row('ball.v')}').title") == "ball.v [m/s]\nvelocity"
    assert browser.run(f"document.querySelector('{row('ball.e')}').textContent") == "e0.8"


def test_the_filter_shows_matches_and_their_parts(open_explorer: Show) -> None:
    browser = open_explorer()
    assert filtered(browser, "ball.h") == ["ball", "ball.hits"]
    assert filtered(browser, "VELOC") == ["ball", "ball.v"]
    assert filtered(browser, "b*?l.r") == ["ball", "ball.r"]
    assert filtered(browser, "r[1") == ["ball", "ball.r", "ball.r[1]"]
    assert filtered(browser, "no such thing") == []
    assert browser.run("document.querySelector('#found').textContent") == "0 found"
    assert filtered(browser, "ball rebounds far") == ["ball", "ball.hits"]
    assert browser.run("document.activeElement.id") == "filter"
    assert not browser.run("acausal.viewer.clock.playing")  # its letters and spaces are no keys of the animation
    assert len(filtered(browser, " ")) == browser.run("acausal.viewer.explorer.root.children.length")


def test_the_tree_is_used_by_keys(open_explorer: Show) -> None:
    browser = open_explorer()
    filtered(browser, "ball")
    here = "document.activeElement.dataset.path"
    for key, path in (
        *(("ArrowDown", "ball"), ("ArrowRight", "ball.x"), ("ArrowDown", "ball.v"), ("End", "ball.e")),
        *(("ArrowLeft", "ball"), ("ArrowLeft", "ball"), ("ArrowRight", "ball"), ("ArrowDown", "ball.x")),
    ):
        browser.key(key)
        assert browser.run(here) == path, key
    browser.key("Enter")
    assert browser.run(PLOTS) == [["height", "ball.x"]]
    browser.key(" ", " ")
    assert browser.run(PLOTS) == [["height"]]
    assert browser.run(NOW) == 0
    assert not browser.run("acausal.viewer.clock.playing")
    browser.key("Escape")
    browser.key("End")  # now again of the animation
    assert browser.run(NOW) == 2


def test_events_are_marked_and_lead_to_their_times(open_explorer: Show, results: dict[str, Result]) -> None:
    browser, (first, second, *_) = open_explorer(), results["Bounce"].stats.event_times
    browser.run(PAINTED)
    left, top, width = browser.run(
        "(({left, top, width}) => [left, top, width])(document.querySelector('.area').getBoundingClientRect())"
    )
    at = left + 58 + (width - 70) * first / 2  # the edges of plots.js
    ink = browser.run(
        f"(([r, g, b, a]) => a > 0 && r > b + 30)([...document.querySelector('.area canvas').getContext('2d')"
        f".getImageData(Math.floor({at - left}), 20, 1, 6).data].reduce((best, v, k, all) => k % 4 || all[k + 3] < best[3]"
        " ? best : [v, all[k + 1], all[k + 2], all[k + 3]], [0, 0, 0, 0]))"
    )
    assert ink
    browser.mouse("mouseMoved", at + 1, top + 60)
    until(browser, "!document.querySelector('.happened').hidden")
    assert browser.run("document.querySelector('.happened').textContent") == f"{first:.6g} s: ball.hits: 0 \u2192 1"
    browser.mouse("mouseMoved", at + 40, top + 60)
    until(browser, "document.querySelector('.happened').hidden")
    press(browser, row("events"))
    press(browser, row(f"events {second!r}"))
    assert browser.run(NOW) == second


def test_a_click_in_a_plot_moves_the_machine(open_explorer: Show, results: dict[str, Result]) -> None:
    browser = open_explorer()
    left, top, width = browser.run(
        "(({left, top, width}) => [left, top, width])(document.querySelector('.area').getBoundingClientRect())"
    )
    browser.click(left + 58 + 0.1 * (width - 70), top + 60)
    now = browser.run(NOW)
    assert now == pytest.approx(0.2, abs=0.01)
    y = browser.run("acausal.viewer.update(), acausal.positions(0)[0][1]")
    assert y == pytest.approx(np.interp(now, results["Bounce"].time, results["Bounce"]["ball.x"]), abs=1e-3)


def test_a_click_on_a_part_opens_it_in_the_tree(open_explorer: Show) -> None:
    browser = open_explorer()
    browser.run("acausal.viewer.pick({run: acausal.viewer.runs[0], index: 0, part: 0, point: [0, 1, 0.5]})")
    assert "ball.x" in browser.run(ROWS)


def test_without_visible_parts_there_is_no_picture(open_explorer: Show) -> None:
    browser = open_explorer("Unseen")
    assert not shown(browser, "#picture")
    assert not shown(browser, "#front")
    assert browser.run(PLOTS) == [["height"]]
    assert browser.run("document.querySelector('#plots').getBoundingClientRect().height") > 500
    browser.key("End")
    assert browser.run(NOW) == 2


def test_the_address_names_the_plots(open_explorer: Show) -> None:
    browser = open_explorer("Bounce", "#t=0.5&plot=ball.v&plot=ball.r[1]")
    assert browser.run(PLOTS) == [["ball.v"], ["ball.r[1]"]]
    assert browser.run(NOW) == 0.5


def test_a_phone_has_the_tree_as_a_drawer(open_explorer: Show, one_browser: Browser) -> None:
    one_browser.call("Emulation.setDeviceMetricsOverride", width=390, height=844, deviceScaleFactor=2, mobile=True)
    browser = open_explorer()
    box = "(({left, top, right, bottom}) => [left, top, right, bottom])(document.querySelector(%r).getBoundingClientRect())"
    picture, bar, plots = (browser.run(box % place) for place in ("#picture", "#transport", "#plots"))
    assert picture[3] <= bar[1] < bar[3] <= plots[1] < plots[3] <= 844
    assert browser.run("[document.documentElement.scrollWidth, document.documentElement.scrollHeight]") == [390, 844]
    seen = "getComputedStyle(document.querySelector('#explorer')).visibility"
    assert browser.run(seen) == "hidden"
    press(browser, "#drawer")
    assert browser.run(seen) == "visible"
    press(browser, row("ball"))
    press(browser, row("ball.v"))
    assert browser.run(PLOTS) == [["height"], ["ball.v"]]
    browser.click(380, 700)  # beside the drawer
    assert browser.run(seen) == "hidden"


def test_dark_colours_and_names(open_explorer: Show) -> None:
    browser = open_explorer()
    back = "getComputedStyle(document.querySelector('#explorer')).backgroundColor"
    light = browser.run(back)
    browser.key("d", "d")
    assert browser.run(back) != light
    nameless = browser.run(
        "[...document.querySelectorAll('button, input, select, [role=tree]')].filter((e) => e.checkVisibility() &&"
        " !(e.ariaLabel || e.labels?.[0]?.textContent.trim() || e.textContent.trim())).map((e) => e.id)"
    )
    assert nameless == []
