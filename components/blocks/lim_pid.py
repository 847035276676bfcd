"""LimPID: p, PI, PD or PID controller with limited output, anti-windup and weights of the setpoint."""

from __future__ import annotations

from acausal import Component, Scalar, clip, der, input, output, parameter, structural, variable


class LimPID(Component):
    """P, PI, PD or PID controller with limited output, anti-windup and weights of the setpoint."""

    u_s: Scalar = input("setpoint")
    u_m: Scalar = input("measurement")
    controller_type: str = structural("kind", default="PID", choices=("P", "PI", "PD", "PID"))
    k: Scalar = parameter("gain", default=1)
    Ti: Scalar = parameter("time constant of the integrator", unit="s", default=0.5, positive=True)
    Td: Scalar = parameter("time constant of the derivative", unit="s", default=0.1, positive=True)
    y_max: Scalar = parameter("upper limit of the output", default=1)
    y_min: Scalar = parameter("lower limit of the output", default=lambda s: -s.y_max)
    wp: Scalar = parameter("weight of the setpoint in the proportional part", default=1)
    wd: Scalar = parameter("weight of the setpoint in the derivative", default=0)
    Ni: Scalar = parameter("Ni Ti is the time constant of the anti-windup", default=0.9, positive=True)
    Nd: Scalar = parameter("ratio of Td to the lag of the derivative", default=10, positive=True)
    u_ff: Scalar = input("feed-forward", default=0)
    k_ff: Scalar = parameter("gain of the feed-forward", default=1)
    xi_start: Scalar = parameter("initial integral", default=0)
    xd_start: Scalar = parameter("initial state of the derivative", default=0)
    y: Scalar = output("output")
    free: Scalar = variable("output without limits")
    xi: Scalar = variable("integral of the control error over Ti")
    xd: Scalar = variable("weighted setpoint less measurement through the lag of the derivative")

    def equations(self):
        total = self.wp * self.u_s - self.u_m
        if "I" in self.controller_type:
            windup = (self.y - self.free) / (self.k * self.Ni)
            yield der(self.xi) == (self.u_s - self.u_m + windup) / self.Ti
            total = total + self.xi
        else:
            yield self.xi == 0
        if "D" in self.controller_type:
            lag, moved = self.Td / self.Nd, self.wd * self.u_s - self.u_m
            yield der(self.xd) == (moved - self.xd) / lag
            total = total + self.Td / lag * (moved - self.xd)
        else:
            yield self.xd == 0
        yield self.free == self.k * total + self.k_ff * self.u_ff
        yield self.y == clip(self.free, self.y_min, self.y_max)

    def initial_equations(self):
        if "I" in self.controller_type:
            yield self.xi == self.xi_start
        if "D" in self.controller_type:
            yield self.xd == self.xd_start
