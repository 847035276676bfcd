"""Sampled blocks of Modelica.Blocks.Examples and ModelicaTest.Blocks."""

from __future__ import annotations

import numpy as np

from acausal import (
    Component,
    Model,
    Scalar,
    cos,
    der,
    discrete,
    input,
    parameter,
    piecewise,
    reinit,
    sin,
    sqrt,
    time,
    variable,
    when,
)
from components import blocks
from tests.reference.msl.published import compare


class Mean(Component):
    """Mean value of the last period, as of Modelica.Blocks.Math."""

    f: Scalar = parameter("base frequency", unit="Hz", default=2)
    u: Scalar = input("signal")
    x: Scalar = variable("integral", start=0, fixed=True)
    y: Scalar = discrete("mean")
    due: Scalar = discrete("end of the period", unit="s", start=1 / f)

    def equations(self):
        yield der(self.x) == self.u
        mean = reinit(self.y, self.f * self.x)
        yield when(time >= self.due, mean, reinit(self.x, 0), reinit(self.due, self.due + 1 / self.f))


class Means(Model):
    cosine = blocks.Cosine(offset=0.5, f=2, phase=np.pi / 4)
    mean = Mean()

    def equations(self):
        yield self.mean.u == self.cosine.y


def test_mean():
    compare("ModelicaTest.Blocks.Mean", Means())


class RootMeanSquare(Model):
    expSine = blocks.ExpSine(f=2, damping=0.5, offset=-0.5)
    mean1, square = Mean(), Mean()
    rms: Scalar = variable("root of the mean square")

    def equations(self):
        yield self.mean1.u == self.expSine.y
        yield self.square.u == self.expSine.y**2
        yield self.rms == sqrt(self.square.y)


def test_root_mean_square():
    names = {f"rootMeanSquare.mean.{own}": f"square.{own}" for own in "xy"}
    compare("ModelicaTest.Blocks.RootMeanSquare", RootMeanSquare(), names)


class Harmonics(Model):
    """A wave of 50 Hz with its third harmonic, its square, and its first harmonic."""

    u: Scalar = variable("voltage", unit="V")
    mean1, mean2, mean = Mean(f=50), Mean(f=50), Mean(f=50)

    def equations(self):
        w, since = 2 * np.pi * 50, time - 0.02
        waves = np.sqrt(2) * (100 * sin(w * since) + 20 * sin(3 * w * since))
        yield self.u == piecewise((0, since < 0), waves)
        yield self.mean1.u == self.u * np.sqrt(2) * cos(w * time)
        yield self.mean2.u == self.u * np.sqrt(2) * sin(w * time)
        yield self.mean.u == self.u**2


def test_harmonics():
    names = {f"thd1.harmonic.mean{k}.x": f"mean{k}.x" for k in "12"}
    names["thd1.rootMeanSquare.mean.x"] = "mean.x"
    compare("Modelica.Blocks.Examples.TotalHarmonicDistortion", Harmonics(), names)


class Random:
    """Numbers of the generator xorshift128+, seeded by xorshift64* as in Modelica.Math.Random, from -1 to 3."""

    def __init__(self, seed):
        self.seed = seed

    def reset(self):
        state = self.seed + (67867967 << 32)
        for _ in range(10):
            state = following(state)
        self.state = state, following(state)

    def __call__(self, time, u):
        first, second = self.state
        first ^= first << 23 & MASK
        new = (first ^ second ^ first >> 17 ^ second >> 26) + second & MASK
        self.state = second, new
        return -1 + 4 * ((new - (new >> 63 << 64)) / 2**64 + 0.5)


MASK = 2**64 - 1


def following(state):
    """Next state of xorshift64*."""
    state ^= state >> 12
    state ^= state << 25 & MASK
    state ^= state >> 27
    return state * 2685821657736338717 & MASK


class Noise(Model):
    uniformNoise2 = blocks.Sampled(f=Random(seed=10), period=0.02, inputs=0)


def test_uniform_noise():
    compare("Modelica.Blocks.Examples.Noise.UniformNoise", Noise(), {"uniformNoise2_y": "uniformNoise2.y"})
