"""Machines of blocks, joined by signals as FMUs are: GenerationOfFMUs of Modelica's Rotational and Translational."""

from __future__ import annotations

from acausal import Component, Model, Scalar, chain, connect, fixed, input, output, sine
from components import rotational as r
from components import translational as t
from tests.reference.msl.published import compare

SINE = sine(amplitude=10, f=2)


def resting(J):
    return r.Inertia(J=J, phi=fixed(0), w=fixed(0))


class DirectInertia(Component):
    """Motion from torque."""

    tauDrive: Scalar = input("torque that drives", unit="N.m")
    tau: Scalar = input("torque of what is driven", unit="N.m")
    phi: Scalar = output("angle", unit="rad")
    w: Scalar = output("speed", unit="rad/s")
    a: Scalar = output("acceleration", unit="rad/s2")
    inertia, source, adaptor = resting(1.1), r.Torque(tau=tauDrive), r.TorqueToAngleAdaptor(tau=tau)

    def connections(self):
        yield chain(self.source.flange, self.inertia, self.adaptor.flange)
        for name in ("phi", "w", "a"):
            yield connect(getattr(self.adaptor, name), getattr(self, name))


class InverseInertia(Component):
    """Torque from motion."""

    phi: Scalar = input("angle", unit="rad")
    w: Scalar = input("speed", unit="rad/s")
    a: Scalar = input("acceleration", unit="rad/s2")
    tau: Scalar = output("torque", unit="N.m")
    inertia, adaptor = r.Inertia(J=2.2), r.AngleToTorqueAdaptor(phi=phi, w=w, a=a)

    def connections(self):
        yield connect(self.adaptor.flange, self.inertia.flange_a)
        yield connect(self.adaptor.tau, self.tau)


def angle_out(n):
    return r.TorqueToAngleAdaptor(use_w=n > 1, use_a=n > 2)


def angle_in(n):
    return r.AngleToTorqueAdaptor(use_w=n > 1, use_a=n > 2)


class Coupled(Model):
    """Two inertias, coupled by signals in three ways: rigidly, by a spring with a damper, by a spring."""

    directInertia, inverseInertia = DirectInertia(tauDrive=SINE), InverseInertia()
    torque2, inertia2a, inertia2b = r.Torque(tau=SINE), resting(1.1), resting(2.2)
    torque3, inertia3a, inertia3b = r.Torque(tau=SINE), resting(1.1), resting(2.2)
    from2a, from2b, from3a, from3b = angle_out(2), angle_out(2), angle_out(1), angle_out(1)
    to2a, to2b, to3a, to3b = angle_in(2), angle_in(2), angle_in(1), angle_in(1)
    springDamper, spring = r.SpringDamper(c=1e4, d=100), r.Spring(c=1e4)

    def connections(self):
        for name in ("phi", "w", "a"):
            yield connect(getattr(self.directInertia, name), getattr(self.inverseInertia, name))
        yield connect(self.inverseInertia.tau, self.directInertia.tau)
        yield chain(self.torque2.flange, self.inertia2a, self.from2a.flange)
        yield chain(self.to2a.flange, self.springDamper, self.to2b.flange)
        yield chain(self.from2b.flange, self.inertia2b)
        yield chain(self.torque3.flange, self.inertia3a, self.from3a.flange)
        yield chain(self.to3a.flange, self.spring, self.to3b.flange)
        yield chain(self.from3b.flange, self.inertia3b)
        for end in ("2a", "2b", "3a", "3b"):
            there, back = getattr(self, f"from{end}"), getattr(self, f"to{end}")
            yield connect(there.phi, back.phi)
            yield connect(back.tau, there.tau)
            if end[0] == "2":
                yield connect(there.w, back.w)


def test_rotational():
    compare("Modelica.Mechanics.Rotational.Examples.GenerationOfFMUs", Coupled())


def at_rest(m):
    return t.Mass(m=m, s=fixed(0), v=fixed(0))


class DirectMass(Component):
    """Motion from force."""

    fDrive: Scalar = input("force that drives", unit="N")
    f: Scalar = input("force of what is driven", unit="N")
    s: Scalar = output("position", unit="m")
    v: Scalar = output("speed", unit="m/s")
    a: Scalar = output("acceleration", unit="m/s2")
    mass, source, adaptor = at_rest(1.1), t.Force(f=fDrive), t.GeneralForceToPositionAdaptor(f=f)

    def connections(self):
        yield chain(self.source.flange, self.mass, self.adaptor.flange)
        yield connect(self.adaptor.p, self.s)
        yield connect(self.adaptor.pder, self.v)
        yield connect(self.adaptor.pder2, self.a)


class InverseMass(Component):
    """Force from motion."""

    s: Scalar = input("position", unit="m")
    v: Scalar = input("speed", unit="m/s")
    a: Scalar = input("acceleration", unit="m/s2")
    f: Scalar = output("force", unit="N")
    mass, adaptor = t.Mass(m=2.2), t.GeneralPositionToForceAdaptor(p=s, pder=v, pder2=a)

    def connections(self):
        yield connect(self.adaptor.flange, self.mass.flange_a)
        yield connect(self.adaptor.f, self.f)


def motion_out(n):
    return t.GeneralForceToPositionAdaptor(use_pder=n > 1, use_pder2=n > 2)


def motion_in(n):
    return t.GeneralPositionToForceAdaptor(use_pder=n > 1, use_pder2=n > 2)


class CoupledMasses(Model):
    """Two masses, coupled by signals in three ways."""

    directMass, inverseMass = DirectMass(fDrive=SINE), InverseMass()
    force2, mass2a, mass2b, springDamper = t.Force(f=SINE), at_rest(1.1), at_rest(2.2), t.SpringDamper(c=1e4, d=100)
    force3, mass3a, mass3b, spring = t.Force(f=SINE), at_rest(1.1), at_rest(2.2), t.Spring(c=1e4)
    from2a, from2b, from3a, from3b = motion_out(2), motion_out(2), motion_out(1), motion_out(1)
    to2a, to2b, to3a, to3b = motion_in(2), motion_in(2), motion_in(1), motion_in(1)

    def connections(self):
        for name in ("s", "v", "a"):
            yield connect(getattr(self.directMass, name), getattr(self.inverseMass, name))
        yield connect(self.inverseMass.f, self.directMass.f)
        yield chain(self.force2.flange, self.mass2a, self.from2a.flange)
        yield chain(self.to2a.flange, self.springDamper, self.to2b.flange)
        yield chain(self.from2b.flange, self.mass2b)
        yield chain(self.force3.flange, self.mass3a, self.from3a.flange)
        yield chain(self.to3a.flange, self.spring, self.to3b.flange)
        yield chain(self.from3b.flange, self.mass3b)
        for end in ("2a", "2b", "3a", "3b"):
            there, back = getattr(self, f"from{end}"), getattr(self, f"to{end}")
            yield connect(there.p, back.p)
            yield connect(back.f, there.f)
            if end[0] == "2":
                yield connect(there.pder, back.pder)


def test_translational():
    compare("Modelica.Mechanics.Translational.Examples.GenerationOfFMUs", CoupledMasses())
