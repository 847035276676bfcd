"""Structural analysis of equations: singularity, index reduction, states, block triangular form, tearing."""

from acausal.structure.analyse import analyse
from acausal.structure.block import Block
from acausal.structure.blt import block_triangular
from acausal.structure.completion import Completion, complete
from acausal.structure.coordinate_projection import Constrained, Constraint, Projection
from acausal.structure.dulmage_mendelsohn import DulmageMendelsohn, components, decompose
from acausal.structure.levels import Level, levels
from acausal.structure.plan import Plan
from acausal.structure.singularity import StructuralSingularity, Subsystem
from acausal.structure.system import System

__all__ = [
    "Block",
    "Completion",
    "Constrained",
    "Constraint",
    "DulmageMendelsohn",
    "Level",
    "Plan",
    "Projection",
    "StructuralSingularity",
    "Subsystem",
    "System",
    "analyse",
    "block_triangular",
    "complete",
    "components",
    "decompose",
    "levels",
]
