"""Parts of drives, each in a scene."""

from __future__ import annotations

from acausal import chain, connect, cos, fixed, part, sin, structural, time
from components import (
    Revolute,
    rotational,
)
from tests.components.scenes.scene import Scene


class Shaft(Scene):
    """A body on a revolute joint whose shaft is driven."""

    starts = structural("whether the joint has values at the start", default=True)

    @part
    def joint(self):
        start = {"phi": fixed(0.4), "w": fixed(3.0)} if self.starts else {}
        return Revolute(n=(0, 1, 2), use_axis_flange=True, **start)

    def graph(self):
        yield from self.path(self.joint)
        yield from self.drive()

    def drive(self):
        yield connect(self.joint.axis, self.through(self.it)[0])


class WithRotor(Shaft):
    rotor = rotational.Inertia(J=0.05, phi=fixed(0.1), w=fixed(-1.0))

    def drive(self):
        first, second = self.through(self.it)
        yield connect(self.joint.axis, first)
        yield connect(second, self.rotor.flange_a)


class OnShaftSpring(WithRotor):
    @part
    def it(self):
        return rotational.Spring(c=8.0, phi_rel0=-0.3 if self.turned else 0.3)


class OnShaftDamper(WithRotor):
    it = rotational.Damper(d=0.3)


class OnShaftSpringDamper(WithRotor):
    @part
    def it(self):
        return rotational.SpringDamper(c=8.0, d=0.3, phi_rel0=-0.3 if self.turned else 0.3)


class OnShaftFixed(Shaft):
    it = rotational.Fixed(phi0=0.2)
    spring = rotational.Spring(c=8.0)

    def drive(self):
        yield chain(self.joint.axis, self.spring, self.it.flange)


class OnShaftInertia(Shaft):
    it = rotational.Inertia(J=0.05)
    torque = rotational.Torque(tau=sin(3 * time))

    def drive(self):
        first, second = self.through(self.it)
        yield connect(self.joint.axis, first)
        yield connect(second, self.torque.flange)


class OnShaftTorque(Shaft):
    it = rotational.Torque(tau=2 * sin(3 * time))


class Prescribed(Shaft):
    """A drive that prescribes the motion, and a rotor on a spring that answers."""

    starts = structural("whether the joint has values at the start", default=False)
    spring = rotational.Spring(c=8.0)
    rotor = rotational.Inertia(J=0.05, phi=fixed(0.1), w=fixed(-1.0))

    def drive(self):
        yield from super().drive()
        yield chain(self.joint.axis, self.spring, self.rotor)


class OnShaftPosition(Prescribed):
    it = rotational.Position(phi_ref=0.4 + 0.5 * sin(3 * time))


class OnShaftMove(Prescribed):
    it = rotational.Move(u=(0.4 + 0.5 * sin(3 * time), 1.5 * cos(3 * time), -4.5 * sin(3 * time)))


class OnShaftAngleToTorque(Prescribed):
    it = rotational.AngleToTorqueAdaptor(phi=0.4 + 0.5 * sin(3 * time), w=1.5 * cos(3 * time), a=-4.5 * sin(3 * time))


class OnShaftGeneralAngleToTorque(Prescribed):
    it = rotational.GeneralAngleToTorqueAdaptor(
        p=0.4 + 0.5 * sin(3 * time), pder=1.5 * cos(3 * time), pder2=-4.5 * sin(3 * time)
    )


class OnShaftTorqueToAngle(Shaft):
    it = rotational.TorqueToAngleAdaptor(tau=2 * sin(3 * time))


class OnShaftGeneralTorqueToAngle(Shaft):
    it = rotational.GeneralTorqueToAngleAdaptor(f=2 * sin(3 * time))


class OnShaftSpeed(Prescribed):
    it = rotational.Speed(w_ref=2 * cos(3 * time), phi=fixed(0.4))
