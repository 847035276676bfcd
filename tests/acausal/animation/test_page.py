"""What the page draws is where the document says, at and between the frames; a wrong rotation would be seen."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest

from acausal.animation import page
from tests.acausal.animation.browser import Browser
from tests.acausal.animation.conftest import Show
from tests.acausal.animation.made import EXTENT, Array, Columns, document, every_kind

KINDS = [
    "ground",
    "box",
    "cylinder",
    "sphere",
    "axle",
    "span",
    "span",
    "span",
    "arrow",
    "arrow",
    "curve",
    "curve",
    "mesh",
    "trail",
]
SEEN = "Array.from({length: %d}, (_, k) => acausal.positions(k))"


@cache
def scene(
    scale: float = 1.0, away: tuple[float, ...] = (0, 0, 0), frames: int = 101
) -> tuple[dict[str, Any], list[Array]]:
    return every_kind(scale, away, frames)


def drawn(browser: Browser, t: float, shapes: int) -> list[Array]:
    """Places of all shapes at a time, as they are drawn."""
    seen = browser.run(f"acausal.seek({t!r}), {SEEN % shapes}")
    return [np.asarray(places, float).reshape(-1, 3) for places in seen]


def furthest(browser: Browser, run: dict[str, Any], expected: list[Array], frame: int) -> list[float]:
    """How far each shape is from where it ought to be at a frame (m)."""
    time = np.linspace(0, 2, run["frames"])[frame]
    seen = drawn(browser, float(time), len(expected))
    assert [len(places) for places in seen] == [len(places[frame]) for places in expected]
    return [float(np.abs(a - b[frame]).max(initial=0)) for a, b in zip(seen, expected, strict=True)]


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e7])
@pytest.mark.parametrize("away", [(0.0, 0.0, 0.0), (2.0, -1.0, 3.0)])
def test_shapes_are_drawn_where_the_document_says(show: Show, scale: float, away: tuple[float, ...]) -> None:
    run, expected = scene(scale, tuple(scale * x for x in away))
    assert [shape["kind"] for shape in run["shapes"]] == KINDS
    browser = show(document(run))
    # Columns have 24 binary digits; the scene reaches to less than twice its extent from the world's origin.
    for frame in (0, 37, 100):
        assert max(furthest(browser, run, expected, frame)) < 1e-6 * EXTENT * scale


@pytest.mark.parametrize(
    ("file", "old", "new"),
    [
        ("solids", "set(q[1], q[2], q[3], q[0])", "set(-q[1], -q[2], -q[3], q[0])"),  # transposed
        ("solids", "set(q[1], q[2], q[3], q[0])", "set(q[0], q[1], q[2], q[3])"),  # (w, x, y, z) taken for (x, y, z, w)
        ("solids", "this.pose.group.add(this.object);", POSE_TWICE := (
            "this.twice = new THREE.Group(); this.pose.group.add(this.twice); this.twice.add(this.object);"
        )),
        ("stage", "return plus([p.x, p.y, p.z], this.origin);", "return [p.x, p.y, p.z];"),
        ("curve", "minus(points[e], origin)", "points[e]"),
        ("mesh", "scale * moved[i]", "2 * scale * moved[i]"),
    ],
)  # fmt: skip
def test_mistakes_would_be_seen(show: Show, monkeypatch: pytest.MonkeyPatch, file: str, old: str, new: str) -> None:
    run, expected = scene(1.0, (2.0, -1.0, 3.0))
    text = page.part(f"{file}.js")
    assert text.count(old) == 1
    wrong = text.replace(old, new)
    if new == POSE_TWICE:
        wrong = wrong.replace(
            "  update() {}\n",
            "  update() { this.twice.position.copy(this.pose.group.position);"
            " this.twice.quaternion.copy(this.pose.group.quaternion); }\n",
        )
    monkeypatch.setattr(page, "part", lambda name, part=page.part: wrong if name == f"{file}.js" else part(name))
    assert max(furthest(show(document(run)), run, expected, 37)) > 1e-3 * EXTENT  # a thousand times what is allowed


def test_cubic_between_frames(show: Show) -> None:
    """Halving the distance of the frames makes the error sixteen times smaller."""
    errors: list[float] = []
    # Arrows are as long as the longest at a frame makes them, which is another matter.
    kept = [k for k, kind in enumerate(KINDS) if kind != "arrow"]
    for frames in (26, 51, 101):
        run, expected = scene(frames=frames)
        fine = scene(frames=2 * frames - 1)[1]
        browser = show(document(run))
        worst = 0.0
        for middle in range(frames // 5, frames - 2, frames // 5):
            seen = drawn(browser, 2 * (middle + 0.5) / (frames - 1), len(expected))
            worst = max(worst, *(np.abs(seen[k] - fine[k][2 * middle + 1]).max(initial=0) for k in kept))
        errors.append(worst)
    assert np.log2(errors[0] / errors[1]) > 3.5
    assert np.log2(errors[1] / errors[2]) > 3.5


def one_ball(time: Array, x: Array) -> dict[str, Any]:
    """A ball that moves along x."""
    columns = Columns(time)
    still = columns.add([0.0])[0]
    pose = {"r": [columns.add(x)[0], still, still], "q": columns.add([1.0, 0.0, 0.0, 0.0])}
    run = {
        "name": "ball",
        "stopped": None,
        **columns.document(),
        "poses": [pose],
        "parts": [{"path": "ball", "type": "Body"}],
        "shapes": [{"kind": "sphere", "part": 0, "color": None, "pose": 0, "center": [0, 0, 0], "diameter": 0.1}],
        "plots": [{"name": "x", "unit": "m", "column": pose["r"][0]}],
        "extent": {"low": [-1, -1, -1], "high": [1, 1, 1]},
        "size": 0.1,
        "up": [0, 1, 0],
    }
    return columns.number(run)


def test_no_curve_across_a_jump(show: Show) -> None:
    """At an event a time stands twice: lines on both sides stay straight, and the time itself is after it."""
    time = np.array([0, 0.5, 1, 1, 1.5, 2])
    browser = show(document(one_ball(time, np.where(np.arange(6) < 3, time, 5 - 2 * time))))
    for t in (0.25, 0.75, 0.9999, 1.0, 1.25, 1.9):
        assert drawn(browser, t, 1)[0][0, 0] == pytest.approx(t if t < 1 else 5 - 2 * t, abs=1e-6)


@pytest.mark.parametrize(("time", "x"), [([0.0], [0.3]), ([0.0, 1.0], [0.0, 1.0]), ([0.0, 0.0, 1.0], [0.0, 0.5, 1.0])])
def test_few_frames(show: Show, time: list[float], x: list[float]) -> None:
    browser = show(document(one_ball(np.array(time), np.array(x))))
    for t in (0.0, 0.5, 1.0):
        at = min(t, time[-1])
        expected = x[-1] if len(x) == 1 else x[-2] + at * (x[-1] - x[-2])
        assert drawn(browser, t, 1)[0][0, 0] == pytest.approx(expected, abs=1e-6)


def test_runs_of_different_length(show: Show) -> None:
    """Each run stops at its own last frame, the clock goes on to the last of all."""
    short, long = one_ball(np.array([0, 1.0]), np.array([0, 1.0])), one_ball(np.array([0, 2.0]), np.array([0, 1.0]))
    browser = show(document(short, {**long, "name": "long"}))
    assert browser.run("acausal.seek(9), acausal.time()") == 2
    assert browser.run("[0, 1].map((run) => acausal.positions(0, run)[0][0])") == [1, 1]
    assert browser.run("acausal.seek(1), [0, 1].map((run) => acausal.positions(0, run)[0][0])") == [1, 0.5]


def test_deformation_is_scaled_from_chord_or_root(show: Show) -> None:
    run, expected = scene()
    browser = show(document(run), "#t=0&x=3")
    seen = drawn(browser, 0.4, len(expected))
    index = [k for k, shape in enumerate(run["shapes"]) if shape["kind"] == "curve"]
    for k in index:
        nodes = expected[k][20]
        rest = run["shapes"][k]["rest"]
        s = np.linspace(0, 1, 4)[:, None]
        first = nodes[:1]
        if rest.get("chord"):
            straight = first + s * (nodes[-1:] - first)
        else:
            angle = 3 * 0.4 + np.pi / 2
            straight = first + s * np.array([np.cos(angle), np.sin(angle), 0])
        assert seen[k] == pytest.approx(straight + 3 * (nodes - straight), abs=1e-6 * EXTENT)
        assert np.abs(seen[k] - nodes).max() > 1e-3 * EXTENT
    plain = drawn(show(document(run), "#t=0"), 0.4, len(expected))
    others = [k for k in range(len(expected)) if k not in index and run["shapes"][k]["kind"] != "mesh"]
    assert all((seen[k] == plain[k]).all() for k in others)


def test_modes_of_a_skin_are_scaled(show: Show) -> None:
    run, _ = scene()
    k = KINDS.index("mesh")
    once, thrice = (drawn(show(document(run), f"#x={x}"), 0.74, k + 1)[k] for x in (1, 3))
    still = {**run, "shapes": [*run["shapes"][:k], {**run["shapes"][k], "modes": None, "q": []}]}
    rest = drawn(show(document(still)), 0.74, k + 1)[k]
    assert thrice - rest == pytest.approx(3 * (once - rest), abs=1e-6 * EXTENT)
    assert np.abs(once - rest).max() > 0.01


def test_pose_is_the_matrix_of_the_object(show: Show) -> None:
    """A sphere carries no rotation of its own but its size: the matrix is the pose's."""
    run, expected = scene()
    browser = show(document(run))
    matrix = np.array(browser.run("acausal.seek(0.74), acausal.poses(3)")).reshape(4, 4).T
    assert matrix[:3, 3] == pytest.approx(expected[3][37, 0], abs=1e-6 * EXTENT)
    turn = matrix[:3, :3] / 0.15
    assert turn @ turn.T == pytest.approx(np.eye(3), abs=1e-6)
    assert np.linalg.det(turn) == pytest.approx(1, abs=1e-6)


@pytest.mark.parametrize(("profile", "corners"), [("ellipse", ([1, 0], [0, 1])), ("rectangle", ([1, -1], [1, 1]))])
def test_sections_are_drawn_with_their_half_axes_and_directions(
    show: Show, profile: str, corners: tuple[list[float], ...]
) -> None:
    """Two corners of the ring at each point of a straight strip, tapered and turned about its axis."""
    a, b, turn = np.array([0.5, 0.4, 0.2]), np.array([0.1, 0.2, 0.1]), np.array([0.0, 0.5, 1.2])
    columns = Columns(np.array([0.0, 1.0]))
    curve = {
        "kind": "curve",
        "part": 0,
        "color": None,
        "points": [columns.add([float(k), 0.0, 0.0]) for k in range(3)],
        "tangents": [columns.add([1.0, 0.0, 0.0])] * 3,
        "section": np.stack([a, b], axis=1).tolist(),
        "up": [columns.add([0.0, float(np.sin(angle)), float(np.cos(angle))]) for angle in turn],
        "profile": profile,
        "rest": {"chord": True, "fractions": [0, 0.5, 1]},
        "values": [],
    }
    ball = one_ball(np.array([0.0, 1.0]), np.array([0.0, 1.0]))
    run = {**ball, **columns.document(), "poses": [], "plots": [], "shapes": [curve]}
    browser = show(document(columns.number(run)))
    item = "acausal.viewer.runs[0].items[0]"
    first = np.stack([np.cos(turn), -np.sin(turn)], axis=1)  # up x tangent
    second = np.stack([np.sin(turn), np.cos(turn)], axis=1)
    at = 5 if profile == "ellipse" else 1
    for corner, (c, s) in zip((0, at), corners, strict=True):
        ring = (
            f"(k) => {{ const {{ parts, tube }} = {item}; const i = 3 * (k * parts * tube.around + {corner});"
            " return [1, 2].map((j) => tube.position[i + j] + acausal.viewer.stage.origin[j]); }"
        )
        seen = np.array(browser.run(f"acausal.seek(0), [0, 1, 2].map({ring})"))
        assert seen == pytest.approx((c * a)[:, None] * first + (s * b)[:, None] * second, abs=1e-6)
