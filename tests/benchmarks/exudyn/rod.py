"""Geometrically exact beams of Exudyn in space.

Nodes have rotation vectors or quaternions. Quaternions have a constraint each: runs of the frame take 1.4 times as long, 2.6
times with the dense linear solver. With rotation vectors the static solver does not converge.
"""

from __future__ import annotations

from itertools import pairwise
from math import cos, sin
from typing import Any

import numpy as np

from components import Section


def rod(
    system: Any,
    section: Section,
    places: np.ndarray,
    angles: np.ndarray,
    length: float,
    quaternions: bool = False,
) -> list[int]:
    """Add a beam and return its nodes.

    Parameters
    ----------
    system : MainSystem
        Of Exudyn.
    section : Section
        With shear stiffnesses, as these elements shear.
    places : array, shape (nodes, 3)
        Where the nodes are.
    angles : array, shape (nodes,)
        By which their sections are turned about z, in rad.
    length : float
        Of an element in m.
    quaternions : bool
        Nodes with quaternions instead of rotation vectors.
    """
    import exudyn as exu
    from exudyn.itemInterface import NodeRigidBodyEP, NodeRigidBodyRotVecLG, ObjectBeamGeometricallyExact

    s, data = section, exu.BeamSection()
    data.massPerLength, data.inertia = s.mass, np.diag([s.I_y + s.I_z, s.I_y, s.I_z])
    data.stiffnessMatrix = np.diag([s.EA, s.kGA_y, s.kGA_z, s.GJ_t, s.EJ_y, s.EJ_z])
    kind = NodeRigidBodyEP if quaternions else NodeRigidBodyRotVecLG
    turned = [[cos(a / 2), 0, 0, sin(a / 2)] if quaternions else [0, 0, a] for a in angles.tolist()]
    nodes = [
        system.AddNode(kind(referenceCoordinates=[*place, *turn]))
        for place, turn in zip(places.tolist(), turned, strict=True)
    ]
    for ends in pairwise(nodes):
        system.AddObject(ObjectBeamGeometricallyExact(nodeNumbers=list(ends), length=length, sectionData=data))
    return nodes


def clamp(system: Any, node: int) -> None:
    """Hold a node."""
    from exudyn.itemInterface import GenericJoint, MarkerBodyRigid, MarkerNodeRigid, ObjectGround

    reference = system.GetNode(node)["referenceCoordinates"][:3]
    ground = system.AddObject(ObjectGround(referencePosition=reference))
    ends = MarkerBodyRigid(bodyNumber=ground), MarkerNodeRigid(nodeNumber=node)
    system.AddObject(GenericJoint(markerNumbers=[system.AddMarker(end) for end in ends]))
