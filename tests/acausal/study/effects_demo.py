"""Small models whose effects change what closed forms tell, and an executor whose times are numbers of operations."""

from __future__ import annotations

from concurrent.futures import Executor, Future
from dataclasses import replace
from typing import Any

from acausal import (
    Component,
    DeclarationError,
    Model,
    Scalar,
    der,
    effect,
    exp,
    output,
    parameter,
    part,
    sqrt,
    time,
    variable,
)
from acausal.study import Measurement


class Counting(Executor):
    """Runs at once, in this process; a run takes 1 ms for each operation."""

    def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> Future:
        future: Future = Future()
        try:
            found = fn(*args, **kwargs)
            if isinstance(found, Measurement) and not found.error:
                found = replace(found, solve_seconds=1e-3 * found.operations)
            future.set_result(found)
        except BaseException as error:
            future.set_exception(error)
        return future


def one() -> Any:
    """1, at the price of some operations."""
    return exp(time) * exp(-time)


class Ramp(Model):
    """x = (1 + share + k + k) t and y = 1.05 t in full: each small effect adds k, both together the 0.05 of y."""

    stop_time = 1.0
    small: bool = effect("a small slope", default=True)
    other: bool = effect("another small slope", default=True)
    share: str = effect("a large slope", choices=("full", "half", "none"), default="half")
    silent: bool = effect("what the model does not call for", default=True)
    k: Scalar = parameter("small slope", default=0.015)
    x: Scalar = output("sum of the slopes")
    y: Scalar = output("slope by both small effects")
    s: Scalar = variable("integral", fixed=True)
    p: Scalar = variable("integral", fixed=True)

    def equations(self):
        slope = 1 + {"full": 1.0, "half": 0.5, "none": 0.0}[self.share] * one()
        for present in (self.small, self.other):
            if present:
                slope = slope + self.k * one()
        yield der(self.s) == slope
        yield der(self.p) == 1 + (0.05 if self.small and self.other else 0.0)
        yield self.x == self.s
        yield self.y == self.p


class Fragile(Model):
    """Cannot be compiled in full, nor integrated without its other effect."""

    kind: str = effect("kind of the slope", choices=("fullest", "full", "plain"), default="full")
    bounded: bool = effect("what keeps it real", default=True)
    x: Scalar = output("position")
    s: Scalar = variable("integral", fixed=True)

    def equations(self):
        if self.kind == "fullest":
            raise DeclarationError("the fullest kind is not there yet.")
        yield der(self.s) == (one() if self.kind == "full" else 1) * (1 if self.bounded else sqrt(0.5 - time))
        yield self.x == self.s


class Leaf(Component):
    """A part with an effect of its own and one that its owner has as well."""

    shared: bool = effect("what the owner passes on", default=True)
    own: bool = effect("what is the leaf's", default=True)
    x: Scalar = variable("integral", fixed=True)

    def equations(self):
        yield der(self.x) == (1.0 if self.shared else 2.0) + (0.5 if self.own else 0.0)


class Branch(Component):
    """Owner of a leaf."""

    shared: bool = effect("what the leaf gets", default=True)

    @part
    def leaf(self):
        return Leaf(shared=self.shared)


class Tree(Model):
    """A branch or a leaf, by an effect of the model."""

    kind: str = effect("kind of the part", choices=("branch", "leaf"), default="leaf")
    limited: Any = effect("what is not made fuller", choices=("much", "some", None), default="some", tries=(None,))

    @part
    def it(self):
        return Branch() if self.kind == "branch" else Leaf(own=False)
