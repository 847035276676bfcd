"""The constraints that hold at several levels, as numbers."""

from __future__ import annotations

from functools import cached_property

import casadi as ca
import numpy as np

from acausal.compiler.call import Call
from acausal.language.functions import initial, time
from acausal.reduce import ReducedModel

# Change of the multipliers in a Newton step, after which the next one would change rounding only: the rest is linear.
SETTLED = 1e-6
# Times at which equations are settled in one call.
AT_ONCE = 8


class Closing:
    """Residuals and Jacobian of the constraints by the states, and the layout of what is chosen for them.

    Parameters
    ----------
    reduced : ReducedModel
        The model.

    Attributes
    ----------
    rows : list of tuple of int
        Positions of the residuals of each constraint, lowest level first.
    multipliers : array of int
        Position of the multiplier of each residual among the algebraic unknowns.
    closures : list of int
        Constraint of each switch.
    entries : array of int, shape (2, n)
        Residual and state of each entry of D.
    """

    def __init__(self, reduced: ReducedModel) -> None:
        constrained, plan = reduced.plan.constrained, reduced.plan
        states = {v: k for k, v in enumerate(plan.states)}
        algebraic = {v: k for k, v in enumerate(plan.algebraic)}
        multipliers = [m for c in constrained.constraints for m in c.multipliers]
        residual = {m: k for k, m in enumerate(multipliers)}
        self.rows = [tuple(residual[m] for m in c.multipliers) for c in constrained.constraints]
        self.multipliers = np.array([algebraic[m] for m in multipliers], dtype=int)
        place = {c.base: k for k, c in enumerate(constrained.constraints)}
        # Without projections all equations that close loops are solved as they are.
        self.closures = [place[c.row] for c in reduced.flat.closures if place]
        pairs = [(residual[m], states[p.state]) for p in constrained.projections for m in p.multipliers]
        self.entries = np.array(pairs, dtype=int).reshape(-1, 2).T
        self.size = len(multipliers)
        self.states = np.array(sorted({k for _, k in pairs}), dtype=int)
        self._reduced = reduced
        self._settling: dict[int, Call] = {}
        self._many: dict[int, Call] = {}
        column = ca.substitute(reduced.closing.residuals, initial.sx, 0)
        r = reduced
        arguments = [r.x, r.flat.parameters, time.sx, r.modes]
        J = ca.densify(ca.jacobian(column, r.x))
        self.function = ca.Function("closing", arguments, [ca.densify(column), J])
        self._call = Call(self.function)
        coordinates = r.resolve(r.closing.coordinates)
        self._coordinates = Call(ca.Function("coordinates", [r.x, r.z, *arguments[1:]], [ca.densify(coordinates)]))
        found = [(algebraic[v], k) for k, (v, _) in enumerate(constrained.following) if v in algebraic]
        self._guessed = np.array([place for place, _ in found], dtype=int)
        following = ca.vertcat(ca.SX(0, 1), *[r.closing.following[k] for _, k in found])
        self._following = Call(
            ca.Function("following", arguments, [ca.densify(ca.substitute(following, initial.sx, 0))])
        )
        same = [
            (algebraic[q.coordinate], states[q.state]) for q in constrained.projections if q.coordinate in algebraic
        ]
        self._kept = np.array(same, dtype=int).reshape(-1, 2).T
        self._places = [states[p.state] for p in constrained.projections]

    def __call__(self, x: np.ndarray, p: np.ndarray, t: float, modes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return residuals, shape (size,), and their Jacobian by the states, shape (size, nx)."""
        value, J = self._call(x, p, t, modes)
        return value.copy(), J.reshape(len(x), self.size).T.copy()

    def held(self, x: np.ndarray, p: np.ndarray, t: np.ndarray, modes: np.ndarray) -> np.ndarray:
        """Jacobian of the constraints by the coordinates that each holds at its level, at n points.

        Parameters
        ----------
        x : array, shape (n, nx)
            States.
        p, modes : arrays
            Parameters and constants of the segment.
        t : array, shape (n,)
            Times.

        Returns
        -------
        array, shape (n, size, nx)
        """
        n, nx = x.shape
        if n not in self._many:
            self._many[n] = Call(self.function.map(n))
        _, J = self._many[n](x.ravel(), np.tile(p, n), t, np.tile(modes, n))
        full = J.reshape(n, nx, self.size).transpose(0, 2, 1)
        found = np.zeros_like(full)
        rows, columns = self.entries
        found[:, rows, columns] = full[:, rows, columns]
        return found

    def project(self, x: np.ndarray, z: np.ndarray, p: np.ndarray, t: float, modes: np.ndarray) -> np.ndarray:
        """Return the states with every coordinate where the constraints have it."""
        projected = x.copy()
        if self.size:
            projected[self._places] = self._coordinates(x, z, p, t, modes)[0]
        return projected

    def settle(self, x: np.ndarray, z: np.ndarray, p: np.ndarray, t: np.ndarray, modes: np.ndarray) -> np.ndarray:
        """Return algebraic unknowns for which all equations hold at every one of n times.

        An integrator interpolates between its steps: the constraints then hold to its tolerance only.

        Parameters
        ----------
        x, z : arrays, shapes (n, nx), (n, nz)
            States, and algebraic unknowns nearly right.
        p : array
            Parameters.
        t : array, shape (n,)
            Times.
        modes : array, shape (n, m)
            Constants of the segment of each time.
        """
        z, rows, before = z.copy(), np.arange(len(t)), np.full(len(t), np.inf)
        while rows.size:
            settled = self._step(x[rows], z[rows], p, t[rows], modes[rows])
            change = np.max(np.abs(settled - z[rows])[:, self.multipliers], axis=1, initial=0.0)
            z[rows] = settled
            again = (change > SETTLED) & (change < before[rows])
            before[rows] = change
            rows = rows[again]
        return z

    def _step(self, x: np.ndarray, z: np.ndarray, p: np.ndarray, t: np.ndarray, modes: np.ndarray) -> np.ndarray:
        """One Newton step at every time; where the equations are singular, none."""
        some = (slice(k, k + AT_ONCE) for k in range(0, len(t), AT_ONCE))
        return np.concatenate([self._some(x[k], z[k], p, t[k], modes[k]) for k in some])

    def _some(self, x: np.ndarray, z: np.ndarray, p: np.ndarray, t: np.ndarray, modes: np.ndarray) -> np.ndarray:
        n, size = len(t), AT_ONCE if len(t) > 1 else 1
        if size not in self._settling:
            self._settling[size] = Call(self._newton.map(size))
        call, rows = self._settling[size], np.minimum(np.arange(size), n - 1)
        values = (x[rows].ravel(), z[rows].ravel(), np.tile(p, size), t[rows], modes[rows].ravel())
        for array, value in zip(call.inputs, values, strict=True):
            array[:] = value
        done, _ = call.attempt()
        found = call.outputs[0].reshape(size, -1)[:n].copy()
        if done and np.all(np.isfinite(found)):
            return found
        if n == 1:
            return z
        each = (slice(k, k + 1) for k in range(n))
        return np.concatenate([self._some(x[k], z[k], p, t[k], modes[k]) for k in each])

    @cached_property
    def _newton(self) -> ca.Function:
        """One Newton step for the algebraic unknowns."""
        r = self._reduced
        arguments = [r.x, r.z, r.flat.parameters, time.sx, r.modes]
        alg = ca.substitute(r.alg, initial.sx, 0)
        both = ca.Function("alg", arguments, ca.cse([ca.densify(alg), ca.jacobian(alg, r.z)]))
        symbols = [ca.MX.sym(f"a{k}", a.numel()) for k, a in enumerate(arguments)]
        value, J = both(*symbols)
        return ca.Function("newton", symbols, [symbols[1] - ca.solve(J, value, "csparse")])

    def guess(self, x: np.ndarray, z: np.ndarray, p: np.ndarray, t: float, modes: np.ndarray) -> np.ndarray:
        """Return the algebraic unknowns with all those in place that follow from the states."""
        z = z.copy()
        z[self._guessed] = self._following(x, p, t, modes)[0]
        z[self._kept[0]] = x[self._kept[1]]
        return z
