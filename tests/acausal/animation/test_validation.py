"""Shapes that cannot be drawn raise an error before a page is written."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import DeclarationError, Model, Scalar, der, geometry, variable
from acausal.animation.document import document
from acausal.result.animated import run_of
from tests.shared import compiled

UNIT = ((1, 0, 0), (0, 1, 0), (0, 0, 1))
CORNERS = ((0, 0, 0), (1, 0, 0), (0, 1, 0))
FACE = ((0, 1, 2),)


class Slides(Model):
    x: Scalar = variable("place", start=1, fixed=True)

    def equations(self):
        yield der(self.x) == -self.x


def drawn(monkeypatch: pytest.MonkeyPatch, make: Callable[[Any, Any], Any]) -> dict[str, Any]:
    """Return the run of a model that looks like what is made from its place and its pose."""

    def shapes(self: Any) -> Any:
        yield make((self.x, 0, 0), geometry.Pose((self.x, 0, 0), UNIT))

    monkeypatch.setattr(Slides, "shapes", shapes)
    return document({"": run_of(ac.simulate(compiled(Slides), stop_time=1, intervals=4))})["runs"][0]


@pytest.mark.parametrize(
    ("make", "says"),
    [
        (lambda r, at: geometry.Sphere(at, diameter=-1), "`diameter` of the Sphere of the model (Slides) is negative"),
        (lambda r, at: geometry.Sphere(at, center=(np.nan, 0, 0)), "not a finite number"),
        (lambda r, at: geometry.Box(at, (0, 0, 0), (1, -1, 1)), "`size` of the Box"),
        (
            lambda r, at: geometry.Box(at, (0, 0, 0), (1, 1, 1), ((1, 0, 0), (1, 0, 0), (0, 0, 1))),
            "orthogonal unit vectors",
        ),
        (lambda r, at: geometry.Axle(at, (0, 0, 0)), "`axis` of the Axle of the model (Slides) is zero"),
        (lambda r, at: geometry.Span((0, 0, 0), r, style="zigzag"), "'rod', 'rail', 'coil', 'damper', 'rope'"),
        (lambda r, at: geometry.Axle(at, (0, 0, 1), style="cube"), "not one of 'hinge', 'pin', 'ball'"),
        (lambda r, at: geometry.Rail(at, (0, 0, 0), r), "`axis` of the Rail of the model (Slides) is zero"),
        (lambda r, at: geometry.Arrow(r, r, "speed"), "'force', 'torque'"),
        (lambda r, at: geometry.Curve([r]), "needs at least two points"),
        (lambda r, at: geometry.Mesh(at, CORNERS, ((0, 1, 3),)), "outside 0 to 2"),
        (lambda r, at: geometry.Mesh(at, CORNERS, ((0, 1, -1),)), "outside 0 to 2"),
        (lambda r, at: geometry.Mesh(at, CORNERS, FACE, q=(r[0],)), "both be given"),
        (lambda r, at: geometry.Mesh(at, CORNERS, FACE, modes=np.ones((2, 3, 3)), q=(r[0],)), "(1, 3, 3)"),
    ],
)
def test_shapes_that_cannot_be_drawn(monkeypatch: pytest.MonkeyPatch, make: Any, says: str) -> None:
    with pytest.raises(DeclarationError) as refused:
        drawn(monkeypatch, make)
    assert says in str(refused.value)


@pytest.mark.parametrize(
    "make",
    [
        lambda r, at: geometry.Sphere(at, diameter=0),
        lambda r, at: geometry.Span(r, r),
        lambda r, at: geometry.Curve([(0, 0, 0), r]),
        lambda r, at: geometry.Mesh(at, CORNERS, FACE),
        lambda r, at: geometry.Mesh(at, CORNERS, FACE, modes=np.ones((1, 3, 3)), q=(r[0],)),
    ],
)
def test_small_shapes_are_drawn(monkeypatch: pytest.MonkeyPatch, make: Any) -> None:
    assert len(drawn(monkeypatch, make)["shapes"]) == 1
