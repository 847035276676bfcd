"""SISO: base of blocks with one input and one output."""

from __future__ import annotations

from acausal import Component, Scalar, input, output


class SISO(Component):
    """Base of blocks with one input and one output."""

    u: Scalar = input("input")
    y: Scalar = output("output")
