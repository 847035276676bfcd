"""TransferFunction: transfer function b(s) / a(s) in controller canonical form."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import DeclarationError, der, parameter, structural, variable
from components.blocks.siso import SISO


class TransferFunction(SISO):
    """Transfer function b(s) / a(s) in controller canonical form."""

    b: tuple = structural("coefficients of the numerator, the highest power first", default=(1,), shape=None)
    a: tuple = structural("coefficients of the denominator, the highest power first", default=(1,))
    x_start: Any = parameter("initial state", shape=lambda s: (len(s.a) - 1,), default=lambda s: np.zeros(len(s.a) - 1))
    x: Any = variable("state", shape=lambda s: (max(1, len(s.a) - 1),))

    def check(self):
        if not len(self.a) or self.a[0] == 0 or len(self.b) > len(self.a):
            raise DeclarationError(
                f"a transfer function b(s) / a(s) has a first coefficient of a that is not 0, and no more coefficients of b than "
                f"of a; here b has {len(self.b)}, a {len(self.a)}."
            )

    def equations(self):
        a, b = (np.asarray(part, dtype=float) for part in (self.a, self.b))
        b = np.concatenate([np.zeros(len(a) - len(b)), b])
        d = b[0] / a[0]
        if len(a) == 1:
            yield self.x[0] == 0
            yield self.y == d * self.u
            return
        yield der(self.x[0]) == (self.u - sum(c * x for c, x in zip(a[1:], self.x, strict=True))) / a[0]
        for k in range(1, len(a) - 1):
            yield der(self.x[k]) == self.x[k - 1]
        yield self.y == sum(c * x for c, x in zip(b[1:] - d * a[1:], self.x, strict=True)) + d * self.u

    def initial_equations(self):
        if len(self.a) > 1:
            yield self.x == self.x_start
