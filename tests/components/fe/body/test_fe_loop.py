"""FE bodies in closed loops and welded in a row."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

import acausal as ac
from acausal import AcausalWarning, InitializationError, Model, chain, fixed, guess
from components import Body, BodyShape, Fixed, Prismatic, Revolute, World
from components.fe import FEBody, ReducedBody, box, reduce_body, rigid

STEEL = {"E": 2.1e11, "nu": 0.3, "rho": 7850.0}


def rod_of(angle: float, about: int) -> ReducedBody:
    """A rod whose line leaves the plane of the loop by an angle (about y), or whose end is turned about itself (x)."""
    M, K, nodes = box((0.2, 0.02, 0.02), (4, 1, 1), "hex20", **STEEL)
    x = np.asarray(nodes) - [0, 0.01, 0.01]
    at = [np.flatnonzero(np.isclose(x[:, 0], end)) for end in (0.0, 0.2)]
    c, s = np.cos(angle), np.sin(angle)
    T = np.array([[1, 0, 0], [0, c, -s], [0, s, c]]) if about == 0 else np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
    Q = np.kron(np.eye(len(x)), T)
    frames = {"frame_a": at[0], "frame_b": at[1]}
    return reduce_body(Q @ M @ Q.T, Q @ K @ Q.T, x @ T.T, frames=frames, hold="frame_a", basis="craig-bampton", modes=8)


class SliderCrank(Model):
    angle: float = ac.structural("how far the rod is out of the plane, in rad", default=0.0, cls=float)
    start: str = ac.structural("initial state of the rod", default="undeformed", cls=str)
    world, crank_joint, crank = (
        World(),
        Revolute(phi=fixed(0), w=fixed(10)),
        BodyShape(r=(0.05, 0, 0), m=1, I=np.eye(3)),
    )
    pin, wrist = Revolute(phi=guess(0)), Revolute(phi=guess(0))
    guide, piston = Prismatic(s=guess(0.25)), Body(m=0.5)

    @ac.part
    def rod(self):
        return FEBody(reduced=rod_of(self.angle, 1), initial=self.start)

    def connections(self):
        yield chain(self.world, self.crank_joint, self.crank, self.pin, self.rod.frame_a)
        yield chain(self.rod.frame_b, self.wrist, self.piston.frame_a)
        yield chain(self.world, self.guide, self.piston)


@pytest.mark.parametrize("start", ["undeformed", "static"])
@pytest.mark.parametrize("angle", [7.5e-6, -1e-4])
def test_a_rod_takes_up_what_leaves_the_plane(start: str, angle: float) -> None:
    """Its end is bent back into the plane, by as much as it is out of it, and nothing else is."""
    result = ac.simulate(SliderCrank(angle=angle, start=start), stop_time=1e-3, tolerance=1e-6, energy=True)
    assert np.abs(result["rod.frame_b.r_0"][:, 2]).max() < 1e-10
    body, q = rod_of(angle, 1), result["rod.q"][0]
    end = body.interfaces[1]
    assert end.place[2] + end.displacement[2] @ q == pytest.approx(0, abs=1e-9 * abs(angle))
    assert np.linalg.norm(end.displacement[:2] @ q) < 2e-6
    assert np.abs(q).max() < 0.2 * abs(angle) + 1e-6
    if start == "static":
        assert np.abs(result["rod.qdd"][0]).max() < 1e-10
    assert result["crank_joint.phi"][0] == pytest.approx(0, abs=1e-15)
    assert abs(result.stats["energy_method"]) < 1e-5


def test_an_exact_rod_stays_undeformed() -> None:
    result = ac.simulate(SliderCrank(), stop_time=1e-5)
    assert not result["rod.q"][0].any()


def test_what_a_rod_does_not_take_up() -> None:
    """4 mm out of the plane: the message has the remedy, and that runs."""
    with pytest.raises(InitializationError) as caught:
        ac.simulate(SliderCrank(angle=2e-2), stop_time=1e-5)
    text = str(caught.value)
    assert "miss each other by 0.004 m" in text
    assert "rod.q" not in text
    assert text.endswith(
        'Or let the loops determine their shape: `rod`: FEBody(initial="free"), with simulate(..., initial="guesses").'
    )
    found = ac.simulate(SliderCrank(angle=2e-2, start="free"), stop_time=1e-5, initial="guesses")
    assert abs(found["rod.frame_b.r_0"][0, 2]) < 1e-9


def test_speeds_that_contradict_each_other_are_no_deformation() -> None:
    class Both(SliderCrank):
        guide = Prismatic(s=guess(0.25), v=fixed(0.3))

    with pytest.raises(InitializationError, match=r"move apart at 0\.3"):
        ac.simulate(Both(angle=7.5e-6), stop_time=1e-5)


def piece(count: int, stiff: bool) -> ReducedBody:
    """One of some equal pieces of a bar of 1 m."""
    M, K, nodes = box((1 / count, 0.05, 0.05), (4 // count, 1, 1), "hex20", E=2.1e11, nu=0.0, rho=7850)
    x = np.asarray(nodes)[:, 0]
    ends = [np.flatnonzero(np.isclose(x, end)) for end in (0.0, 1 / count)]
    frames = {"frame_a": ends[0], "frame_b": rigid(ends[1]) if stiff else ends[1]}
    return reduce_body(M, K, nodes, frames=frames, hold="frame_a", basis="craig-bampton", modes=12)


class Row(Model):
    """A bar in pieces that are welded to one another, clamped at one end."""

    count: int = ac.structural("pieces", default=1, cls=int)
    stiff: bool = ac.structural("whether ends are rigid", default=False, cls=bool)
    world, ground = World(), Fixed()

    @ac.parts
    def bars(self):
        return [FEBody(reduced=piece(self.count, self.stiff), initial="static") for _ in range(self.count)]

    def connections(self):
        yield chain(self.ground, *self.bars)


def first_bending(**given) -> float:
    """(beta l)^2 of the lowest frequency: 3.516 of a thin clamped beam."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        found = np.abs(np.linalg.eigvals(ac.linearize(Row(**given)).A).imag)
    return float(found[found > 1].min() / np.sqrt(2.1e11 * 0.05**2 / 12 / 7850))


def test_rigid_ends_do_not_soften_a_row() -> None:
    whole, soft, stiff = first_bending(), first_bending(count=4), first_bending(count=4, stiff=True)
    assert whole == pytest.approx(3.516, rel=1e-2)  # four elements
    assert soft < 0.985 * whole
    assert stiff == pytest.approx(whole, rel=1e-3)


@pytest.mark.parametrize("stiff", [False, True])
def test_welds_of_averages_warn(stiff: bool) -> None:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", AcausalWarning)
        ac.simulate(Row(count=2, stiff=stiff), stop_time=1e-3)
    texts = [str(entry.message) for entry in caught if "welded" in str(entry.message)]
    assert len(texts) == (0 if stiff else 1)
    if texts:
        assert texts[0].startswith("bars[0] (FEBody)")
        assert 'Do this: reduce_body(frames={"frame_b": rigid(nodes)}) for both bodies' in texts[0]
