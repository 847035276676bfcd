"""Documents hold what the results hold."""

from __future__ import annotations

import json
import pickle
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import acausal as ac
from acausal import Component, Model, Scalar, chain, fixed, geometry, output, parameter, sqrt, variable
from acausal.animation.document import document
from acausal.result.animated import AnimationOptions, run_of
from components import Body, FlexibleBeam, Revolute, World
from components.frame import Frame, TwoFrames, pose
from models import SCENES
from tests.acausal.animation.places import unpacked
from tests.shared import compiled


def made(result: Any, values: tuple[str, ...] = (), **asked: Any) -> dict[str, Any]:
    """Return a run of a document as a page would read it: through JSON without NaN."""
    found = document({"run": run_of(result, AnimationOptions(**asked))}, values)
    return json.loads(json.dumps(found, allow_nan=False))["runs"][0]


def columns(run: dict[str, Any]) -> np.ndarray:
    """All columns, shape (columns, frames)."""
    n, varying = run["frames"], run["varying"]
    data = unpacked(run["data"])
    assert len(data) == n * varying + run["constant"]
    constants = np.repeat(data[n * varying :, None], n, axis=1)
    values = np.concatenate([data[: n * varying].reshape(varying, n), constants]).astype(float)
    for k, offset in run["offsets"].items():
        values[int(k)] += offset
    return values


def numbers(thing: Any) -> list[int]:
    """The numbers of columns in places where only these stand."""
    if isinstance(thing, list):
        return [n for inner in thing for n in numbers(inner)]
    return [thing] if isinstance(thing, int) else []


@pytest.mark.parametrize("name", SCENES)
def test_documents_of_all_scenes(name: str) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ac.AcausalWarning)  # of the physics
        result = ac.simulate(compiled(SCENES[name]), stop_time=SCENES[name].stop_time / 8, intervals=40, tolerance=1e-4)
        run = made(result, ("all",))
    values = columns(run)
    assert unpacked(run["time"], "<f8").tolist() == result.time.tolist()
    used = numbers([[p["r"], p["q"]] for p in run["poses"]])
    for shape in run["shapes"]:
        used += numbers([shape.get(key) for key in ("points", "tangents", "a", "b", "at", "vector", "q", "up")])
        used += numbers([value["columns"] for value in shape.get("values", [])])
    used += [plot["column"] for plot in run["plots"]]
    # No column is missing, and none is there for nothing.
    assert sorted(set(used)) == list(range(len(values)))
    assert len({row.tobytes() for row in values}) == len(values)
    assert np.isfinite(values).all()
    low, high = (np.array(run["extent"][end]) for end in ("low", "high"))
    assert 0 < run["size"] <= np.linalg.norm(high - low) * (1 + 1e-6)
    for plot, series in zip(run["plots"], result.series(), strict=True):
        assert (plot["name"], plot["unit"]) == (series.name, series.unit)
        assert values[plot["column"]] == pytest.approx(series.values, rel=1e-6, abs=1e-30)
    for one in run["poses"]:
        assert np.linalg.norm(values[one["q"]], axis=0) == pytest.approx(1, abs=1e-6)


class Rocker(TwoFrames):
    """A user's own part: it says nothing of its looks."""

    def connections(self):
        yield ac.branch(self.frame_a, self.frame_b)

    def equations(self):
        from components.frame import move
        from components.orientation import null_rotation

        yield from move(self.frame_a, self.frame_b, np.array([0.3, 0.1, 0.2]), null_rotation())
        yield self.frame_a.f == -self.frame_b.f
        yield self.frame_a.t == -self.frame_b.t - ac.cross(ac.as_expr([0.3, 0.1, 0.2]), self.frame_b.f)


class Ball(Body):
    """A user's own looks, beside those of its class."""

    radius: Scalar = parameter("radius", unit="m", default=0.05)

    def shapes(self):
        yield from super().shapes()
        yield geometry.Sphere(pose(self.frame_a), diameter=2 * self.radius)
        yield geometry.Box(pose(self.frame_a), (self.radius, 0, 0), (0.1, 0.2, self.radius))


class Machine(Model):
    """A spatial pendulum with a part of the user's own, which turns more than once."""

    world = World()
    hinge = Revolute(n=(1, 2, 3), phi=fixed(0), w=fixed(9))
    rocker, ball = Rocker(), Ball(m=1, r_CM=(0.1, 0, 0), I=np.diag((0.1, 0.2, 0.3)))
    phi: Scalar = output("angle", unit="rad")

    def connections(self):
        yield chain(self.world, self.hinge, self.rocker, self.ball)

    def equations(self):
        yield self.phi == self.hinge.phi


@pytest.fixture(scope="module")
def machine() -> ac.Result:
    return ac.simulate(Machine(), stop_time=2, intervals=200)


def kinds(run: dict[str, Any], path: str) -> list[str]:
    return [s["kind"] for s in run["shapes"] if run["parts"][s["part"]]["path"] == path]


def test_poses_are_those_of_the_frames(machine: ac.Result) -> None:
    run = made(machine)
    values = columns(run)
    (box,) = (s for s in run["shapes"] if s["kind"] == "box")
    place = run["poses"][box["pose"]]
    w, x, y, z = values[place["q"]]
    to_world = Rotation.from_quat(np.stack([x, y, z, w], axis=1)).as_matrix()
    T = machine["ball.frame_a.R.T"]
    assert to_world.transpose(0, 2, 1) == pytest.approx(T, abs=1e-6)
    assert np.max(np.abs(to_world - T)) > 0.5  # a transposed one would be seen
    assert np.max(np.abs(np.diff(values[place["q"]], axis=1))) < 0.1
    assert pytest.approx(machine["ball.frame_a.r_0"], abs=1e-7) == values[place["r"]].T


def test_own_parts_and_own_looks(machine: ac.Result) -> None:
    run = made(machine)
    values = columns(run)
    assert kinds(run, "rocker") == ["span"]
    (rod,) = (s for s in run["shapes"] if run["parts"][s["part"]]["path"] == "rocker")
    assert pytest.approx(machine["rocker.frame_b.r_0"], abs=1e-7) == values[rod["b"]].T
    assert kinds(run, "ball")[-2:] == ["sphere", "box"]
    assert len(kinds(run, "ball")) > 2
    sphere = next(s for s in reversed(run["shapes"]) if s["kind"] == "sphere")
    assert (sphere["diameter"], sphere["center"]) == (0.1, [0, 0, 0])
    assert next(s for s in run["shapes"] if s["kind"] == "box")["size"] == [0.1, 0.2, 0.05]
    assert {p["path"]: p["type"] for p in run["parts"]}["ball"] == "Ball"


def test_only_some_times_are_evaluated_of_long_results() -> None:
    result = ac.simulate(compiled(Machine), stop_time=20, intervals=20_000)
    before = result.stats.consistent_evaluations
    run = made(result, frames=501)
    assert run["frames"] == 501
    assert result.stats.consistent_evaluations - before <= 20 * 501
    time = unpacked(run["time"], "<f8")
    assert time[-1] == 20
    rows = np.searchsorted(result.time, time)
    box = next(s for s in run["shapes"] if s["kind"] == "box")
    r = columns(run)[run["poses"][box["pose"]]["r"]].T
    assert r == pytest.approx(result["ball.frame_a.r_0"][rows], abs=1e-7)
    # What was read before makes no difference.
    assert made(result, frames=501)["data"] == run["data"]


def test_fast_turns_are_told() -> None:
    result = ac.simulate(compiled(Machine), stop_time=2, intervals=20)
    with pytest.warns(ac.AcausalWarning, match=r"turns by up to 0\.\d+ rad from one frame to the next"):
        made(result)


class Bar(Model):
    """A beam of one element."""

    world = World()
    beam = FlexibleBeam(length=0.4, E=1e11, rho=5540, A=18e-4, J=1.215e-8, elements=1)

    def connections(self):
        yield chain(self.world, self.beam)


def test_values_along_beams_are_written_if_asked_for(machine: ac.Result) -> None:
    result = ac.simulate(compiled(Bar), stop_time=0.1, intervals=50)
    curve = next(s for s in made(result)["shapes"] if s["kind"] == "curve")
    assert [value["name"] for value in curve["values"]] == ["deflection"]
    run = made(result, ("bending moment",))
    curve = next(s for s in run["shapes"] if s["kind"] == "curve")
    assert {value["name"]: value["unit"] for value in curve["values"]} == {"deflection": "m", "bending moment": "N.m"}
    moment = next(value for value in curve["values"] if value["name"] == "bending moment")
    assert pytest.approx(result["beam.node_moment"][:, :, 2], rel=1e-6, abs=1e-6) == columns(run)[moment["columns"]].T
    assert columns(run)[np.array(curve["points"])].shape == (2, 3, 51)
    # Values that are 0 everywhere are left out, unless they are asked for by name.
    for asked, more in ((("all",), set()), (("all", "torque"), {"torque"})):
        curve = next(s for s in made(result, asked)["shapes"] if s["kind"] == "curve")
        assert {value["name"] for value in curve["values"]} - {"axial force"} == {"bending moment", "deflection"} | more
    # Of several runs, one may have no beams.
    both = document({"bar": run_of(result), "machine": run_of(machine)}, ["bending moment"])
    assert both["start"] == "colour=bending+moment"
    assert sum(len(s.get("values", ())) for run in both["runs"] for s in run["shapes"]) == 2
    with pytest.raises(
        ac.DeclarationError,
        match=r'has values "stress".*"axial force", "bending moment", "bending moment y", "deflection"',
    ):
        made(result, ("stress",))


class Shapes(Model):
    """Shows what it is given."""

    x: Scalar = variable("coordinate", unit="m", start=1.0)

    def equations(self):
        yield ac.der(self.x) == -1.0

    def shapes(self):
        yield geometry.Span((0, 0, 0), (1, 0, 0))


def shows(*shapes: Any) -> ac.Result:
    class Own(Shapes):
        def shapes(self):
            for shape in shapes:
                yield shape(self) if callable(shape) else shape

    return ac.simulate(Own(x=fixed(1.05)), stop_time=2, intervals=20)


STILL = geometry.Pose((0, 0, 0), np.eye(3))


@pytest.mark.parametrize(
    ("shape", "said"),
    [
        (
            geometry.Sphere(STILL, center=(0, 0)),
            r"`center` of the Sphere of the model \(Own\) has shape \(2,\).* \(3,\)",
        ),
        (geometry.Curve(points=((0, 0), (1, 0))), r"`points` of the Curve .* needs \(n, 3\)"),
        (geometry.Span("a", (0, 0, 0)), r"`start` of the Span of the model"),
        (lambda m: geometry.Sphere(STILL, diameter=m.x), r"`diameter` of the Sphere .* varies with time"),
        (
            geometry.Sphere(geometry.Pose((0, 0, 0), 2 * np.eye(3))),
            "T of a Pose of the model .* is not a rotation matrix",
        ),
        (3, r"shapes\(\) of model \(Own\) yields 3"),
        (geometry.Curve(((0, 0, 0), (1, 0, 0)), rest=STILL), "needs one entry of `rest_points`"),
        (
            geometry.Curve(((0, 0, 0), (1, 0, 0)), up=(0, 1)),
            r"`up` of the Curve .* has shape \(2,\); it needs \(3,\) or \(n, 3\)",
        ),
        (
            geometry.Curve(((0, 0, 0), (1, 0, 0)), section=[(1, 1)] * 3),
            "`section` of the Curve .* has 3 entries for 2 points",
        ),
        (geometry.Curve(((0, 0, 0), (1, 0, 0)), up=np.eye(3)), "`up` of the Curve .* has 3 entries for 2 points"),
        (geometry.Curve(((0, 0, 0), (1, 0, 0)), profile="round"), "`profile` of the Curve .* is 'round'"),  # type: ignore
    ],
)
def test_shapes_that_are_none_are_refused(shape: Any, said: str) -> None:
    with pytest.raises(ac.DeclarationError, match=said):
        made(shows(shape))


def test_open_sizes_suit_the_scene() -> None:
    for scale in (1e-3, 1.0, 1e6):
        run = made(
            shows(
                geometry.Span((0, 0, 0), (scale, 0, 0)),
                geometry.Axle(STILL, (0, 0, 2)),
                geometry.Curve(((0, 0, 0), (scale, 0, 0)), section=(None, 0.1 * scale)),
                geometry.Curve(((0, 0, 0), (scale, 0, 0), (3 * scale, 0, 0))),
            )
        )
        rod, axle, bar, smooth = run["shapes"]
        assert run["size"] == pytest.approx(3 * scale)
        assert 0 < rod["diameter"] < axle["diameter"] < axle["length"] < 0.4 * scale
        assert axle["axis"] == [0, 0, 1]
        assert bar["section"] == [pytest.approx([0.1 * scale] * 2)]
        tangents = columns(run)[np.array(smooth["tangents"])][:, :, 0]
        assert tangents == pytest.approx(scale * np.array([[0.5, 0, 0], [1.5, 0, 0], [2.5, 0, 0]]), rel=1e-6)
        assert smooth["rest"] == {"chord": True, "fractions": pytest.approx([0, 1 / 3, 1])}


def test_a_size_of_its_own_wherever_a_body_goes() -> None:
    """A body that flies away does not make the others small: what counts is the median over time."""
    run = made(
        shows(
            lambda m: geometry.Span((0, 0, 0), (1, 0, 0)),
            lambda m: geometry.Sphere(geometry.Pose((m.x * 0 + 1, 0, 0), np.eye(3))),
        )
    )
    assert run["size"] == pytest.approx(1)


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e7])
def test_a_body_alone_is_seen_beside_its_path(scale: float) -> None:
    result = shows(lambda m: geometry.Sphere(geometry.Pose((scale * m.x, 0, 0), np.eye(3))))
    run = made(result)
    path = run["extent"]["high"][0] - run["extent"]["low"][0]
    assert path == pytest.approx(2 * scale)
    assert 0.002 * path < run["shapes"][0]["diameter"] < 0.05 * path


def test_values_that_are_no_numbers_are_bridged_and_told() -> None:
    result = shows(lambda m: geometry.Span((0, 0, 0), (1, sqrt(m.x), 0)))
    with pytest.warns(
        ac.AcausalWarning,
        match=r"Span of the model \(Own\) is not a finite number at 10 of 21 frames, the first at t = 1\.1 s",
    ):
        run = made(result)
    values = columns(run)
    assert np.isfinite(values).all()
    end = values[run["shapes"][0]["b"][1]]
    assert end[:11] == pytest.approx(np.sqrt(1.05 - np.linspace(0, 1, 11)), abs=1e-3)
    assert end[11:] == pytest.approx(end[10])
    result = shows(
        geometry.Span((0, 0, 0), (1, 0, 0)),
        lambda m: geometry.Sphere(geometry.Pose((sqrt(-1 - m.x * 0), 0, 0), np.eye(3))),
    )
    with pytest.warns(ac.AcausalWarning, match=r"the Sphere of the model \(Own\) is not drawn"):
        assert [s["kind"] for s in made(result)["shapes"]] == ["span"]


class Silent(Model):
    """Nothing of it can be seen."""

    x: Scalar = variable("coordinate", unit="m", start=1.0)
    world = World()

    def equations(self):
        yield ac.der(self.x) == -1.0


def test_nothing_to_be_seen() -> None:
    result = ac.simulate(Silent(x=fixed(1)), stop_time=1, intervals=10)
    with pytest.raises(ac.DeclarationError, match=r"Silent cannot be animated.*shapes\(\)"):
        made(result)
    assert "<iframe" not in result._repr_html_()


def test_part_is_shown_once_however_many_yield_it() -> None:
    class Twice(Shapes):
        class Arm(Component):
            frame_b: Frame = ac.port(Frame, "a frame")

        world, body = World(), Body(m=1)

        def connections(self):
            yield chain(self.world, self.body)

        def shapes(self):
            yield from (self.body, self.body)
            yield from super().shapes()

    run = made(ac.simulate(Twice(x=fixed(1)), stop_time=1, intervals=10))
    assert len(kinds(run, "body")) == len(set(map(str, [s for s in run["shapes"] if s["part"] == 0])))


@pytest.mark.parametrize(
    ("path", "said"),
    [
        ("no/where/run.html", "no directory"),
        ("run.txt", "ends in .html"),
        ("run", "ends in .html"),
        ("", "empty"),
        ("..", "ends in .html"),
    ],
)
def test_files_are_refused_before_any_work(
    machine: ac.Result, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, path: str, said: str
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("acausal.result.animated.run_of", lambda *_: pytest.fail("work was done"))
    with pytest.raises(ac.ExportError, match=said):
        machine.animate(path)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    "asked",
    [
        {"frames": 1},
        {"frames": 2.5},
        {"values": "all"},
        {"plots": "phi"},
        {"title": 3},
        {"deformation": 0.5},
        {"deformation": 2000},
        {"deformation": "10"},
    ],
)
def test_arguments_are_refused(machine: ac.Result, tmp_path: Path, asked: dict[str, Any]) -> None:
    with pytest.raises(ac.DeclarationError, match=next(iter(asked))):
        machine.animate(tmp_path / "run.html", **asked)


def test_results_without_a_model_or_time(machine: ac.Result, tmp_path: Path) -> None:
    loaded = pickle.loads(pickle.dumps(machine))
    arrays = ac.result_of([0.0, 1.0], {"x": ([0, 1], "m")})
    for result in (loaded, arrays):
        with pytest.raises(ac.DeclarationError, match="has no model"):
            result.animate(tmp_path / "run.html")
        assert "<iframe" not in result._repr_html_()
    empty = ac.Result(np.empty(0), machine._evaluate, machine.tree, machine.outputs, machine.stats)
    with pytest.raises(ac.DeclarationError, match="is empty"):
        empty.animate(tmp_path / "run.html")
    assert not list(tmp_path.iterdir())


class Stops(Shapes):
    """It cannot go beyond the time 1."""

    def equations(self):
        yield ac.der(self.x) == ac.quantity(-0.5, "m2/s") / self.x

    def shapes(self):
        yield geometry.Span((0, 0, 0), (self.x, 1, 0))


def test_failed_runs_show_what_was_computed(tmp_path: Path) -> None:
    with pytest.raises(ac.SimulationError) as failed:
        ac.simulate(Stops(x=fixed(1)), stop_time=2, intervals=20)
    result: Any = failed.value.result
    run = made(result)
    assert 2 <= run["frames"] <= 11
    assert run["stopped"] == result.stats.stopped
    assert "t = " in run["stopped"]
    result.animate(tmp_path / "run.html")
    assert "stopped" not in ac.simulate(Stops(x=fixed(1)), stop_time=0.5).stats


def test_pictures_leave_no_values_behind(tmp_path: Path) -> None:
    result = ac.simulate(compiled(Machine), stop_time=1, intervals=100)
    before = pickle.dumps(result)
    result = ac.simulate(compiled(Machine), stop_time=1, intervals=100)
    result.animate(tmp_path / "run.html")
    first = (tmp_path / "run.html").read_bytes()
    assert list(result._arrays) == ["time"]
    loaded, other = pickle.loads(pickle.dumps(result)), pickle.loads(before)
    assert all(np.array_equal(loaded[name], other[name], equal_nan=True) for name in other)
    result.animate(tmp_path / "run.html")
    assert (tmp_path / "run.html").read_bytes() == first


def test_several_runs_have_one_size(tmp_path: Path, machine: ac.Result) -> None:
    other = ac.simulate(compiled(Machine), stop_time=1, intervals=100, parameters={"ball.m": 2})
    found = document({"a": run_of(machine), "b": run_of(other)}, title="both")
    assert [run["name"] for run in found["runs"]] == ["a", "b"]
    assert (found["title"], found["start"]) == ("both", "")
    assert document({"a": run_of(machine), "b": run_of(other)})["title"] == "Machine"
    assert document({"a": run_of(machine)}, deformation=10.0)["start"] == "x=10"
    assert found["runs"][0]["size"] == found["runs"][1]["size"]
    ac.animate({"a": machine, "b": other}, tmp_path / "both.html", title="</script><b>")
    text = (tmp_path / "both.html").read_text()
    assert "</script><b>" not in text
    for wrong in (machine, [machine], {}, {"a": 1}):
        with pytest.raises(ac.DeclarationError, match="dictionary"):
            ac.animate(wrong, tmp_path / "wrong.html")  # type: ignore[arg-type]


def test_plots_are_what_is_asked_for(machine: ac.Result) -> None:
    run = made(machine, plots=["hinge.w", "ball.frame_a.r_0"])
    names = [plot["name"] for plot in run["plots"]]
    assert names == ["hinge.w", *(f"ball.frame_a.r_0[{k}]" for k in range(3))]
    assert columns(run)[run["plots"][2]["column"]] == pytest.approx(machine["ball.frame_a.r_0[1]"], abs=1e-7)
    with pytest.raises(ac.DeclarationError, match=r"hinge\.speed"):
        made(machine, plots=["hinge.speed"])
