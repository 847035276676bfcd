"""Run of a scene with one free body by steps in inertial frames, as a formulation of a study."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np

from acausal import CompiledModel, DeclarationError, Formulation, Result, simulate
from components.fe.arrays import Array
from components.fe.body.fe_body import FEBody
from components.fe.body.modal_properties import with_modes
from components.fe.reconfigured.load import FrameLoad, sampled
from components.fe.reconfigured.result import as_result
from components.fe.reconfigured.simulate import simulate_reconfigured
from components.fe.reconfigured.step_limits import WHOLE
from components.fe.reduction.reduced_body import ReducedBody

Loads = Sequence[FrameLoad] | Callable[[Any], Sequence[FrameLoad]]
# Difference between loads and those of the scene, relative to the largest load: round-off of rotations and step errors.
SAME = 1e-6
# Arguments of `simulate_reconfigured` and the corresponding variables of an FEBody.
START = {
    "position": "ref.r_0",
    "attitude": "ref.R.T",
    "velocity": "v_0",
    "spin": "w_a",
    "q": "q",
    "qd": "qd",
}


def run_reconfigured(
    model: CompiledModel,
    stop_time: float,
    times: Sequence[float] | Array,
    dt: float | None = None,
    *,
    tolerance: float | None = None,
    body: str = "body",
    loads: Loads = (),
    progress: Callable[[float, int], None] | None = None,
    **options: Any,
) -> Result:
    """Run a scene in which one free FEBody moves by steps in inertial frames.

    `by_steps` makes formulations with this run. Start values, gravity, modes, stiffness and damping are those of the
    scene.

    Parameters
    ----------
    model : CompiledModel
        Compiled scene.
    stop_time : float
        Stop time in s.
    times : array_like, shape (n,)
        Equidistant times from 0 to `stop_time` in s.
    dt : float
        Largest step in s; steps are shortened to end at each of the times.
    tolerance : float
        Tolerance of `simulate_reconfigured`, instead of `dt`.
    body : str
        Path of the body.
    loads : sequence of FrameLoad, or callable
        Loads of the scene on the frames, or a function of the scene that returns them.
    progress : callable, optional
        Called with the completed fraction of the run and the number of steps.
    **options
        `variant` and `readings` of `simulate_reconfigured`.

    Returns
    -------
    Result
        All variables of the scene at the times, see `as_result`.

    Raises
    ------
    DeclarationError
        If the body does not exist, something else moves, gravity or effects are not supported by the steps, or the
        loads differ from those of the scene.
    """
    parts, gravity = _body(model, body)
    given = loads(model.tree) if callable(loads) else loads
    first = simulate(model, stop_time=float(times[1]), intervals=1)
    start = {key: first[f"{body}.{name}"][0] for key, name in START.items()}
    span = float(times[1])
    motion = simulate_reconfigured(
        parts,
        given,
        stop_time,
        None if dt is None else span / math.ceil(span / dt - WHOLE),
        tolerance=tolerance,
        intervals=None if tolerance is None else len(times) - 1,
        damping=model.value(f"{body}.damping_ratio") if model.value(f"{body}.damping") else 0.0,
        gravity=gravity,
        progress=progress,
        **start,
        **options,
    )
    result = as_result(motion, body, model=model, times=times)
    _check_loads(result, body, parts, given)
    return result


def by_steps(
    settings: Mapping[str, Any], dt: Sequence[float], loads: Loads = (), body: str = "body"
) -> tuple[Formulation, ...]:
    """Return formulations of a scene by steps in inertial frames.

    They are "reconfigured, as printed" and "reconfigured, corrected" with fixed steps, and "reconfigured, controlled"
    with adaptive steps.

    Parameters
    ----------
    settings : mapping of str to value
        Settings that select the flexible body in the scene.
    dt : sequence of float
        Steps in s to be tried.
    loads, body
        See `run_reconfigured`.
    """
    run = partial(run_reconfigured, loads=loads, body=body)
    names = {"reconfigured, as printed": "paper", "reconfigured, corrected": "corrected"}
    sized = (Formulation(name, settings, run=partial(run, variant=kind), dt=dt) for name, kind in names.items())
    return *sized, Formulation("reconfigured, controlled", settings, run=run)


def _check_loads(result: Result, body: str, parts: ReducedBody, loads: Sequence[FrameLoad]) -> None:
    """Check the loads against those of the scene along the motion."""
    if any(load.node is not None for load in loads):
        raise DeclarationError("loads of a scene must act at frames of the body, not at nodes")
    for interface in parts.interfaces:
        frame = f"{body}.{interface.name}"
        T, own = result[f"{frame}.R.T"], [load for load in loads if load.frame == interface.name]
        for what, unit, part in (("f", "N", "force"), ("t", "N.m", "moment")):
            acts = np.einsum("tij,ti->tj", T, result[f"{frame}.{what}"])
            given = np.zeros_like(acts)
            for load in own:
                course = sampled(getattr(load, part), result.time, f"{part} at `{interface.name}`")
                given += np.einsum("tij,ti->tj", result[f"{body}.ref.R.T"], course) if load.follower else course
            wrong = np.abs(acts - given).max(axis=1) > SAME * max(np.abs(acts).max(), np.abs(given).max())
            # At a jump of a load, a single time may have either value.
            for k in np.flatnonzero(wrong[1:] & wrong[:-1])[:1]:
                shown = " and ".join(str(tuple(np.round(x[k + 1], 6).tolist())) for x in (acts, given))
                raise DeclarationError(
                    f"the {part} at `{interface.name}` at t = {result.time[k + 1]:.6g} s is {shown} {unit} in the scene and in "
                    "the loads. Do this: pass the loads of the scene as loads=[FrameLoad(...), ...]"
                )


def _body(model: CompiledModel, path: str) -> tuple[ReducedBody, Array | None]:
    """Return the body with its modes, stiffness and damping, and gravity."""
    own: Any = model.value(path)
    if not isinstance(own, FEBody):
        raise DeclarationError(f"`{path}` is not an FEBody, but {own!r}; pass the path of one as body=")
    if own._held:
        raise DeclarationError(
            f"`{path}` has its reference frame at `{own._held.name}`; steps in inertial frames need mean axes"
        )
    if not (own.centrifugal and own.coriolis):
        raise DeclarationError(
            f"steps in inertial frames need centrifugal and Coriolis forces, which are switched off in `{path}`"
        )
    world = own.world
    if own.weight and world.gravity == "point":
        raise DeclarationError("steps in inertial frames support uniform gravity only, not point gravity")
    reduced = with_modes(own.reduced, own.modes)
    reduced = dataclasses.replace(reduced, K=model.value(f"{path}.stiffness") * reduced.K)
    if not own.damping:
        reduced = dataclasses.replace(reduced, D=0 * reduced.D)
    if not own.weight or world.gravity is None:
        return reduced, None
    n = np.array(world.n, dtype=float)
    return reduced, model.value(f"{world._path}.g") * n / np.linalg.norm(n)
