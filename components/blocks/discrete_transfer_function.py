"""DiscreteTransferFunction: sampled transfer function."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal import DeclarationError, Scalar, discrete, reinit, structural
from components.blocks.periodic_block import PeriodicBlock


class DiscreteTransferFunction(PeriodicBlock):
    """Transfer function b(z) / a(z), acting at samples."""

    b: tuple = structural("coefficients of the numerator, the highest power of z first", default=(1,))
    a: tuple = structural("coefficients of the denominator, the highest power of z first", default=(1,))
    x: Any = discrete("last states", shape=lambda s: (max(1, len(s.a) - 1),))
    out: Scalar = discrete("output", start=0)

    def check(self):
        if not len(self.a) or self.a[0] == 0 or len(self.b) > len(self.a):
            raise DeclarationError(
                "a transfer function b(z) / a(z) has a first coefficient of a that is not 0, and no more coefficients of b than "
                f"of a; here b has {len(self.b)}, a {len(self.a)}."
            )

    def equations(self):
        a, b = (np.asarray(part, dtype=float) for part in (self.a, self.b))
        b = np.concatenate([np.zeros(len(a) - len(b)), b])
        if len(a) == 1:
            yield self.sampled(reinit(self.out, b[0] / a[0] * self.u))
        else:
            first = (self.u - sum(c * x for c, x in zip(a[1:], self.x, strict=True))) / a[0]
            out = sum(c * x for c, x in zip(b, [first, *self.x], strict=True))
            moved = [reinit(self.x[k], self.x[k - 1] if k else first) for k in range(len(a) - 1)]
            yield self.sampled(*moved, reinit(self.out, out))
        yield self.y == self.out
