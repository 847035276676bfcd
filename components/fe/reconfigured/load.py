"""Forces and moments over time at the frames of a body, and forces at nodes of its mesh."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from acausal import AcausalWarning, DeclarationError
from components.fe.arrays import Array
from components.fe.reduction.interface import Interface
from components.fe.reduction.reduced_body import ReducedBody

Course = Sequence[float] | Array | Callable[[float], Any]
# Distance of breaks that count as one, relative to the run: far above round-off of their times.
APART = 1e-9
# Distance of a break from the end of a step that counts as 0, relative to the step: round-off of times.
WITHIN = 1e-6
FORM = 'FrameLoad("tip", force=(0, 0, 1)) or FrameLoad(node=17, force=...)'


@dataclass(frozen=True)
class FrameLoad:
    """Force and moment at a frame of a body, or a force at a node.

    Parameters
    ----------
    frame : str, optional
        Name of the frame.
    force : 3 floats or callable
        Force in N, or a function of the time in s that returns it.
    moment : 3 floats or callable
        Moment in N.m, or such a function. Nodes have no rotation, and take no moment.
    follower : bool
        Whether both are resolved in the axes of the body instead of the world.
    node : int, optional
        Row of a node, counted from 0, instead of a frame.
    breaks : sequence of float
        Times in s of jumps or kinks of force or moment. Steps of adaptive size end there; steps of fixed size should.
    """

    frame: str | None = None
    force: Course = (0.0, 0.0, 0.0)
    moment: Course = (0.0, 0.0, 0.0)
    follower: bool = False
    node: int | None = None
    breaks: Sequence[float] = ()

    @property
    def place(self) -> str:
        """Point of application, for messages."""
        return f"`{self.frame}`" if self.node is None else f"node {self.node}"

    def courses(self) -> Iterator[tuple[str, Course]]:
        """Yield force and moment with their names, unless 0."""
        for name, course in (("force", self.force), ("moment", self.moment)):
            if callable(course) or sampled(course, np.zeros(1), f"{name} at {self.place}").any():
                yield name, course


def sampled(course: Any, times: Array, what: str) -> Array:
    """Return the values at times, shape (times, 3).

    Raises
    ------
    DeclarationError
        If a value is not a finite vector of three numbers.
    """
    moves = callable(course)
    values: Any = [course(float(t)) for t in times] if moves else [course]
    try:
        found = np.array(values, dtype=float)
    except (TypeError, ValueError):
        found = np.zeros(0)
    if found.shape != (len(values), 3):
        wrong = next((k for k, value in enumerate(values) if not _is_vector(value)), 0)
        at = f" at t = {times[wrong]:.6g} s" * moves
        raise DeclarationError(f"{what} must be a vector of three numbers, not {values[wrong]!r}{at}")
    finite = np.isfinite(found).all(axis=1)
    if not finite.all():
        raise DeclarationError(f"{what} is not finite" + f" at t = {times[int(np.argmin(finite))]:.6g} s" * moves)
    return np.broadcast_to(found, (len(times), 3))


def _is_vector(value: Any) -> bool:
    try:
        return np.array(value, dtype=float).shape == (3,)
    except (TypeError, ValueError):
        return False


def acting(body: ReducedBody, loads: Sequence[FrameLoad]) -> list[tuple[FrameLoad, Interface]]:
    """Return each load with the frame on which it acts.

    Raises
    ------
    DeclarationError
        If the body lacks the frame or node, or a moment acts on a frame that cannot carry it.
    """
    if not isinstance(loads, Sequence):
        raise DeclarationError(f"loads must be a list [FrameLoad(...), ...], not {loads!r}")
    found = []
    for load in loads:
        if not isinstance(load, FrameLoad):
            raise DeclarationError(f"a load must be {FORM}, not {load!r}")
        if (load.frame is None) == (load.node is None):
            raise DeclarationError(f"a load needs either a frame or a node, {FORM}, not {load!r}")
        if not isinstance(load.follower, bool | np.bool_):
            raise DeclarationError(f"follower of the load at {load.place} must be True or False, not {load.follower!r}")
        at = _frame(body, load.frame) if load.node is None else node_frame(body, load.node)
        if not at.turns and any(name == "moment" for name, _ in load.courses()):
            why = (
                f"the frame {load.place} has one node or collinear nodes"
                if load.node is None
                else f"{load.place} has no rotation"
            )
            raise DeclarationError(f"{why} and cannot carry a moment; use a frame of more nodes")
        found.append((load, at))
    return found


def _frame(body: ReducedBody, name: Any) -> Interface:
    for frame in body.interfaces:
        if frame.name == name:
            return frame
    names = ", ".join(frame.name for frame in body.interfaces)
    has = f"it has {names}" if names else "it has none; define them by reduce_body(..., frames={...})"
    raise DeclarationError(f"the body has no frame {_quoted(name)}: {has}")


def _quoted(name: Any) -> str:
    return f"`{name}`" if isinstance(name, str) else f"{name!r}"


def node_frame(body: ReducedBody, node: Any) -> Interface:
    """Return a node as a frame that carries no moment.

    Parameters
    ----------
    body : ReducedBody
        Body with nodal modes.
    node : int
        Row of the node, counted from 0.

    Raises
    ------
    DeclarationError
        If the node does not exist, or the body has no nodal modes.
    """
    field = body.nodal
    if isinstance(node, bool) or not isinstance(node, int | np.integer):
        raise DeclarationError(f"node must be a row of the nodes, counted from 0, not {node!r}")
    if field is None:
        raise DeclarationError(
            "this body has no nodal modes, as pickles, save(nodal=False) and SID files omit them. Do this: define a frame, "
            f'reduce_body(..., frames={{"point": [{node}]}}), and use FrameLoad("point", ...)'
        )
    if not 0 <= node < len(field.nodes):
        raise DeclarationError(f"the body has no node {node}; nodes are numbered 0 to {len(field.nodes) - 1}")
    return Interface(f"node {node}", field.nodes[node], field.modes[node], np.zeros((3, body.n)), turns=False)


def breaks_of(loads: Sequence[FrameLoad], stop_time: float) -> Array:
    """Return the distinct break times of loads within a run and the stop time, ascending.

    Raises
    ------
    DeclarationError
        If a break is not a finite number.
    """
    found = [np.array([stop_time])]
    for load in loads:
        try:
            times = np.array(load.breaks, dtype=float).reshape(-1)
        except (TypeError, ValueError):
            times = np.full(1, np.nan)
        if not np.isfinite(times).all():
            raise DeclarationError(f"breaks of the load at {load.place} must be times in s, not {load.breaks!r}")
        found.append(times[(times > APART * stop_time) & (times < (1 - APART) * stop_time)])
    return apart(np.concatenate(found), stop_time)


def apart(times: Array, stop_time: float) -> Array:
    """Return the times in ascending order, without those that differ by round-off."""
    found = np.unique(times)
    return found[np.diff(found, prepend=-np.inf) > APART * stop_time]


def check_breaks(loads: Sequence[FrameLoad], stop_time: float, dt: float) -> None:
    """Warn of a break inside a step of fixed size, which loses the order of that step."""
    times = breaks_of(loads, stop_time)
    off = np.abs(times / dt - np.round(times / dt)) > WITHIN
    if off.any():
        warnings.warn(
            f"a load breaks at t = {times[off][0]:.6g} s, inside a step of {dt:g} s; use steps that end there, or tolerance=",
            AcausalWarning,
            stacklevel=3,
        )
