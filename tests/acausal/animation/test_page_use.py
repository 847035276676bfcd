"""The page in use: keys, buttons, address, plots, pointer, film, and where something is missing."""

from __future__ import annotations

import subprocess
import time
from html import escape
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.image import imread

from acausal.animation.page import html
from tests.acausal.animation.browser import Browser, installed
from tests.acausal.animation.conftest import Show
from tests.acausal.animation.made import Columns, document, every_kind

NOW = "acausal.time()"
PAINTED = "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(null))))"


@pytest.fixture(scope="module")
def run() -> dict:
    return every_kind()[0]


def until(browser: Browser, expression: str, patience: float = 20, **more: Any) -> None:
    """Wait until something is so."""
    end = time.monotonic() + patience
    while not browser.run(f"Boolean({expression})", **more):
        assert time.monotonic() < end, expression
        time.sleep(0.02)


def shown(browser: Browser, place: str) -> bool:
    return browser.run(f"document.querySelector({place!r}).checkVisibility()")


def test_keys_step_from_frame_to_frame(show: Show, run: dict) -> None:
    browser = show(document(run), "#t=0.505")
    frames = np.linspace(0, 2, 101)
    shift = 8
    keys = [("ArrowRight", 0, 26), ("ArrowRight", 0, 27), ("ArrowLeft", 0, 26), ("ArrowRight", shift, 36)]
    keys += [("ArrowLeft", shift, 26), ("End", 0, 100), ("ArrowRight", 0, 100), ("ArrowLeft", 0, 99), ("Home", 0, 0)]
    keys += [("ArrowLeft", 0, 0)]
    for key, held, frame in keys:
        browser.key(key, modifiers=held)
        assert browser.run(NOW) == frames[frame], (key, frame)
    browser.run("acausal.seek(0.505)")
    browser.key("ArrowLeft")
    assert browser.run(NOW) == frames[25]  # the frame before, not one further
    until(browser, "document.querySelector('#now').textContent.startsWith('0.5')")


def test_play_pause_speed_and_loop(show: Show, run: dict) -> None:
    browser = show(document(run), "")
    until(browser, f"{NOW} > 0")  # it plays by itself
    browser.key(" ")
    stopped = browser.run(NOW)
    browser.run(PAINTED)
    assert browser.run(NOW) == stopped
    assert browser.run("acausal.viewer.clock.defaultSpeed") == pytest.approx(0.2)  # 2 s of the machine in 10 s
    speeds = []
    for key in "++--":
        browser.key(key, key)
        speeds.append(browser.run("acausal.viewer.clock.speed"))
    assert speeds == pytest.approx([0.5, 1, 0.5, 0.2])
    for key, end in (("-", 1e-3), ("+", 100)):
        for _ in range(20):
            browser.key(key, key)
        assert browser.run("acausal.viewer.clock.speed") == pytest.approx(end)
    browser.run("acausal.seek(1.9)")
    browser.key(" ")
    until(browser, f"{NOW} !== 1.9")
    assert browser.run("acausal.viewer.clock.playing")
    browser.key("l", "l")  # no loop: it ends at the end
    until(browser, "!acausal.viewer.clock.playing")
    assert browser.run(NOW) == 2
    browser.key(" ")  # and begins again
    until(browser, f"{NOW} < 2 || {NOW} === 2 && !acausal.viewer.clock.playing")


def test_natural_speed(show: Show, run: dict) -> None:
    browser = show(document(run))
    speeds = browser.run(
        "[1e-3, 0.03, 0.3, 1.6, 3, 5, 10, 20, 300, 5e7].map((last) => [last, Object.assign(Object.create("
        "Object.getPrototypeOf(acausal.viewer.clock)), {first: 0, last}).chooseSpeed()])"
    )
    for duration, speed in speeds:
        assert 4 <= duration / speed <= 12.6
        assert float(f"{speed:.0e}") == pytest.approx(speed)
        assert f"{speed:.0e}"[0] in "125"


def test_it_draws_only_when_something_changes(show: Show, run: dict) -> None:
    browser = show(document(run))
    time.sleep(0.3)
    before = browser.run("acausal.renders()")
    time.sleep(0.4)
    assert browser.run("acausal.renders()") == before
    browser.key("ArrowRight")
    until(browser, f"acausal.renders() > {before}")


def test_address(show: Show, run: dict) -> None:
    browser = show(
        document(run), "#t=1.2&x=10&view=top&speed=0.5&colour=bending%20moment&force=1&loop=0&follow=machine.box"
    )
    state = browser.run(
        "(({clock, stage, views}) => [clock.t, clock.playing, clock.speed, clock.loop, stage.deformation, views.name,"
        " stage.colours.name, stage.show.force, stage.show.torque, Boolean(views.followed)])(acausal.viewer)"
    )
    assert state == [1.2, False, 0.5, False, 10, "top", "bending moment", True, False, True]
    browser.run("void (location.hash = '#t=0.4&x=0&speed=no&view=inside&colour=none&nonsense')")
    until(browser, f"{NOW} === 0.4")
    assert browser.run("[acausal.viewer.stage.deformation, acausal.viewer.stage.colours.name]") == [10, "none"]


@pytest.mark.parametrize(
    ("up", "view", "right", "above"),
    [
        ((0, 1, 0), "front", (1, 0, 0), (0, 1, 0)),
        ((0, 1, 0), "top", (1, 0, 0), (0, 0, -1)),
        ((0, 1, 0), "right", (0, 0, -1), (0, 1, 0)),
        ((0, 0, 1), "front", (1, 0, 0), (0, 0, 1)),
        ((0, 0, 1), "top", (1, 0, 0), (0, 1, 0)),
        ((0, 0, 1), "right", (0, 1, 0), (0, 0, 1)),
    ],
)
def test_standard_views(show: Show, run: dict, up: tuple, view: str, right: tuple, above: tuple) -> None:
    """What is to the right and above in the picture."""
    browser = show(document({**run, "up": up}), f"#t=0&view={view}")
    axes = browser.run(
        "acausal.viewer.update(), [0, 1].map((k) => acausal.viewer.stage.camera.matrixWorld.toArray().slice(4 * k, 4 * k + 3))"
    )
    assert axes[0] == pytest.approx(right, abs=1e-3)
    assert axes[1] == pytest.approx(above, abs=1e-3)


@pytest.mark.parametrize("scale", [1e-3, 1e7])
def test_the_whole_scene_is_in_the_picture(show: Show, scale: float) -> None:
    """All corners of the scene lie within the picture and between the planes that cut it, from every side."""
    browser = show(document(every_kind(scale)[0]))
    for view in ("front", "top", "right", "iso"):
        corners = browser.run(f"""(() => {{
            const {{stage, views}} = acausal.viewer;
            views.show({view!r}); stage.camera.updateMatrixWorld(); stage.setClippingPlanes();
            return [...Array(8).keys()].map((k) => {{
                const p = [0, 1, 2].map((j) => ((k >> j) & 1 ? stage.high : stage.low)[j]);
                return stage.camera.position.clone().set(...p).project(stage.camera).toArray();
            }});
        }})()""")
        assert np.abs(corners).max() < 1
        assert np.abs(np.array(corners)[:, :2]).max() > 0.7


def test_a_part_is_followed(show: Show, run: dict) -> None:
    browser = show(document(run), "#t=0&follow=machine.sphere")
    relative = []
    for t in (0, 0.7, 1.6):
        browser.run(f"acausal.seek({t})")
        camera, ball = browser.run(
            "[acausal.viewer.stage.toWorld(acausal.viewer.stage.camera, [0, 0, 0]), acausal.positions(3)[0]]"
        )
        relative.append(np.subtract(ball, camera))
    assert relative[1] == pytest.approx(relative[0], abs=1e-5)
    assert relative[2] == pytest.approx(relative[0], abs=1e-5)


def test_a_trace_is_the_path_of_the_point(show: Show, run: dict) -> None:
    expected = every_kind()[1][3][:, 0]
    browser = show(document(run))
    browser.run("acausal.viewer.choose('0/3'), acausal.viewer.traceChosen()")
    path = browser.run(
        "(({traces, stage}) => { const {array} = traces.list[0].lines[0].geometry.attributes.position;"
        " return [...array].map((v, i) => v + stage.origin[i % 3]); })(acausal.viewer)"
    )
    assert np.reshape(path, (-1, 3)) == pytest.approx(expected, abs=4e-6)
    browser.run("acausal.viewer.traceChosen()")
    assert browser.run("acausal.viewer.traces.list.length") == 0


def place_of(browser: Browser, shape: int) -> list[float]:
    """Where the middle of a shape is in the window (pixels)."""
    return browser.run(f"""(() => {{
        acausal.viewer.update();
        const {{stage}} = acausal.viewer, box = stage.element.getBoundingClientRect();
        const seen = acausal.positions({shape});
        const p = [0, 1, 2].map((j) => seen.reduce((sum, q) => sum + q[j], 0) / seen.length - stage.origin[j]);
        const q = stage.camera.position.clone().set(...p).project(stage.camera);
        return [box.left + (q.x + 1) / 2 * box.width, box.top + (1 - q.y) / 2 * box.height];
    }})()""")


def test_pointer_tells_and_chooses_the_part(show: Show, run: dict) -> None:
    browser = show(document(run), "#t=0.3&view=front")
    browser.run(PAINTED)
    for shape, path, kind in ((3, "machine.sphere", "Body"), (7, "machine.rail", "Spring")):
        x, y = place_of(browser, shape)
        browser.mouse("mouseMoved", x, y)
        until(browser, f"document.querySelector('#tip').textContent === {path + kind!r}")
        browser.click(x, y)
        until(browser, f"document.querySelector('#part').value === '0/{shape}'")
    browser.mouse("mouseMoved", 5, 100)
    until(browser, "document.querySelector('#tip').hidden")


def test_a_click_in_a_plot_seeks(show: Show, run: dict) -> None:
    browser = show(document(run))
    left, top, width, height = browser.run(
        "(({left, top, width, height}) => [left, top, width, height])(document.querySelector('.area').getBoundingClientRect())"
    )
    first, last = left + 58, left + width - 12  # the edges of plots.js
    browser.click(first + 0.25 * (last - first), top + height / 2)
    assert browser.run(NOW) == pytest.approx(0.5, abs=0.01)
    browser.run(PAINTED)
    at = browser.run("document.querySelector('.cursor').getBoundingClientRect().left")
    assert at == pytest.approx(first + 0.25 * (last - first), abs=2)
    value = float(browser.run("document.querySelector('.legend output').textContent").replace("\u2212", "-"))
    assert value == pytest.approx(np.sin(3 * browser.run(NOW)), abs=1e-3)


def test_outputs_of_like_size_share_a_panel(show: Show) -> None:
    t = np.linspace(0, 2, 101)
    run = every_kind()[0]
    columns = Columns(t)
    plots = [
        {"name": name, "unit": unit, "column": columns.add(values)[0]}
        for name, unit, values in (
            ("large", "m", np.sin(t)),
            ("small", "m", 0.01 * np.cos(3 * t)),
            ("still", "m", 0.5 + 0 * t),
            ("smaller", "m", 0.002 * np.sin(7 * t)),
            ("far", "m", 100 + np.cos(t)),
            ("other", "rad", np.sin(t)),
        )
    ]
    bare = {**run, **columns.document(), "poses": [], "parts": [], "shapes": [], "plots": columns.number(plots)}
    browser = show(document(bare))
    panels = browser.run(
        "[...document.querySelectorAll('.legend')].map((e) => [...e.children].map((b) => b.textContent.split(' ')[0]))"
    )
    assert panels == [["large", "still"], ["small", "smaller"], ["far"], ["other"]]


def test_an_output_may_have_no_value_for_a_while(show: Show) -> None:
    t = np.linspace(0, 2, 101)
    columns = Columns(t)
    column = columns.add(np.where((t > 0.5) & (t < 1.5), np.nan, 1 + t))[0]
    plots = [{"name": "force", "unit": "N", "column": column}]
    bare = {**every_kind()[0], **columns.document(), "poses": [], "parts": [], "shapes": [], "plots": plots}
    browser = show(document(bare), "#t=1")
    browser.run(PAINTED)
    assert browser.run("document.querySelector('.legend output').textContent") == "\u2013"
    # Columns of pixels in which the curve's blue is: none of the middle half of the time.
    blue = browser.run("""((canvas) => {
        const {width, height} = canvas, {data} = canvas.getContext("2d").getImageData(0, 0, width, height), found = [];
        for (let x = 0; x < width; x++) for (let y = 0; y < height; y++) {
            const [r, g, b, a] = data.slice(4 * (x + width * y), 4 * (x + width * y) + 4);
            if (a > 200 && b > r + 100) { found.push((x / width * canvas.clientWidth - 58) / (canvas.clientWidth - 70)); break; }
        }
        return found;
    })(document.querySelector(".area canvas"))""")
    assert min(blue) < 0.02
    assert max(blue) > 0.98
    assert not [x for x in blue if 0.26 < x < 0.74]


def test_colours_of_the_picture(show: Show, run: dict) -> None:
    browser = show(document(run), "#t=0.3&view=front&grid=0")
    browser.run(PAINTED)
    picture = (255 * imread(BytesIO(browser.picture()))[..., :3]).round().astype(int)
    colours = {tuple(colour) for colour in picture.reshape(-1, 3)}
    assert {(0xEE, 0xF2, 0xF7), (0xE5, 0x48, 0x4D)} <= colours  # the sky and the x axis, which no light changes
    x, y = place_of(browser, 3)
    assert picture[int(y), int(x)] == pytest.approx((37, 162, 121), abs=2)  # the ball, lit by the sky and the sun


def test_colours_of_values(show: Show, run: dict) -> None:
    browser = show(document(run), "#t=0&colour=bending%20moment")
    colours = "((item) => [...item.tube.color].slice(0, 3))(acausal.viewer.runs[0].items[10])"
    high, middle = (browser.run(f"acausal.seek({t}), {colours}") for t in (0, np.pi / 8))
    assert high[0] > 0.4 > high[2]  # red: the moment at the root is 12, the largest
    assert max(middle) - min(middle) < 0.05  # grey: it is 0
    assert shown(browser, "#bar")
    assert browser.run("document.querySelector('#bar').textContent") == "bending moment (N.m)\u221212012"
    browser.key("c", "c")  # the next: deflection of the plate, by its modes
    assert browser.run("acausal.viewer.stage.colours.name") == "deflection"
    browser.key("c", "c")
    browser.run(PAINTED)
    assert not shown(browser, "#bar")


def test_several_runs_side_by_side_and_as_ghosts(show: Show, run: dict) -> None:
    other = {**run, "name": "other", "stopped": "the step became too small"}
    browser = show(document(run, other))
    panels = "acausal.viewer.stage.panels().map((panel) => panel.runs.map((run) => run.name))"
    assert browser.run(panels) == [["machine"], ["other"]]
    browser.key("h", "h")
    assert browser.run(panels) == [["machine", "other"]]
    browser.run(PAINTED)
    assert browser.run("[...document.querySelectorAll('.run-name')].map((e) => e.textContent)") == ["machine", "other"]
    assert (
        browser.run("document.querySelector('#stopped').textContent")
        == "other: stopped at 2 s: the step became too small"
    )


def test_forces_and_frames_on_demand(show: Show, run: dict) -> None:
    browser = show(document(run), "#t=0.3")
    visible = "[8, 9].map((k) => acausal.viewer.runs[0].items[k].object.visible)"
    assert browser.run(visible) == [False, False]
    browser.key("v", "v")
    browser.key("f", "f")
    browser.run(PAINTED)
    assert browser.run(visible) == [True, True]
    assert browser.run("acausal.viewer.runs[0].poses.every((pose) => pose.axes.visible)")
    browser.key("v", "v")
    browser.run(PAINTED)
    assert browser.run(visible) == [False, False]


def press(browser: Browser, place: str) -> None:
    """Click in the middle of an element, as the picture that is due shows it."""
    browser.run(PAINTED)
    x, y = browser.run(
        "(({left, top, width, height}) => [left + width / 2, top + height / 2])"
        f"(document.querySelector({place!r}).getBoundingClientRect())"
    )
    browser.click(x, y)


def test_buttons_and_boxes(show: Show, run: dict) -> None:
    browser = show(document(run, {**run, "name": "other"}))
    press(browser, "#options summary")
    for name in ("grid", "axes", "frames", "force", "torque"):
        before = browser.run(f"acausal.viewer.stage.show[{name!r}]")
        press(browser, f"#show-{name}")
        assert browser.run(f"acausal.viewer.stage.show[{name!r}]") is not before
    press(browser, "#ghosts")
    assert browser.run("acausal.viewer.stage.ghosts")
    press(browser, "#show-plots")
    assert not shown(browser, "#plots")
    press(browser, "#deformation")
    assert browser.run("acausal.viewer.stage.deformation") == pytest.approx(10**1.5, rel=0.1)
    press(browser, "#top")
    assert browser.run("acausal.viewer.views.name") == "top"
    press(browser, "#play")
    until(browser, f"acausal.viewer.clock.playing && {NOW} > 0")
    browser.key(" ")  # the button has given the keys back
    assert not browser.run("acausal.viewer.clock.playing")
    browser.key("Home")  # away from the place that is pressed, where the thumb would stay as it is
    press(browser, "#time")
    assert browser.run(NOW) == pytest.approx(1, abs=0.02)
    browser.key("ArrowRight")
    assert browser.run(NOW) in np.linspace(0, 2, 101)


def test_nothing_moves_when_it_plays(show: Show, run: dict) -> None:
    """Whoever aims at the slider of time while it plays or stops hits what was aimed at."""
    browser = show(document(run))
    places = "[...document.querySelectorAll('#transport *')].map((e) => e.getBoundingClientRect()).map((r) => [r.x, r.width])"
    still = browser.run(places)
    for key in "  ":
        browser.key(key, key)
        browser.run(PAINTED)
        assert browser.run(places) == still


def test_drag_turns_and_wheel_comes_nearer(show: Show, run: dict) -> None:
    browser = show(document(run), "#t=0&view=front")
    distance = "(({camera}) => camera.position.length())(acausal.viewer.stage)"
    place = "acausal.viewer.stage.camera.position.toArray()"
    before, far = browser.run(place), browser.run(distance)
    browser.mouse("mousePressed", 200, 200, button="left", clickCount=1)
    browser.mouse("mouseMoved", 300, 220, button="left", buttons=1)
    browser.mouse("mouseReleased", 300, 220, button="left", clickCount=1)
    assert np.abs(np.subtract(browser.run(place), before)).max() > 0.1 * far
    assert browser.run(distance) == pytest.approx(far)
    ball = place_of(browser, 3)
    browser.mouse("mouseWheel", *ball, deltaX=0, deltaY=-300)
    until(browser, f"{distance} < {0.9 * far}")
    assert place_of(browser, 3) == pytest.approx(ball, abs=0.5)  # what is under the pointer stays there
    browser.key("0", "0")
    assert browser.run(distance) > 0.9 * far
    assert not browser.run("acausal.viewer.chosen")  # a drag is no click


def test_film(show: Show, run: dict) -> None:
    # Long enough for some pictures where the machine does much else.
    browser = show(document(run), "#t=1&speed=1")
    browser.key("r", "r")
    until(browser, "acausal.viewer.recorder.film")
    assert browser.run("acausal.viewer.recorder.film.type") == "video/webm"
    assert browser.run("acausal.viewer.recorder.film.size") > 1000
    assert browser.run("acausal.viewer.clock.loop")


def test_everything_has_a_name_and_fits_a_phone(show: Show, run: dict) -> None:
    browser = show(document(run, run))
    nameless = browser.run(
        "[...document.querySelectorAll('button, input, select, canvas[role]')].filter((e) =>"
        " !(e.ariaLabel || e.labels?.[0]?.textContent.trim() || (e.tagName === 'BUTTON' && e.textContent.trim())))"
        ".map((e) => e.id)"
    )
    assert nameless == []
    browser.call("Emulation.setDeviceMetricsOverride", width=360, height=640, deviceScaleFactor=2, mobile=True)
    try:
        browser.run(PAINTED)
        assert browser.run("document.documentElement.scrollWidth") <= 360
        assert browser.run("document.documentElement.scrollHeight") <= 640
        assert browser.run("document.querySelector('#picture').clientHeight") > 200
    finally:
        browser.call("Emulation.clearDeviceMetricsOverride")


def test_dark(show: Show, run: dict) -> None:
    browser = show(document(run))
    back = "getComputedStyle(document.body).backgroundColor"
    light = browser.run(back)
    browser.key("d", "d")
    dark = browser.run(back)
    browser.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark"}])
    try:
        browser = show(document(run))
        assert browser.run(back) == dark != light
    finally:
        browser.call("Emulation.setEmulatedMedia", features=[])


def test_list_of_keys(show: Show, run: dict) -> None:
    browser = show(document(run))
    browser.key("?", "?")
    assert shown(browser, "#help-list")
    browser.key("?", "?")
    assert not shown(browser, "#help-list")


def test_without_webgl_plots_still_work(show: Show, run: dict, one_browser: Browser) -> None:
    none = (
        "HTMLCanvasElement.prototype.getContext = ((old) => function (kind, ...more) {"
        " return /webgl/.test(kind) ? null : old.call(this, kind, ...more); })(HTMLCanvasElement.prototype.getContext)"
    )
    script = one_browser.call("Page.addScriptToEvaluateOnNewDocument", source=none)
    try:
        browser = show(document(run), "#t=0.5")
        assert "no WebGL" in browser.run("document.querySelector('#without').innerText")
        assert shown(browser, "#without")
        drawn = browser.run(
            "((c) => c.getContext('2d').getImageData(0, 0, c.width, c.height).data.some((v) => v > 0))"
            "(document.querySelector('.area canvas'))"
        )
        assert drawn
        browser.key("End")
        assert browser.run(NOW) == 2
    finally:
        one_browser.call("Page.removeScriptToEvaluateOnNewDocument", identifier=script["identifier"])


def test_in_a_sandboxed_frame(one_browser: Browser, run: dict, tmp_path: Path) -> None:
    """As a notebook shows it: without an origin, an address or storage."""
    inner = html(document(run))
    frame = (
        f'<iframe sandbox="allow-scripts allow-downloads" width="700" height="500" srcdoc="{escape(inner)}"></iframe>'
    )
    file = tmp_path / "notebook.html"
    file.write_text(f"<!DOCTYPE html><title>notebook</title>{frame}", encoding="utf-8", newline="")
    one_browser.open(file)
    inside = {"contextId": one_browser.contexts()[-1]}
    until(one_browser, "window.acausal?.renders?.() > 1", **inside)
    assert one_browser.run("[location.href, origin, acausal.errors.length]", **inside) == ["about:srcdoc", "null", 0]
    assert one_browser.run("acausal.seek(1), acausal.time()", **inside) == 1
    assert one_browser.faults() == []
    assert one_browser.requests() == []


def test_nothing_of_the_browser_is_left() -> None:
    """A second browser, closed: of its process group nothing runs any more."""
    path = installed()
    if path is None:
        pytest.skip("no headless Chromium is installed")
    with Browser(path) as second:
        group = second.group
        assert running(group)
    end = time.monotonic() + 10
    while running(group):
        assert time.monotonic() < end
        time.sleep(0.02)


def running(group: int) -> list[int]:
    """Processes of a group that are not merely waiting to be counted."""
    rows = [line.split() for line in subprocess.check_output(["ps", "-eo", "pid=,pgid=,stat="], text=True).splitlines()]
    return [int(pid) for pid, of, state in rows if int(of) == group and not state.startswith("Z")]
