"""Sampled: a Python function that acts at equidistant instants."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import Component, Scalar, call, discrete, input, output, parameter, structural
from components.blocks.periodic_block import at_instants, first


class Sampled(Component):
    """Python function y = f(time, u) that acts at equidistant instants, with its results held in between.

    At an instant the function reads the values just before it. Where its inputs follow from outputs of other functions that
    act then, these act first; in a cycle, the one that is declared first does. The instants are offset + k period, with
    k = 0, 1, ..., from the start of the run on.

    One input or output is a number, several are an array. What f keeps lives in its object: each run takes a copy and calls
    its method `reset()`, if it has one.
    """

    f: Any = structural("function of the time in s and the inputs", choices=[callable])
    period: Scalar = parameter("sample period", unit="s", default=0.1, positive=True)
    offset: Scalar = parameter("first instant", unit="s", default=0)
    inputs: int = structural("number of inputs", default=1, cls=int, minimum=0)
    outputs: int = structural("number of outputs", default=1, cls=int, minimum=1)
    delay: int = structural("periods by which outputs are late", default=0, choices=[0, 1])
    y_start: Any = parameter(
        "outputs before the first instant", shape=lambda s: shape_of(s.outputs), default=lambda s: zeros_of(s)
    )
    u: Any = input("inputs", shape=lambda s: shape_of(s.inputs))
    y: Any = output("outputs", shape=lambda s: shape_of(s.outputs))
    held: Any = discrete("outputs", shape=lambda s: shape_of(s.outputs), start=y_start)
    result: Any = discrete("last results", shape=lambda s: shape_of(s.outputs), start=y_start)
    next: Scalar = discrete("next instant", unit="s", start=first(offset, period))

    def equations(self):
        act = call(self.f, [self.u], [self.result], [self.held if self.delay else self.result])
        yield at_instants(self.next, self.period, act)
        yield self.y == (self.held if self.delay else self.result)


def zeros_of(block: Sampled) -> Any:
    """Return outputs of 0."""
    return np.zeros(shape_of(block.outputs))[()]


def shape_of(count: int) -> tuple[int, ...]:
    """Return the shape of some signals."""
    return () if count == 1 else (count,)
