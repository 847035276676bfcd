"""TranslationalFlange: connector of one-dimensional translation."""

from __future__ import annotations

from typing import ClassVar

from acausal import Component, Connector, Scalar, flow, port, variable


class TranslationalFlange(Connector):
    """Rod end in one-dimensional translation."""

    domain: ClassVar[str] = "translational"
    s: Scalar = variable("absolute position", unit="m")
    f: Scalar = flow("cut force", unit="N")


class TwoFlanges(Component):
    """Base of components with two flanges."""

    ends = ("flange_a", "flange_b")
    flange_a: TranslationalFlange = port(TranslationalFlange, "first rod end")
    flange_b: TranslationalFlange = port(TranslationalFlange, "second rod end")
