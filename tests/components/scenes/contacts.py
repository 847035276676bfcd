"""Contacts, each in a scene: a pendulum that turns about all axes strikes what is fixed to the place, and slides on it."""

from __future__ import annotations

from acausal import part, sin
from components import FixedTranslation
from components.contact import PointOnPlane, PointOnProfile, RimOnPlane, SphereOnPlane, SphereOnProfile, SphereOnSphere
from tests.components.scenes.forces import Line

DAMPED = {"dissipation": 0.3, "mu": 0.3, "v_reg": 0.05}


class OnPlane(Line):
    anchor = FixedTranslation(r=(0.5, -0.1, 0.2))


class OnPointOnPlane(OnPlane):
    it = PointOnPlane(k=3e3, n_a=(0.1, 1, -0.2), **DAMPED)


class OnSphereOnPlane(OnPlane):
    it = SphereOnPlane(k=3e5, radius=0.1, n_a=(0.1, 1, -0.2), mu=0.3, v_reg=0.05, e=0.6)


class OnRimOnPlane(OnPlane):
    it = RimOnPlane(k=3e3, radius=0.1, n_b=(1, 0, 0.5), **DAMPED)


class OnPointOnProfile(OnPlane):
    it = PointOnProfile(k=3e3, height=lambda r: 0.03 * sin(8 * r[0]) + 0.1 * r[2] ** 2, **DAMPED)


class OnSphereOnProfile(OnPlane):
    it = SphereOnProfile(k=3e5, radius=0.1, height=lambda r: 0.03 * sin(8 * r[0]) + 0.1 * r[2] ** 2, **DAMPED)


class OnSphereOnSphere(Line):
    """The smaller one on the pendulum, or turned round on the place."""

    anchor = FixedTranslation(r=(0.4, -0.2, 0.2))

    @part
    def it(self):
        radii = (0.1, 0.2) if self.turned else (0.2, 0.1)
        return SphereOnSphere(k=3e5, radius_a=radii[0], radius_b=radii[1], **DAMPED)
