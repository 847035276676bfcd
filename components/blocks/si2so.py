"""SI2SO: base of blocks with two inputs and one output."""

from __future__ import annotations

from acausal import Component, Scalar, input, output


class SI2SO(Component):
    """Base of blocks with two inputs and one output."""

    u1: Scalar = input("first input")
    u2: Scalar = input("second input")
    y: Scalar = output("output")
