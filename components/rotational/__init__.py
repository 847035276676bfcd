"""Drive trains: rotors, torsional springs and dampers, and drives in one-dimensional rotation."""

from components.flange import Flange, TwoFlanges
from components.rotational.clutch import Clutch
from components.rotational.compliant import Compliant
from components.rotational.damper import Damper
from components.rotational.fixed import Fixed
from components.rotational.friction import Friction
from components.rotational.inertia import Inertia
from components.rotational.one_flange import OneFlange
from components.rotational.position import Position
from components.rotational.slipping import Slipping
from components.rotational.speed import Speed
from components.rotational.spring import Spring
from components.rotational.spring_damper import SpringDamper
from components.rotational.torque import Torque

__all__ = [
    "Clutch",
    "Compliant",
    "Damper",
    "Fixed",
    "Flange",
    "Friction",
    "Inertia",
    "OneFlange",
    "Position",
    "Slipping",
    "Speed",
    "Spring",
    "SpringDamper",
    "Torque",
    "TwoFlanges",
]
