"""Sections of a beam, and the values of its parameters that follow from them."""

from __future__ import annotations

from typing import Any

from acausal import DeclarationError
from components.beams.sections import Section, SolidSection

EQUIVALENT = "With a Section, which has its own stiffness and mass, the value for an area of 1 m2."


def of_section(beam: Any, name: str) -> Any:
    """Return the default value of a parameter of a beam, None if it must be given."""
    if name == "G":
        section = _general(beam)
        return beam.E / (2 * (1 + beam.nu)) if section is None else section.GJ_t / beam.J_t
    if name == "torsional_inertia":
        return _torsional_inertia(beam)
    if (section := _general(beam)) is not None:
        return _equivalent(beam, section, name)
    if (root := given_at(beam, 0.0)) is not None and name not in ("E", "rho"):
        return getattr(root, "J_z" if name == "J" else name)
    return {"J_y": lambda: beam.J, "J_t": lambda: beam.J + beam.J_y}.get(name, lambda: None)()


def given_at(beam: Any, x: float) -> Any:
    """Return the given section at x / length, None without one.

    Raises
    ------
    DeclarationError
        It is no section.
    """
    given = beam.section
    found = given(x) if callable(given) else given
    if found is not None and not isinstance(found, Section | SolidSection):
        what = f"the function gives {found!r}" if callable(given) else f"not {found!r}"
        raise DeclarationError(
            f"`section` takes a Rectangle, Circle, Tube or Section, or a function of x / length that returns one: {what}."
        )
    return found


def _general(beam: Any) -> Section | None:
    """Return the Section at the root, None for other sections."""
    root = given_at(beam, 0.0)
    return root.with_units() if isinstance(root, Section) else None


def _equivalent(beam: Any, section: Section, name: str) -> Any:
    if name == "A":
        return 1.0
    if name == "J":
        return section.EJ_z / beam.E
    if name == "J_y":
        return section.EJ_y / beam.E
    if name == "J_t":
        return beam.J + beam.J_y
    return section.EA / beam.A if name == "E" else section.mass / beam.A


def _torsional_inertia(beam: Any) -> Any:
    """Moment of inertia about the axis of the beam, by Simpson's rule where the section varies."""
    if not callable(beam.section):
        section = _general(beam)
        polar = beam.rho * (beam.J + beam.J_y) if section is None else section.I_y + section.I_z
        return polar * beam.length
    sections = [section_at(beam, x) for x in (0.0, 0.5, 1.0)]
    return beam.length / 6 * sum(k * (s.I_y + s.I_z) for k, s in zip((1, 4, 1), sections, strict=True))


def section_at(beam: Any, x: float) -> Section:
    """Return the section of a beam at x / length, with expressions."""
    found = given_at(beam, x)
    if callable(beam.section) or isinstance(found, Section):
        return found.section(beam.E, beam.G, beam.rho).with_units()
    E, G, rho = beam.E, beam.G, beam.rho
    factor = 5 / 6 if found is None else found.shear_factor(E / (2 * G) - 1)
    kGA = factor * G * beam.A
    return Section(
        E * beam.A,
        E * beam.J_y,
        E * beam.J,
        G * beam.J_t,
        rho * beam.A,
        rho * beam.J_y,
        rho * beam.J,
        kGA,
        kGA,
        angle=0.0 if found is None else found.angle,
    ).with_units()
