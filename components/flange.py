"""Flange: connector of one-dimensional rotation."""

from __future__ import annotations

from typing import ClassVar

from acausal import Component, Connector, Scalar, flow, port, variable


class Flange(Connector):
    """Shaft end in one-dimensional rotation."""

    domain: ClassVar[str] = "rotational"
    phi: Scalar = variable("absolute angle", unit="rad")
    tau: Scalar = flow("cut torque", unit="N.m")


class TwoFlanges(Component):
    """Base of components with two flanges."""

    ends = ("flange_a", "flange_b")
    flange_a: Flange = port(Flange, "first shaft end")
    flange_b: Flange = port(Flange, "second shaft end")
