"""The reduced model: a semi-explicit DAE of index 1, and how everything else follows from its unknowns."""

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


@dataclass(frozen=True)
class Running:
    """A reduced model while it runs: the flag of the initial system is 0.

    Parameters
    ----------
    reduced : ReducedModel
        The model.
    ode, alg : casadi.SX
        Its equations.
    constraints, following : casadi.SX
        Residuals of its constraints, and values that follow from states; see `Projections`.
    """

    reduced: ReducedModel
    ode: ca.SX
    alg: ca.SX
    constraints: ca.SX
    following: ca.SX

    def resolve(self, expression: ca.SX, unprojected: bool = False) -> ca.SX:
        """Express anything of the model in x, z, parameters and time; see `ReducedModel.resolve`."""
        return ca.substitute(self.reduced.resolve(expression, unprojected), initial.sx, 0)


@dataclass(frozen=True)
class ReducedModel:
    """der(x) = ode(x, z, p, t), 0 = alg(x, z, p, t).

    Parameters
    ----------
    flat : FlatModel
        Where it comes from.
    plan : Plan
        The structural decisions.
    unknowns : casadi.SX
        All unknowns of the extended system.
    names : tuple of str
        Their names.
    x, z, ode, alg : casadi.SX
        States, algebraic unknowns and the equations of the integrated system.
    definitions : (casadi.SX, casadi.SX)
        Unknowns that were assigned or are observed, in order of evaluation, and what they are.
    projections : Projections
        Projections on the constraints, which hold at several levels.
    continuous : tuple of (casadi.SX, Origin)
        What is differentiated although switches change it: it must not jump.
    residuals : tuple of casadi.SX
        What is 0 in the extended system, whatever of it was substituted.
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
        """Constants of a segment of integration: switches, discrete variables, then the choice."""
        return ca.vertcat(self.flat.discontinuities.constants, self.projections.choice, feedback.sx)

    @cached_property
    def running(self) -> Running:
        """The model where the flag of the initial system is 0."""
        equations = [self.ode, self.alg, self.projections.constraints, self.projections.following]
        return Running(self, *ca.substitute(equations, [initial.sx], [ca.SX(0)]))

    @cached_property
    def dependence(self) -> Dependence:
        """Which algebraic unknowns a value needs."""
        return Dependence(self.running.alg, self.z)

    @cached_property
    def _resolved(self) -> ca.SX:
        """Definitions in terms of x, z, parameters and time alone."""
        symbols, expressions = self.definitions
        return ca.substitute_inplace([symbols], [expressions], [])[0][0] if symbols.numel() else expressions

    def resolve(self, expression: ca.SX, unprojected: bool = False) -> ca.SX:
        """Express anything of the model in x, z, parameters and time.

        Parameters
        ----------
        expression : casadi.SX
            In original symbols of the model or in remaining unknowns.
        unprojected : bool
            Whether to take coordinates as what is integrated in their place, which they are where the multipliers are 0.
        """
        was, becomes = self.flat.unknowns.eliminated
        first = ca.substitute([expression], [was], [becomes])
        if unprojected:
            first = ca.substitute(first, [self.projections.coordinates], [self.projections.states])
        return ca.substitute(first, [self.definitions[0]], [self._resolved])[0]
