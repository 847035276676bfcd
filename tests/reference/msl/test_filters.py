"""Filters, inverse models, limits and waves of Modelica.Blocks.Examples and ModelicaTest.Blocks."""

from __future__ import annotations

import numpy as np

from acausal import Component, Model, Scalar, asin, connect, cos, der, input, parameter, sin, sqrt, variable
from components import blocks
from tests.reference.msl.published import compare


class CriticalDamping(blocks.CriticalDamping):
    """It starts at rest, at 0.1."""

    def initial_equations(self):
        yield self.x == np.full(self.n, 0.1)


class Section(blocks.SISO):
    """Two complex poles in the form of Modelica.Blocks.Continuous.Filter; it starts at rest, at 0.1."""

    c0: Scalar = parameter("coefficient of s^0")
    c1: Scalar = parameter("coefficient of s^1")
    x1: Scalar = variable("first state")
    x2: Scalar = variable("second state")

    def poles(self):
        return -self.c1 / 2, sqrt(self.c0 - (self.c1 / 2) ** 2)

    def equations(self):
        a, b = self.poles()
        yield der(self.x1) == a * self.x1 - b * self.x2 + self.c0 / b * self.u
        yield der(self.x2) == b * self.x1 + a * self.x2
        yield self.y == self.x2

    def initial_equations(self):
        a, b = self.poles()
        yield self.x1 == -a / b * 0.1
        yield self.x2 == 0.1


W = 2 * np.pi * 2  # the cut-off frequency
# Coefficients a, b and c of 1 / (a p + 1) / (b p^2 + c p + 1), p = s / W; Chebyshev with a ripple of 0.5 dB, and 3 dB at W.
FILTERS = {
    "Bessel": (0.7548574865985343, 0.4756958028827457, 0.9980615136104388),
    "Butterworth": (1, 1, 1),
    "ChebyshevI": (1.86282148216644, 1.19203211750915, 0.63990679134902),
}


class Filters(Model):
    step = blocks.Step(start_time=0.1, offset=0.1)
    CriticalDamping = CriticalDamping(n=3, f=2 / np.sqrt(10**0.1 - 1), normalized=False)  # 3 dB at 2 Hz
    Bessel, Butterworth, ChebyshevI = (blocks.FirstOrder(T=a / W, y_start=0.1) for a, _, _ in FILTERS.values())
    Bessel2, Butterworth2, ChebyshevI2 = (Section(c0=W**2 / b, c1=W * c / b) for _, b, c in FILTERS.values())

    def connections(self):
        yield connect(self.step.y, self.CriticalDamping.u)
        for name in FILTERS:
            yield connect(self.step.y, getattr(self, name).u)
            yield connect(getattr(self, name).y, getattr(self, name + "2").u)


def test_filters():
    names = {f"{name}.x[1]": f"{name}.x" for name in FILTERS}
    names |= {f"{name}.x[{k}]": f"{name}2.x{k - 1}" for name in FILTERS for k in (2, 3)}
    compare("Modelica.Blocks.Examples.Filter", Filters(), names)


class Free(blocks.CriticalDamping):
    """Its state follows from its output."""

    def initial_equations(self):
        return ()


class Inverse(Model):
    """The input of the first lag follows from its output."""

    sine, criticalDamping = blocks.Sine(f=2, offset=1, start_time=0.2), Free(n=1, f=100)
    firstOrder1, firstOrder2 = (blocks.FirstOrder(T=0.3, y_start=1) for _ in range(2))

    def connections(self):
        yield connect(self.sine.y, self.criticalDamping.u)

    def equations(self):
        yield self.firstOrder1.y == self.criticalDamping.y
        yield self.firstOrder1.u == self.firstOrder2.u


def test_inverse_model():
    compare("Modelica.Blocks.Examples.InverseModel", Inverse())


class LimitedLoops(Model):
    """Two loops with a limiter and its inverse, from their steady states at its limit on."""

    ramp1, ramp2 = (blocks.Ramp(height=-9.5 * s, offset=10 * s, start_time=1, duration=100) for s in (1, -1))
    limiter1, limiter2 = blocks.Limiter(u_max=0.99), blocks.Limiter(u_max=0.99)
    controllerFeedbackPart1, controllerFeedbackPart2 = (blocks.FirstOrder(k=-1, y_start=-0.99 * s) for s in (1, -1))
    firstOrder1, firstOrder2 = (
        blocks.FirstOrder(k=2 / np.pi, y_start=2 / np.pi * np.arcsin(0.99 * s)) for s in (1, -1)
    )

    def equations(self):
        for k in "12":
            names = ("ramp", "limiter", "controllerFeedbackPart", "firstOrder")
            ramp, limiter, inner, outer = (getattr(self, name + k) for name in names)
            yield limiter.u == ramp.y - outer.y - inner.y
            yield inner.u == limiter.y
            yield outer.u == asin(limiter.y)


def test_limited_loops():
    compare("ModelicaTest.Blocks.LimitersHomotopy", LimitedLoops())


class Wave(Component):
    """Sine and cosine of variable frequency and amplitude."""

    amplitude: Scalar = input("amplitude", default=1)
    f: Scalar = input("frequency", unit="Hz", default=100)
    phi: Scalar = variable("phase", unit="rad", start=0, fixed=True)
    sine: Scalar = variable("sine")
    cosine: Scalar = variable("cosine")

    def equations(self):
        yield der(self.phi) == 2 * np.pi * self.f
        yield self.sine == self.amplitude * sin(self.phi)
        yield self.cosine == self.amplitude * cos(self.phi)


class Modulation(Model):
    amplitude, frequency = blocks.Sine(amplitude=0.5, f=2, offset=1), blocks.Sine(amplitude=50, f=2, offset=100)
    plain, am, fm = Wave(), Wave(), Wave()

    def connections(self):
        yield connect(self.amplitude.y, self.am.amplitude)
        yield connect(self.frequency.y, self.fm.f)


def test_modulation():
    names = {f"{wave[:3]}{kind.upper()}.y": f"{kind}.{wave}" for wave in ("sine", "cosine") for kind in ("am", "fm")}
    compare("Modelica.Blocks.Examples.Modulation", Modulation(), {"sine.y": "plain.sine", **names}, intervals=20_000)
