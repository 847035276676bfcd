"""Cross-sections of beams."""

from components.beams.sections.circle import Circle
from components.beams.sections.rectangle import Rectangle
from components.beams.sections.section import Section, joined
from components.beams.sections.solid import SolidSection
from components.beams.sections.tube import Tube

__all__ = ["Circle", "Rectangle", "Section", "SolidSection", "Tube", "joined"]
