"""Contacts with friction between points, spheres, wheel rims, planes and profiles."""

from components.contact.contact import Contact
from components.contact.point_on_plane import PointOnPlane
from components.contact.point_on_profile import PointOnProfile
from components.contact.rim_on_plane import RimOnPlane
from components.contact.sphere_on_plane import SphereOnPlane
from components.contact.sphere_on_profile import SphereOnProfile
from components.contact.sphere_on_sphere import SphereOnSphere

__all__ = [
    "Contact",
    "PointOnPlane",
    "PointOnProfile",
    "RimOnPlane",
    "SphereOnPlane",
    "SphereOnProfile",
    "SphereOnSphere",
]
