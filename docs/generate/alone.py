"""A component by itself, for its example and the equations of its class."""

from __future__ import annotations

import inspect
from typing import Any

import casadi as ca

import acausal as ac
import components
from acausal.compiler.equations.written import written_equations
from acausal.flatten.collected_statements import collect_statements
from acausal.language.fields import MISSING, Parameter, Structural
from components import fe
from components.table import Entry
from generate.examples import ARGUMENTS, ORDINARY

MOST = 6  # frames of a component


class Alone(ac.Model):
    """A component with a free body at each of its frames, so that their motions are independent."""

    world = components.World()
    bodies = ac.parts(lambda self: [components.Body(m=1) for _ in range(MOST)])

    def connections(self) -> Any:
        """Connect the frames of the component."""
        frames = [port for port in vars(self.it).values() if isinstance(port, components.Frame)]
        yield from (ac.connect(body.frame_a, frame) for body, frame in zip(self.bodies, frames, strict=False))


def arguments(entry: Entry) -> str:
    """Return arguments of a component as source text: what it requires."""
    if entry.name in ARGUMENTS:
        return ARGUMENTS[entry.name]
    required = {
        name: field
        for name, field in entry.cls.fields.items()
        if isinstance(field, Parameter | Structural) and field.default is MISSING
    }
    return ", ".join(f"{name}={ORDINARY[tuple(field.shape or ())]}" for name, field in required.items())


def equations(entry: Entry) -> Any:
    """Return the equations that the class of a component states."""
    given = arguments(entry)
    names = {"ac": ac, "ca": ca, "cls": entry.cls, **({"body": rod()} if given == "reduced=body" else {})}
    part = eval(f"cls({given})", names)
    own = {"world": None} if entry.cls is components.World else {}
    model = type(entry.cls.__name__, (Alone,), {"it": part} | own)
    return written_equations(collect_statements(model(), {}), "it")


def rod() -> Any:
    """A small body from finite elements."""
    M, K, nodes = fe.box((0.5, 0.04, 0.03), (4, 1, 1), "hex8", E=6e7, nu=0.3, rho=1000.0)
    return fe.reduce_body(M, K, nodes, frames={"root": [0, 1, 2, 3]}, hold="root", modes=2)


def file_of(entry: Entry) -> str:
    """Return the file of a component, from the top of the project."""
    return inspect.getfile(entry.cls).replace("\\", "/").rpartition("/components/")[2]
