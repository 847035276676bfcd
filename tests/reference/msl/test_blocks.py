"""Models of Modelica.Blocks.Examples and ModelicaTest.Blocks."""

from __future__ import annotations

import numpy as np

from acausal import Model, chain, connect, der, fixed
from components import blocks, rotational
from tests.reference.msl.published import compare


class Continuous(Model):
    ramp = blocks.Ramp(offset=0.5, start_time=0.5, duration=2)
    const = blocks.Constant(k=1.5)
    integrator, limIntegrator, derivative = blocks.Integrator(), blocks.LimIntegrator(out_max=1), blocks.Derivative()
    firstOrder, secondOrder, pI = blocks.FirstOrder(T=1), blocks.SecondOrder(w=1, D=1), blocks.PI(T=1)
    pID, limPID = blocks.PID(Ti=0.5, Td=0.1), blocks.LimPID(Ti=0.5, Td=0.1, y_max=1)
    transferFunction = blocks.TransferFunction(a=(1, 1), b=(1,))
    stateSpace = blocks.StateSpace(A=[[1, 0], [0, 1]], B=[[1], [1]], C=[[1, 1]])
    lowpassButterworth, criticalDamping = blocks.LowpassButterworth(f=1), blocks.CriticalDamping(normalized=False, f=1)

    def connections(self):
        for name in ("integrator", "limIntegrator", "derivative", "firstOrder", "secondOrder", "pI", "pID"):
            yield connect(self.ramp.y, getattr(self, name).u)
        for name in ("transferFunction", "lowpassButterworth", "criticalDamping"):
            yield connect(self.ramp.y, getattr(self, name).u)
        yield connect(self.ramp.y, self.limPID.u_s)
        yield connect(self.const.y, self.limPID.u_m)

    def equations(self):
        yield self.stateSpace.u[0] == self.ramp.y


def test_continuous_blocks():
    names = {
        "limPID.D.x": "limPID.xd",
        "limPID.I.y": "limPID.xi",
        "pID.D.x": "pID.xd",
        "pID.I.y": "pID.xi",
        "transferFunction.x_scaled[1]": "transferFunction.x[1]",
        # Our second state is the derivative over the cut-off frequency.
        "lowpassButterworth.x2[1]": lambda r: r["lowpassButterworth.x2"][:, 0] * 2 * np.pi,
    }
    compare("ModelicaTest.Blocks.Continuous_InitialState", Continuous(), names)


class Limiters(Model):
    sine = blocks.Sine(amplitude=2, f=1)
    limiter, variableLimiter, deadZone = blocks.Limiter(u_max=1), blocks.VariableLimiter(), blocks.DeadZone(u_max=1)
    slewRateLimiter = blocks.SlewRateLimiter(rising=10)

    def connections(self):
        for name in ("limiter", "variableLimiter", "deadZone", "slewRateLimiter"):
            yield connect(self.sine.y, getattr(self, name).u)

    def equations(self):
        yield self.variableLimiter.limit1 == 1
        yield self.variableLimiter.limit2 == -1


def test_limiters():
    compare("ModelicaTest.Blocks.Limiters", Limiters(), method="rosenbrock")


class PointToPoint(Model):
    way1 = blocks.KinematicPTP(qd_max=[3], qdd_max=[4], start_time=0.5, deltaq=[1])
    way2 = blocks.KinematicPTP(qd_max=[3], qdd_max=[4], start_time=0.5, deltaq=[4])
    integrator, integrator1 = blocks.Integrator(), blocks.Integrator(y_start=1)
    integrator2, integrator3 = blocks.Integrator(), blocks.Integrator(y_start=1)

    def equations(self):
        yield self.integrator.u == self.way1.y[0]
        yield self.integrator2.u == self.way2.y[0]

    def connections(self):
        yield connect(self.integrator.y, self.integrator1.u)
        yield connect(self.integrator2.y, self.integrator3.u)


def test_point_to_point():
    compare("ModelicaTest.Blocks.KinematicPTP", PointToPoint())


class Hysteresis(Model):
    hysteresis = blocks.Hysteresis(u_low=-0.5, u_high=0.5)
    signal = blocks.Sine(f=1)

    def connections(self):
        yield connect(self.signal.y, self.hysteresis.u)


def test_hysteresis():
    compare("ModelicaTest.Blocks.Hysteresis", Hysteresis())


class Held(Model):
    sine = blocks.Sine(f=1, offset=0.5)
    zeroOrderHold = blocks.ZeroOrderHold(sample_period=0.05)
    firstOrderHold = blocks.FirstOrderHold(sample_period=0.05)

    def connections(self):
        yield connect(self.sine.y, self.zeroOrderHold.u)
        yield connect(self.sine.y, self.firstOrderHold.u)


def test_holds():
    names = {
        "zeroOrderHold.ySample": "zeroOrderHold.held",
        "firstOrderHold.uSample": "firstOrderHold.held",
        "firstOrderHold.tSample": "firstOrderHold.since",
        "firstOrderHold.c": "firstOrderHold.slope",
    }
    compare("ModelicaTest.Blocks.FirstOrderHold", Held(), names)


class Discrete(Model):
    sine, pulse = blocks.Sine(f=3), blocks.BooleanPulse(period=0.2)
    sampler, zeroOrderHold = blocks.Sampler(sample_period=0.02), blocks.ZeroOrderHold(sample_period=0.02)
    firstOrderHold, unitDelay = blocks.FirstOrderHold(sample_period=0.02), blocks.UnitDelay(sample_period=0.02)
    transferFunction = blocks.DiscreteTransferFunction(sample_period=0.02, a=(1, 0.1), b=(1,))
    triggeredSampler = blocks.TriggeredSampler(y_start=2)

    def connections(self):
        for name in ("sampler", "zeroOrderHold", "firstOrderHold", "unitDelay", "transferFunction", "triggeredSampler"):
            yield connect(self.sine.y, getattr(self, name).u)
        yield connect(self.pulse.y, self.triggeredSampler.trigger)


def test_discrete_blocks():
    names = {"zeroOrderHold.ySample": "zeroOrderHold.held", "firstOrderHold.uSample": "firstOrderHold.held"}
    compare("ModelicaTest.Blocks.Discrete", Discrete(), names)


class Smoothed(Model):
    step = blocks.Step(start_time=0.1)
    limit_v = blocks.SlewRateLimiter(rising=2, Td=0.0001)
    limit_a = blocks.SlewRateLimiter(rising=20, Td=0.0001)
    positionSmoothed = blocks.Integrator()

    def connections(self):
        yield connect(self.step.y, self.limit_v.u)
        yield connect(self.limit_a.y, self.positionSmoothed.u)

    def equations(self):
        yield self.limit_a.u == der(self.limit_v.x)


def test_slew_rate_limiters():
    compare("Modelica.Blocks.Examples.SlewRateLimiter", Smoothed())


class Drive(Model):
    """Its controller starts in steady state."""

    PI = blocks.LimPID(k=100, Ti=0.1, y_max=12, Ni=0.1, controller_type="PI")
    inertia1, inertia2 = rotational.Inertia(J=1, phi=fixed(0), w=fixed(0)), rotational.Inertia(J=2)
    torque, load = rotational.Torque(), rotational.ConstantTorque(tau_constant=10)
    spring = rotational.SpringDamper(c=1e4, d=100, phi_rel=fixed(1e-3), w_rel=fixed(0))
    way = blocks.KinematicPTP(start_time=0.5, deltaq=[np.pi / 2], qd_max=[1], qdd_max=[1])
    integrator = blocks.Integrator()
    speedSensor = rotational.SpeedSensor()

    def connections(self):
        yield chain(self.torque.flange, self.inertia1, self.spring, self.inertia2, self.load.flange)
        yield connect(self.speedSensor.flange, self.inertia1.flange_b)
        yield connect(self.PI.y, self.torque.tau)
        yield connect(self.speedSensor.w, self.PI.u_m)
        yield connect(self.integrator.y, self.PI.u_s)

    def equations(self):
        yield self.integrator.u == self.way.y[0]


def test_drive_with_controller():
    # At rest the controller holds the load: -10 = -k x; the spring carries it.
    model = Drive(PI=blocks.LimPID(k=100, Ti=0.1, y_max=12, Ni=0.1, controller_type="PI", xi_start=-0.1))
    compare("Modelica.Blocks.Examples.PID_Controller", model, {"PI.I.y": "PI.xi"})


class Loops(Model):
    """Controllers with limits and lags, from their steady states on."""

    STEPS = ((0.4, 0.5, 0.5), (-1.5, 2, 0.9), (1.5, -1, 0.1), (0.4, 0.5, 0.5))
    step1, step2, step3, step4 = (blocks.Step(height=h, offset=o, start_time=1) for h, o, _ in STEPS)
    PID1, PID2, PID3, PID4 = (
        blocks.LimPID(controller_type="PI", Ti=1, y_max=1, y_min=0, xi_start=x) for *_, x in STEPS
    )
    firstOrder1, firstOrder4 = blocks.FirstOrder(T=1, y_start=0.5), blocks.FirstOrder(T=1, y_start=0.5)
    firstOrder2, firstOrder3 = blocks.FirstOrder(T=1, y_start=1), blocks.FirstOrder(T=1, y_start=0)

    def connections(self):
        for k in "1234":
            step, controller, lag = (getattr(self, name + k) for name in ("step", "PID", "firstOrder"))
            yield connect(step.y, controller.u_s)
            yield connect(controller.y, lag.u)
            yield connect(lag.y, controller.u_m)


def test_limited_controllers():
    compare("ModelicaTest.Blocks.LimPID", Loops(), {f"PID{k}.I.y": f"PID{k}.xi" for k in "1234"})


class Strict(Model):
    sine3 = blocks.Sine(amplitude=1.5, f=2)
    slewRateLimiter1, limIntegrator1 = blocks.SlewRateLimiter(rising=13), blocks.LimIntegrator(k=5, out_max=0.9)

    def connections(self):
        yield connect(self.sine3.y, self.slewRateLimiter1.u)
        yield connect(self.sine3.y, self.limIntegrator1.u)


def test_strict_limiters():
    compare("ModelicaTest.Blocks.StrictLimiters", Strict())


class SelfResetting(Model):
    integrator = blocks.Integrator(use_reset=True, u=1)
    threshold = blocks.GreaterEqualThreshold(threshold=1)

    def connections(self):
        yield connect(self.integrator.y, self.threshold.u)
        yield connect(self.threshold.y, self.integrator.reset)


def test_an_integrator_that_resets_itself():
    compare("ModelicaTest.Blocks.SelfResettingIntegrator", SelfResetting())


class Reset(Model):
    """A limited integrator that is reset at both edges of a pulse."""

    integrator = blocks.LimIntegrator(k=2, out_max=0.75, use_reset=True)
    pulse = blocks.BooleanPulse(period=1)
    rises, falls, either = blocks.Edge(), blocks.Edge(), blocks.Or()
    inverse = blocks.Not()

    def connections(self):
        yield connect(self.pulse.y, self.rises.u)
        yield connect(self.pulse.y, self.inverse.u)
        yield connect(self.inverse.y, self.falls.u)
        yield connect(self.rises.y, self.either.u1)
        yield connect(self.falls.y, self.either.u2)
        yield connect(self.either.y, self.integrator.reset)

    def equations(self):
        yield self.integrator.u == 2 * self.pulse.y - 1


def test_a_limited_integrator_with_reset():
    compare("ModelicaTest.Blocks.LimResetIntegrator", Reset())
