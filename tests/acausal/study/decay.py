"""A model whose error of discretisation is known: x = (1 + error) exp(-rate t), in ways with and without a limit."""

import acausal as ac
from acausal import Formulation, Model, Scalar, as_expr, der, output, parameter, structural, variable


class Decay(Model):
    """One formulation falls with 1 / n^2, another with 1 / n^4, one stays 5 % off, and one grows without bound."""

    stop_time = 2.0
    formulations = (
        Formulation("square", {"kind": "square"}, {"n": (4, 8)}, exact=True),
        Formulation("fourth", {"kind": "fourth"}, {"n": (4, 8)}, exact=True),
        Formulation("off", {"kind": "off"}, {"n": (4, 8)}),
        Formulation("unstable", {"kind": "unstable"}),
    )
    kind: str = structural("kind", default="square", choices=("square", "fourth", "off", "unstable"))
    n: int = structural("elements", default=4, minimum=1)
    rate: Scalar = parameter("rate", unit="1/s", default=1.0)
    x: Scalar = output("decays")
    s: Scalar = variable("exact", start=1.0, fixed=True)

    def equations(self):
        grows = self.kind == "unstable"
        error = {"square": 1 / self.n**2, "fourth": 1 / self.n**4, "off": 0.05 + 0.01 / self.n**4, "unstable": 0}
        yield der(self.s) == as_expr((20 if grows else -1) * self.rate.sx * self.s.sx)
        yield self.x == (1 + error[self.kind]) * self.s


FEW = {"tolerances": (1e-4, 1e-7), "repeats": 1, "workers": 2, "intervals": 20}


def study(**options):
    return ac.study(Decay(), **{**FEW, **options})
