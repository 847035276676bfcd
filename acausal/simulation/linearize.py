"""linearize(): the model as a linear system about its initial point."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import casadi as ca
import numpy as np
import scipy

from acausal.compiler import CompiledModel, ready
from acausal.compiler.call import Call
from acausal.errors import InitializationError, caution
from acausal.flatten.model_inputs import inputs_of
from acausal.language.call_arguments import checked_arguments
from acausal.language.component import Component
from acausal.locks import exclusive
from acausal.policy import POLICY
from acausal.simulation.inputs import at_time
from acausal.simulation.linear_point import check_point
from acausal.simulation.model_settings import check_number, effective_settings
from acausal.solve.diagnosis.not_finite import cause, infinite_slope
from acausal.solve.initialization.independent_constraints import smallest_singular_value
from acausal.solve.initialization.initial_events import first_point
from acausal.solve.initialization.tangent_space import Elimination, tangent
from acausal.solve.point import Point
from acausal.solve.problem import Problem
from acausal.symbols import scalars

# Smallest singular value relative to the largest, below which it is round-off of the zero of a free coordinate.
NOTHING = 1e-12
ALONE = 1e-9  # norm of a matrix product relative to its factors, below which it is round-off of zero
SINGULAR = "its equations are singular there, as in a singular configuration of a loop. Start slightly away from it."
SINGULAR_AT_REST = (
    "its closed loops rest in a singular configuration, where forces of rigid parts are not determined. Let a part of the "
    "loop be elastic, or start slightly away from there."
)
# Smallest singular value of the constraint Jacobian below which derivatives that depend on its square are lost in round-off:
# its square is then near the unit round-off.
NEARLY_SINGULAR = 1e-7


SHOWN = 8  # frequencies in the short text


@dataclass(frozen=True, repr=False)
class Linearization:
    """Linear system dx/dt = A x + B u, y = C x + D u in the deviations from the linearisation point.

    Parameters
    ----------
    A, B, C, D : arrays, shapes (n, n), (n, m), (r, n), (r, m)
        The system matrices.
    states, inputs, outputs : tuples of str
        Names of rows and columns.
    """

    A: np.ndarray
    B: np.ndarray
    C: np.ndarray
    D: np.ndarray
    states: tuple[str, ...]
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]

    def __repr__(self) -> str:
        counts = f"{len(self.states)} states, {len(self.inputs)} inputs, {len(self.outputs)} outputs"
        shown = ", ".join(f"{f:.4g}" for f in self.frequencies_hz[:SHOWN])
        more = ", ..." if len(self.frequencies_hz) > SHOWN else ""
        return f"Linearization({counts}; frequencies in Hz: {shown or 'none'}{more})"

    def _repr_html_(self) -> str:
        """Show frequencies and damping ratios."""
        modes = zip(self.frequencies_hz, self.damping_ratios, strict=True)
        rows = "".join(f"<tr><td>{f:.6g}</td><td>{d:.4g}</td></tr>" for f, d in modes)
        table = f"<table><tr><th>frequency [Hz]</th><th>damping ratio</th></tr>{rows}</table>" if rows else ""
        return f"<p>{len(self.states)} states, {len(self.inputs)} inputs, {len(self.outputs)} outputs</p>{table}"

    @property
    def eigenvalues(self) -> np.ndarray:
        """Eigenvalues of A in 1/s, sorted by magnitude, then by imaginary part."""
        values = _eigenvalues(self.A)
        size = np.abs(values) / (np.max(np.abs(values), initial=0.0) or 1.0)
        return values[np.lexsort((np.imag(values), np.round(size, 9)))]

    @property
    def _oscillations(self) -> np.ndarray:
        values = self.eigenvalues
        size = np.abs(values).max(initial=0.0)
        pairs = values[(np.imag(values) > 0) & (np.imag(values) > 1e-9 * size)]
        return pairs[np.argsort(np.imag(pairs))]

    @property
    def frequencies_hz(self) -> np.ndarray:
        """|Im lambda| / 2 pi, one for each conjugate pair, ascending, without zeros."""
        return np.imag(self._oscillations) / (2 * np.pi)

    @property
    def damping_ratios(self) -> np.ndarray:
        """-Re lambda / |lambda| of the same pairs."""
        return -np.real(self._oscillations) / np.abs(self._oscillations)

    def to_control(self) -> Any:
        """Return the system as `control.StateSpace`, with the names of states, inputs and outputs; needs the package control."""
        import control

        names = {"states": list(self.states), "inputs": list(self.inputs), "outputs": list(self.outputs)}
        return control.StateSpace(self.A, self.B, self.C, self.D, **names)

    def to_scipy(self) -> Any:
        """Return the system as `scipy.signal.StateSpace`."""
        from scipy.signal import StateSpace

        return StateSpace(self.A, self.B, self.C, self.D)

    @property
    def mode_shapes(self) -> tuple[np.ndarray, np.ndarray]:
        """Eigenvalues (n,) and eigenvectors (n, n), one mode per column, with rows in the order of `states`."""
        return np.linalg.eig(self.A)


@checked_arguments
@exclusive
def linearize(
    model: Component | CompiledModel,
    *,
    parameters: Mapping[str, Any] | None = None,
    inputs: Mapping[str, Any] | None = None,
    initial: str | None = None,
    time: float = 0.0,
) -> Linearization:
    """Linearise a model about its initial point, after the events at that instant.

    Parameters
    ----------
    model : Component or CompiledModel
        The model.
    parameters : mapping of str to value, optional
        Values by path.
    inputs : mapping of str to data, optional
        As in `simulate`; their values at `time` belong to the point.
    initial : "fixed", "guesses" or "steady"
        See `simulate`.
    time : float
        Start time in s.

    Returns
    -------
    Linearization

    Notes
    -----
    `feedback`, which stabilises invariants in a run, is 1/s here if it decouples from the motion: the quaternion norm of a
    freely turning body at rest adds an eigenvalue of -2 1/s that is neither controllable nor observable. If it does not
    decouple, as for a body that turns, feedback is 0.

    A warning is given if the point is neither at rest nor in steady rotation, and if the matrices change as a cyclic
    coordinate turns, so that the linear system is periodic.

    Unknowns that stay 0 in a run, such as the motion of a planar machine out of its plane, are part of the linear system.

    Discrete variables keep their values: a sampled controller does not act. A warning names functions that are not called.
    """
    how = effective_settings(model, parameters, {"initial": initial})["initial"]
    check_number("time", time)
    compiled, p = ready(model, at_time(model, parameters, inputs, time), full=True)
    problem = Problem(compiled, p)
    at = first_point(problem, time, how)
    if owners := compiled.guards.calls.owners(pure=False):
        caution(f"the functions of {owners} are not called: the linear system holds their outputs constant.")
    _refuse_singular(problem, at, how == "steady")
    own, nx = _inputs(compiled), compiled.nx
    slopes_at = _slopes(problem, ca.vertcat(*[sx for _, sx in own]))
    slopes = slopes_at(at)
    check_point(problem, at, slopes_at)
    N, independent = tangent(problem, at)
    # Derivatives by the independent states and the inputs.
    slopes = np.hstack([slopes[:, :nx] @ N, slopes[:, nx:]])
    (A, B), (C, D) = (np.split(rows, [len(independent)], axis=1) for rows in (slopes[independent], slopes[nx:]))
    names = [n for name in compiled.outputs for n in _entries(name, getattr(compiled.tree, name))]
    return Linearization(
        A=A,
        B=B,
        C=C,
        D=D,
        states=tuple(compiled.states[k] for k in independent),
        inputs=tuple(name for name, _ in own),
        outputs=tuple(names),
    )


def _refuse_singular(problem: Problem, at: Point, rests: bool) -> None:
    """Refuse singular configurations; near one, an equilibrium is too inexact for the large forces there."""
    if smallest_singular_value(problem, at) <= (POLICY.loops.flat if rests else NEARLY_SINGULAR):
        raise InitializationError(f"the model cannot be linearised: {SINGULAR_AT_REST if rests else SINGULAR}")


def _slopes(problem: Problem, u: ca.SX) -> Callable[[Point], np.ndarray]:
    """Return a function for the derivatives of rates and outputs by states and inputs, algebraic unknowns eliminated."""
    compiled, nx, nz = problem.compiled, problem.nx, problem.nz
    r = compiled.reduced
    outputs = ca.vertcat(*[ca.vec(getattr(compiled.tree, name).sx) for name in compiled.outputs])
    column = ca.vertcat(r.ode, r.alg, r.resolve(outputs) if outputs.numel() else ca.SX(0, 1))
    J = ca.jacobian(column, ca.vertcat(r.x, r.z, u))
    linear = Call(ca.Function("linear", compiled.arguments, [J]))
    pattern = linear.function.sparsity_out(0)
    M = scipy.sparse.csc_matrix((np.ones(pattern.nnz()), pattern.row(), pattern.colind()), shape=J.shape)
    states, unknowns, rest = np.split(np.arange(max(M.shape)), [nx, nx + nz])
    rows, columns = (np.append(states, rest[: n - nx - nz]) for n in M.shape)
    eliminated = Elimination.of(M, rows, columns, unknowns, unknowns)

    def slopes_at(at: Point) -> np.ndarray:
        kept, free = (
            linear(at.x, at.z, problem.p, at.time, replace(at.constants, feedback=f).vector, 0.0)[0].copy()
            for f in (problem.feedback, 0.0)
        )
        if not np.all(np.isfinite(kept)):
            raise InitializationError(
                f"the model cannot be linearised: {cause(problem, at) or infinite_slope(problem, at)}"
            )
        try:
            slopes, returning = eliminated.matrix(free), eliminated.matrix(kept)
        except RuntimeError:
            raise InitializationError(f"the model cannot be linearised: {cause(problem, at) or SINGULAR}") from None
        return returning if _apart(slopes[:nx, :nx], (returning - slopes)[:nx, :nx]) else slopes

    return slopes_at


def _inputs(compiled: CompiledModel) -> list[tuple[str, ca.SX]]:
    """Return the free parameters that represent the inputs of the model."""
    own, inputs = compiled.reduced.flat.parameters, inputs_of(compiled.tree)
    return [(n, s) for n, s in zip(own.names, scalars(own.symbols), strict=True) if s.element_hash() in inputs]


def _entries(name: str, value: Any) -> list[str]:
    """Return the names of the entries in column-major order."""
    places = sorted(np.ndindex(*value.shape), key=lambda index: index[::-1])
    return [name + (f"[{','.join(map(str, index))}]" if index else "") for index in places]


def _eigenvalues(A: np.ndarray) -> np.ndarray:
    """Return eigenvalues, with exact zeros for free coordinates: round-off would split a double zero by its square root.

    In an orthonormal basis of the null space N and its complement Q, a matrix has the zeros of N and the eigenvalues of
    Q' A Q.
    """
    A, zeros = scipy.linalg.matrix_balance(A, permute=False)[0] if A.size else A, 0
    while A.size:
        _, s, V = np.linalg.svd(A)
        rank = int(np.sum(s > NOTHING * s[0]))
        if rank == len(s):
            break
        zeros, A = zeros + len(s) - rank, V[:rank] @ A @ V[:rank].T
    return np.concatenate([np.linalg.eigvals(A).astype(complex), np.zeros(zeros)])


def _apart(A: np.ndarray, feedback: np.ndarray) -> bool:
    """Return whether the feedback decouples from the motion: both matrix products vanish."""
    size = np.abs(A).max(initial=0.0) * np.abs(feedback).max(initial=0.0)
    return max(np.abs(A @ feedback).max(initial=0.0), np.abs(feedback @ A).max(initial=0.0)) <= ALONE * size
