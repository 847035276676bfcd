"""Three balls between two bodies and the world: the same motion wherever the loop is cut, and whichever way a ball is turned."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import acausal as ac
from acausal import Model, chain, connect, guess
from components import Body, FixedTranslation, Spherical, World

ONE, TWO = (0.2, -0.1, 0.7), (-0.5, -0.1, 0.7)
FIRST, SECOND = np.array([0.1, -0.5, -0.3]), np.array([-0.3, -0.2, -0.1])
A = Rotation.from_euler("XYZ", ONE)
B = A * Rotation.from_euler("XYZ", TWO)
END = A.apply(FIRST) + B.apply(SECOND)


def angles(rotation: Rotation) -> tuple[float, ...]:
    return tuple(rotation.as_euler("XYZ").tolist())


def triangle(left: int, right: int, turned: bool) -> Model:
    """With so many rods of no length at either end, which move the cut, and the middle ball turned round."""
    ends = {f"left{k}": FixedTranslation(r=(0, 0, 0)) for k in range(left)}
    others = {f"right{k}": FixedTranslation(r=(0, 0, 0)) for k in range(right)}
    middle = angles((A.inv() * B).inv()) if turned else TWO
    parts: dict[str, Any] = {
        "world": World(),
        **ends,
        **others,
        "s1": Spherical(angles_start=ONE, w_rel=guess((0.5, 0, 0))),
        "s2": Spherical(angles_start=middle),
        "s3": Spherical(angles_start=angles(B)),
        "b1": Body(m=1.0, I=np.diag([0.3, 0.4, 0.35])),
        "b2": Body(m=1.5, I=np.diag([0.3, 0.4, 0.35])),
        "t1": FixedTranslation(r=tuple(FIRST)),
        "t2": FixedTranslation(r=tuple(SECOND)),
        "t3": FixedTranslation(r=tuple(END)),
    }

    def connections(self):
        yield chain(self.world, *[getattr(self, name) for name in ends], self.s1, self.b1)
        near, far = (self.s2.frame_b, self.s2.frame_a) if turned else (self.s2.frame_a, self.s2.frame_b)
        yield chain(self.b1.frame_a, self.t1, near)
        yield connect(far, self.b2.frame_a)
        yield chain(self.b2.frame_a, self.t2, self.s3.frame_b)
        yield chain(self.world, *[getattr(self, name) for name in others], self.t3, self.s3.frame_a)

    return type("Triangle", (Model,), {**parts, "connections": connections})()


@pytest.mark.parametrize("turned", [False, pytest.param(True, marks=pytest.mark.slow)])
@pytest.mark.parametrize(("left", "right"), [(4, 0), (2, 0), (1, 0), (0, 0), (0, 1), (0, 3)])
def test_the_motion_does_not_depend_on_the_cut(left: int, right: int, turned: bool) -> None:
    found, known = (
        ac.simulate(model, stop_time=1.0, intervals=20, initial="guesses", tolerance=1e-8, energy=True)
        for model in (triangle(left, right, turned), triangle(0, 0, False))
    )
    np.testing.assert_allclose(found["b2.r_0"], known["b2.r_0"], atol=1e-6)
    np.testing.assert_allclose(
        np.linalg.norm(found["b1.frame_a.r_0"] - found["b2.r_0"], axis=1), np.linalg.norm(FIRST), atol=1e-7
    )
