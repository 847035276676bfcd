"""Conditions at the start: fixed start values, then initial equations of components."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace

import casadi as ca

from acausal.flatten.collected_statements import CollectedStatements
from acausal.flatten.flat_model import Initial
from acausal.flatten.origin import Origin
from acausal.symbols import dense, scalars, stacked


@dataclass(frozen=True)
class InitialConditions:
    """Residuals, a column, with the text and the origin of each, and whether closed loops override it."""

    residuals: ca.SX
    texts: list[tuple[str, Origin]]
    soft: list[bool]

    @classmethod
    def of(cls, raw: CollectedStatements, residuals: ca.SX) -> InitialConditions:
        """Return the conditions of a model.

        Parameters
        ----------
        raw : CollectedStatements
            Statements of the components.
        residuals : casadi.SX
            Residuals of the initial equations, without placeholders of derivatives.
        """
        fixed = [
            (residual, (text, replace(Origin.of(a.owner), where=a.start_line)))
            for a in raw.arrays
            for residual, text in a.conditions()
        ]
        column = stacked([*(dense(residual) for residual, _ in fixed), dense(residuals)])
        texts = [text for _, text in fixed] + [("initial equation", o) for o in raw.initial.scalar_origins()]
        return cls(column, texts, [False] * len(fixed) + raw.initial.scalar_soft())

    def without(self, eliminated: tuple[ca.SX, ca.SX], satisfied: Collection[int]) -> tuple[Initial, ...]:
        """Return the conditions in the remaining unknowns.

        Parameters
        ----------
        eliminated : (casadi.SX, casadi.SX)
            Eliminated unknowns, and their expressions.
        satisfied : collection of int
            Numbers of conditions that unknowns that stay 0 satisfy; these are omitted.
        """
        if not self.texts:
            return ()
        entries = scalars(ca.substitute([self.residuals], [eliminated[0]], [eliminated[1]])[0])
        found = enumerate(zip(entries, self.texts, self.soft, strict=True))
        return tuple(Initial(residual, *text, s) for k, (residual, text, s) in found if k not in satisfied)
