"""Joint assemblies: chains of joints and massless rods as one part."""

from components.assemblies.joint_rrp import JointRRP
from components.assemblies.joint_rrr import JointRRR
from components.assemblies.joint_ssp import JointSSP
from components.assemblies.joint_ssr import JointSSR
from components.assemblies.joint_ups import JointUPS
from components.assemblies.joint_usp import JointUSP
from components.assemblies.joint_usr import JointUSR
from components.assemblies.prismatic_end import PrismaticEnd
from components.assemblies.revolute_end import RevoluteEnd

__all__ = [
    "JointRRP",
    "JointRRR",
    "JointSSP",
    "JointSSR",
    "JointUPS",
    "JointUSP",
    "JointUSR",
    "PrismaticEnd",
    "RevoluteEnd",
]
