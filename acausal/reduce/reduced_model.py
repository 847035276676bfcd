"""Reduced model: a semi-explicit DAE of index 1, and the other variables in its unknowns."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import casadi as ca

from acausal.flatten import FlatModel
from acausal.flatten.origin import Origin
from acausal.language.functions import feedback, initial
from acausal.reduce.constrain import Projections
from acausal.reduce.dependence import Dependence
from acausal.structure import Plan
from acausal.symbols import inlined


@dataclass(frozen=True)
class Running:
    """Equations of a reduced model during a run, where the flag `initial` is 0.

    Parameters
    ----------
    reduced : ReducedModel
        The model.
    ode, alg : casadi.SX
        Equations of the model.
    constraints, following : casadi.SX
        Residuals of the constraints, and values that follow from states; see `Projections`.
    """

    reduced: ReducedModel
    ode: ca.SX
    alg: ca.SX
    constraints: ca.SX
    following: ca.SX

    def resolve(self, expression: ca.SX, unprojected: bool = False) -> ca.SX:
        """Return an expression of the model in x, z, parameters and time; see `ReducedModel.resolve`."""
        return ca.substitute(self.reduced.resolve(expression, unprojected), initial.sx, 0)


@dataclass(frozen=True)
class ReducedModel:
    """der(x) = ode(x, z, p, t), 0 = alg(x, z, p, t).

    Parameters
    ----------
    flat : FlatModel
        The flat model.
    plan : Plan
        Solution plan.
    unknowns : casadi.SX
        All unknowns of the extended system.
    names : tuple of str
        Names of the unknowns.
    x, z, ode, alg : casadi.SX
        States, algebraic unknowns and the equations of the integrated system.
    definitions : (casadi.SX, casadi.SX)
        Assigned and observed unknowns, in order of evaluation, and their expressions.
    projections : Projections
        Constraints, and projections on them.
    continuous : tuple of (casadi.SX, Origin)
        Differentiated expressions that depend on switches: they must not jump.
    residuals : tuple of casadi.SX
        Residuals of the extended system before substitution.
    kinks : casadi.SX
        Next times, after time, at which equations have kinks, in parameters and time.
    """

    flat: FlatModel
    plan: Plan
    unknowns: ca.SX
    names: tuple[str, ...]
    x: ca.SX
    z: ca.SX
    ode: ca.SX
    alg: ca.SX
    definitions: tuple[ca.SX, ca.SX]
    projections: Projections
    continuous: tuple[tuple[ca.SX, Origin], ...]
    residuals: tuple[ca.SX, ...]
    kinks: ca.SX

    @property
    def p(self) -> ca.SX:
        """Free parameters."""
        return self.flat.parameters.symbols

    @property
    def states(self) -> tuple[str, ...]:
        """Names of the states."""
        return tuple(self.names[k] for k in self.plan.states)

    @property
    def algebraic(self) -> tuple[str, ...]:
        """Names of the algebraic unknowns."""
        return tuple(self.names[k] for k in self.plan.algebraic)

    @cached_property
    def constants(self) -> ca.SX:
        """Constants between events: switches, discrete variables, the choice of projections, and the feedback."""
        return ca.vertcat(self.flat.discontinuities.constants, self.projections.choice, feedback.sx)

    @cached_property
    def running(self) -> Running:
        """Equations during a run, where the flag `initial` is 0."""
        equations = [self.ode, self.alg, self.projections.constraints, self.projections.following]
        return Running(self, *ca.substitute(equations, [initial.sx], [ca.SX(0)]))

    @cached_property
    def dependence(self) -> Dependence:
        """Dependence of values on algebraic unknowns."""
        return Dependence(self.running.alg, self.z)

    @cached_property
    def _resolved(self) -> ca.SX:
        """Definitions in terms of x, z, parameters and time."""
        symbols, expressions = self.definitions
        return inlined(symbols, expressions, [])[0] if symbols.numel() else expressions

    def resolve(self, expression: ca.SX, unprojected: bool = False) -> ca.SX:
        """Return an expression of the model in x, z, parameters and time.

        Parameters
        ----------
        expression : casadi.SX
            Expression in original symbols of the model or in remaining unknowns.
        unprojected : bool
            True to replace coordinates by their integrated variables, which equal them where the multipliers are 0.
        """
        was, becomes = self.flat.unknowns.eliminated
        first = ca.substitute([expression], [was], [becomes])
        if unprojected:
            first = ca.substitute(first, [self.projections.coordinates], [self.projections.states])
        return ca.substitute(first, [self.definitions[0]], [self._resolved])[0]
