"""Integration by CasADi's interfaces: SUNDIALS IDAS, and its own one-step method where the core is missing."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal.compiler.dae import UNSEEN
from acausal.policy import POLICY
from acausal.solve.integrate.flat import looked_at
from acausal.solve.integrate.integration import Integration, Request
from acausal.solve.integrate.ladder import Kind, Refusal, read
from acausal.solve.integrate.one_step import first_step, sizes
from acausal.solve.integrate.trace import Leg
from acausal.solve.integrate.unfit import unfit_time
from acausal.solve.point import Rows

CALLS = POLICY.calls


class ByCasadi(Integration):
    """Integration by a plugin of CasADi.

    Parameters
    ----------
    request : Request
        What it is asked for.
    plugin : str
        Name of the integrator.
    options : dict
        Its options.
    counted : tuple of str
        What it calls its steps, factorisations and evaluations.
    seen : pair of arrays, optional
        Sizes of states and algebraic unknowns that it sees as 1, if it does.
    """

    def __init__(
        self,
        request: Request,
        plugin: str,
        options: dict[str, Any],
        counted: tuple[str, str, str],
        seen: tuple[np.ndarray, np.ndarray] | None = None,
    ) -> None:
        self.request = request
        self._counted, self._seen = counted, seen or (1.0, 1.0)
        problem, at, times = request.problem, request.at, request.times
        grid = tuple(np.round((times[1:] - times[0]) / request.span, CALLS.digits).tolist())
        c = problem.compiled
        self._call = c.integrator(plugin, grid, options, request.works, request.way.moves, seen is not None)
        x_size, z_size = self._seen
        p = [[times[0], request.span], problem.hoisted, at.constants.vector, *([seen[0]] if seen else [])]
        given = {"x0": at.x / x_size, "z0": at.z / z_size, "p": np.concatenate(p)}
        for k, name in enumerate(self._call.function.name_in()):
            if name in given:
                self._call.inputs[k][:] = given[name]
        self._call.clear()

    @property
    def counts(self) -> tuple[int, int, int]:
        """Steps, factorisations and evaluations of the equations so far."""
        stats = self._call.stats
        steps, factorisations, evaluations = (int(stats.get(name, 0)) for name in self._counted)
        return steps, factorisations, evaluations

    def go(self) -> Refusal | None:
        """Integrate to the end, or as far as possible."""
        done, said = self._call.attempt()
        request = self.request
        unfit = self._unfit(request)
        if unfit is not None:
            return Refusal(Kind.UNFIT, unfit)
        return None if done else read(said, request.times[0], request.times[-1])

    def _unfit(self, request: Request) -> float | None:
        """When other constraints are to be kept, as far as it came."""
        if request.at.constants.all_count:
            return None
        rows = Rows.joined([Rows.of(request.at), self.leg().rows])
        rows = rows[np.flatnonzero(np.isfinite(rows.x).all(axis=1))]
        return unfit_time(looked_at(request.problem, rows.times, rows.x, request.at.constants), request.at.time)

    def leg(self) -> Leg:
        """Return the values at all output times: nan at those that were not reached, integrals 0 where none were asked for."""
        out = dict(zip(self._call.function.name_out(), self._call.outputs, strict=True))
        n, (x_size, z_size) = len(self.request.times) - 1, self._seen
        x, z = out["xf"].reshape(n, -1) * x_size, out["zf"].reshape(n, -1) * z_size
        energy = out["qf"].reshape(n, 2).copy() if out["qf"].size else np.zeros((n, 2))
        return self.request.leg(x, z, energy, self.counts[0])


def by_idas(request: Request) -> ByCasadi:
    """IDAS: order limit, algebraic unknowns out of the error test, weights from nominal values.

    IDAS takes all first derivatives as 0 unless it computes them itself: the quick way lets it compute them, if any
    matter; the careful one starts with a step so short that they do not, and with the linear solver that does not rely on
    its pivots.
    """
    way, at, nominal, c = request.way, request.at, request.settings.nominal, request.problem.compiled
    rates = request.problem.values(at)[: c.nx]
    weights = way.tolerance * (np.abs(at.x) + nominal[: c.nx])
    steepest = float(np.max(np.abs(rates) * request.span / weights, initial=0.0))
    options = {
        "reltol": way.tolerance,
        "abstolv": np.maximum(way.tolerance * nominal, request.floor).tolist(),
        "max_multistep_order": request.settings.order(way),
        "suppress_algebraic": True,
        "max_num_steps": way.max_steps,
        "disable_internal_warnings": True,
        "quad_err_con": False,
        # Errors of a loose Newton iteration excite lightly damped vibrations, which then cost steps; near a singular
        # position of a loop they are enlarged.
        "nonlin_conv_coeff": CALLS.newton_in_loops if c.constraints.size else CALLS.newton,
        "show_eval_warnings": False,
        "linear_solver": "qr" if way.careful or c.nx + c.nz > CALLS.large else "csparse",
        "calc_ic": steepest > 1 and not (way.gentle or way.careful),
    }
    if (way.gentle or way.careful) and steepest > 1:
        options["step0"] = 10.0 ** -np.ceil(np.log10(steepest / CALLS.gentle))
    return ByCasadi(request, "idas", options, ("nsteps", "nlinsetups", "nfevals"))


def by_rosenbrock(request: Request) -> ByCasadi:
    """CasADi's one-step method: one sequence of steps across all outputs."""
    tolerance, problem = request.way.tolerance, request.problem
    options = {
        "reltol": tolerance,
        "abstol": tolerance,
        "control_group_size": [len(request.times) - 1],
        "quad_err_con": False,
        "max_num_steps": max(POLICY.rescue.fewest_long, request.way.max_steps),
        "show_eval_warnings": False,
    }
    if first := first_step(request):
        options["step0"] = first
    seen = (
        sizes(request.problem, request.settings.nominal, request.settings.spectrum.vibration),
        UNSEEN * problem.nominal[problem.nx :],
    )
    return ByCasadi(request, "rosenbrock", options, ("n_steps", "n_jac", "n_rhs"), seen)
