"""Forces and moments on a body, given over time: at its frames, or at nodes of its mesh."""

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
# Of a run: breaks that are nearer are one, far above rounding of their times.
APART = 1e-9
# Of a step: how far from its end a break is at its end, by rounding of the times.
WITHIN = 1e-6
FORM = 'FrameLoad("tip", force=(0, 0, 1)) or FrameLoad(node=17, force=...)'


@dataclass(frozen=True)
class FrameLoad:
    """Force and moment at a frame of a body, or force at a node.

    Parameters
    ----------
    frame : str, optional
        Name of the frame.
    force : 3 floats or callable
        Force in N, or a function of the time in s that returns it.
    moment : 3 floats or callable
        Moment in N.m, or such a function; not at a node, which has no rotation.
    follower : bool
        Whether both are resolved in the moving axes of the body instead of those of the world.
    node : int, optional
        Row of a node, counted from 0, in place of a frame.
    breaks : sequence of float
        Times in s at which force or moment jump or have a kink. Steps of controlled size end there; steps of one size should.
    """

    frame: str | None = None
    force: Course = (0.0, 0.0, 0.0)
    moment: Course = (0.0, 0.0, 0.0)
    follower: bool = False
    node: int | None = None
    breaks: Sequence[float] = ()

    @property
    def place(self) -> str:
        """Where it acts, for messages."""
        return f"`{self.frame}`" if self.node is None else f"node {self.node}"

    def courses(self) -> Iterator[tuple[str, Course]]:
        """Force and moment with their names, without those that are 0."""
        for name, course in (("force", self.force), ("moment", self.moment)):
            if callable(course) or sampled(course, np.zeros(1), f"{name} at {self.place}").any():
                yield name, course


def sampled(course: Any, times: Array, what: str) -> Array:
    """Values at times, shape (times, 3).

    Raises
    ------
    DeclarationError
        If a value is no finite vector of three numbers.
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
        raise DeclarationError(f"{what} is a vector of three numbers, not {values[wrong]!r}{at}")
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
    """Return each load with the frame at which it acts.

    Raises
    ------
    DeclarationError
        If the body does not have the frame or node, with those that there are, or a moment acts where it cannot be carried.
    """
    if not isinstance(loads, Sequence):
        raise DeclarationError(f"loads are a list, [FrameLoad(...), ...], not {loads!r}")
    found = []
    for load in loads:
        if not isinstance(load, FrameLoad):
            raise DeclarationError(f"a load is {FORM}, not {load!r}")
        if (load.frame is None) == (load.node is None):
            raise DeclarationError(f"a load acts at a frame or at a node, {FORM}: {load!r}")
        if not isinstance(load.follower, bool | np.bool_):
            raise DeclarationError(f"follower of the load at {load.place} is True or False, not {load.follower!r}")
        at = _frame(body, load.frame) if load.node is None else node_frame(body, load.node)
        if not at.turns and any(name == "moment" for name, _ in load.courses()):
            few = "is given by one node or by nodes on a line, which" if load.node is None else "has no rotation and"
            what = f"the frame {load.place} {few}" if load.node is None else f"{load.place} {few}"
            raise DeclarationError(f"{what} cannot carry a moment: take a frame of more nodes")
        found.append((load, at))
    return found


def _frame(body: ReducedBody, name: Any) -> Interface:
    for frame in body.interfaces:
        if frame.name == name:
            return frame
    names = ", ".join(frame.name for frame in body.interfaces)
    has = f"it has {names}" if names else "it has none: reduce_body(..., frames={...})"
    raise DeclarationError(f"the body has no frame {_quoted(name)} for a load: {has}")


def _quoted(name: Any) -> str:
    return f"`{name}`" if isinstance(name, str) else f"{name!r}"


def node_frame(body: ReducedBody, node: Any) -> Interface:
    """Return a node as a frame, which carries no moment.

    Parameters
    ----------
    body : ReducedBody
        With modes at nodes.
    node : int
        Row of the node, counted from 0.

    Raises
    ------
    DeclarationError
        If there is no such node, or the body has no modes at nodes, with the call that gives it a frame there.
    """
    field = body.nodal
    if isinstance(node, bool) or not isinstance(node, int | np.integer):
        raise DeclarationError(f"a node is a row of the nodes, counted from 0, not {node!r}")
    if field is None:
        raise DeclarationError(
            f"this body has no modes at nodes, which pickles, save(nodal=False) and SID files leave behind: give it a frame, "
            f'reduce_body(..., frames={{"point": [{node}]}}), and load that, FrameLoad("point", ...)'
        )
    if not 0 <= node < len(field.nodes):
        raise DeclarationError(f"the body has no node {node}: nodes are rows from 0 to {len(field.nodes) - 1}")
    return Interface(f"node {node}", field.nodes[node], field.modes[node], np.zeros((3, body.n)), turns=False)


def breaks_of(loads: Sequence[FrameLoad], stop_time: float) -> Array:
    """Return the times within a run at which loads break, and the stop time, increasing; those that rounding parts are one.

    Raises
    ------
    DeclarationError
        If one is no finite number.
    """
    found = [np.array([stop_time])]
    for load in loads:
        try:
            times = np.array(load.breaks, dtype=float).reshape(-1)
        except (TypeError, ValueError):
            times = np.full(1, np.nan)
        if not np.isfinite(times).all():
            raise DeclarationError(f"breaks of the load at {load.place} are times in s, not {load.breaks!r}")
        found.append(times[(times > APART * stop_time) & (times < (1 - APART) * stop_time)])
    return apart(np.concatenate(found), stop_time)


def apart(times: Array, stop_time: float) -> Array:
    """Return times of a run, increasing, those that rounding parts as one."""
    found = np.unique(times)
    return found[np.diff(found, prepend=-np.inf) > APART * stop_time]


def check_breaks(loads: Sequence[FrameLoad], stop_time: float, dt: float) -> None:
    """Warn where a load breaks inside of a step of one size, which costs the order of that step."""
    times = breaks_of(loads, stop_time)
    off = np.abs(times / dt - np.round(times / dt)) > WITHIN
    if off.any():
        warnings.warn(
            f"a load breaks at t = {times[off][0]:.6g} s, inside of a step of {dt:g} s: take steps that end there, or tolerance=",
            AcausalWarning,
            stacklevel=3,
        )
