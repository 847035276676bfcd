"""Flexible beams: finite elements in a floating frame, and chains of such frames for large deflections."""

from components.beams.flexible_beam import FlexibleBeam
from components.beams.load import Load
from components.beams.sections import Circle, Rectangle, Section, Tube
from components.beams.substructured_beam import SubstructuredBeam

__all__ = ["Circle", "FlexibleBeam", "Load", "Rectangle", "Section", "SubstructuredBeam", "Tube"]
