"""Pages of the components: a page for each package, and one for each component."""

from __future__ import annotations

import inspect
from collections import defaultdict
from pathlib import Path

import components
from acausal import Connector
from acausal.compiler.equations import EquationList
from components.table import Entry
from generate.alone import arguments, equations, file_of
from generate.docstrings import entries, sections, table
from generate.symbols import symbol
from generate.used import scenes_with

PACKAGES = {
    "": ("Machines in space", "Worlds, joints, bodies, beams, forces and wheels: frames at their ends."),
    "assemblies": ("Assemblies", "Joints and rods as one part, for loops."),
    "constraints": ("Constraints", "Joints that close a loop without coordinates of their own."),
    "contact": ("Contacts", "Points, spheres and rims on planes, on uneven ground and on each other, with friction."),
    "sensors": ("Sensors", "Positions, velocities, angles, forces and powers of frames."),
    "fe": ("Finite-element bodies", "Bodies from models of finite-element programs."),
    "rotational": ("Rotational drives", "Shafts, gears, brakes, clutches and sources of torque."),
    "translational": ("Translational drives", "Sliding masses, springs, stops and sources of force."),
    "electrical": ("Electrical circuits", "Resistors to motors, with pins at their ends."),
    "thermal": ("Heat", "Capacities, conductors and prescribed temperatures."),
    "blocks": ("Blocks", "Signals: sources, transfer functions, controllers, logic and tables."),
}
OTHER = {"u": "y", "y": "u"}  # what a port is connected to, if not its like
LONG = 1500  # characters of an equation above which a page leaves it out
UNCONNECTED = "is not connected"  # in the origin of a flow that is 0 because the component stands alone
MOST = 40  # equations on a page


def write(folder: Path) -> None:
    """Write the pages of all components into a folder."""
    folder.mkdir(exist_ok=True)
    packages = defaultdict[str, list[Entry]](list)
    for entry in sorted(components.table(), key=lambda entry: entry.name):
        packages[entry.name.rpartition(".")[0]].append(entry)
        _replace(folder / f"{entry.name}.md", page(entry))
    if packages.keys() != PACKAGES.keys():
        raise KeyError(f"packages of components without a title: {packages.keys() ^ PACKAGES.keys()}")
    for package, (title, line) in PACKAGES.items():
        listed = [(f"[{e.name.rpartition('.')[2]}](./{e.name}.md)", e.line) for e in packages[package]]
        text = f"# {title}\n\n{line} In Python: `from components{package and '.' + package} import ...`.\n\n"
        toc = _toctree([e.name for e in packages[package]], "hidden")
        _replace(folder / f"{package or 'multibody'}-index.md", text + table(("component", ""), listed) + "\n\n" + toc)
    count = sum(map(len, packages.values()))
    intro = f"# Components\n\nThe library has {count} components. `acausal show NAME` prints the table of one in a terminal.\n\n"
    rows = [(f"[{title}](./{p or 'multibody'}-index.md)", line) for p, (title, line) in PACKAGES.items()]
    toc = _toctree([f"{package or 'multibody'}-index" for package in PACKAGES], "hidden")
    _replace(folder / "index.md", f"{intro}{table(('package', ''), rows)}\n\n{toc}")


def page(entry: Entry) -> str:
    """Return the page of a component: symbol, description, example, tables and equations."""
    name, texts = entry.name.rpartition(".")[2], dict(sections(inspect.getdoc(entry.cls) or ""))
    more = texts.pop("Notes", "")
    parts = [f"# {name}", texts.pop(""), symbol(name, _ports(entry)), _example(entry, name)]
    parts += [f"## {title}\n\n{_section(body)}" for title, body in texts.items()]
    parts += [_equations(entry), f"## Notes\n\n{more}" if more else ""]
    used = [f"[{scene}](../gallery/{scene}.md)" for scene in scenes_with(entry.cls)]
    parts += [f"## Scenes with it\n\n{', '.join(used)}" if used else "", f"Source: `components/{file_of(entry)}`"]
    return "\n\n".join(part for part in parts if part) + "\n"


def _section(body: str) -> str:
    before, listed = entries(body)
    rows = [(f"`{name}`", kind, description) for name, kind, description in listed]
    return "\n\n".join(part for part in (before, table(("name", "type", "meaning"), rows)) if part)


def _example(entry: Entry, name: str) -> str:
    package = entry.name.rpartition(".")[0]
    given = arguments(entry)
    more = [
        line for word, line in (("ac.", "import acausal as ac\n"), ("ca.", "import casadi as ca\n")) if word in given
    ]
    code = f"{''.join(more)}from components{package and '.' + package} import {name}\n\nit = {name}({given})"
    return f"```python\n{code}\n```\n\n{_connection(entry)}"


def _connection(entry: Entry) -> str:
    """Return how a model connects a component, "" where its ports do not tell."""
    ports = [
        port for port, kind in entry.ports.items() if not kind.endswith("optional") and not kind.startswith("dict")
    ]
    ends = {*getattr(entry.cls, "ends", ())}
    if len(ends) == 2 and ends <= {*ports}:
        statement = "chain(self.before, self.it, self.after)"
    elif ports:
        statement = f"connect(self.it.{ports[0]}, self.other.{OTHER.get(ports[0], ports[0])})"
    else:
        return ""
    return f"In `connections()`: `yield {statement}`."


def _equations(entry: Entry) -> str:
    found = [one for one in equations(entry) if UNCONNECTED not in one.origin]
    rows = [one for one in EquationList(tuple(found), "it").latex_rows() if len(one) < LONG][:MOST]
    if not rows:
        return ""
    left = len(found) - len(rows)
    more = f'\n\n{left} more, mostly long, are printed by `compiled.equations("PART")`.' if left else ""
    formula = "\\begin{aligned}\n" + " \\\\\n".join(rows) + "\n\\end{aligned}"
    return f"## Equations\n\nAs the class states them, at the defaults.\n\n$$\n{formula}\n$${more}"


def _ports(entry: Entry) -> dict[str, tuple[str, str, bool]]:
    domains = {kind.__name__: kind.domain for kind in _below(Connector) if hasattr(kind, "domain")}
    found = {}
    for name, text in entry.ports.items():
        kind, _, optional = text.partition(", ")
        kind = kind.partition(" in ")[0]
        found[name] = (kind, "signal" if kind in ("input", "output") else domains.get(kind, ""), bool(optional))
    return found


def _below(cls: type) -> list[type]:
    return [kind for own in cls.__subclasses__() for kind in (own, *_below(own))]


def _toctree(pages: list[str], option: str) -> str:
    return f"```{{toctree}}\n:{option}:\n\n" + "\n".join(pages) + "\n```\n"


def _replace(path: Path, text: str) -> None:
    """Write a file, unless it holds that text: Sphinx reads changed files only."""
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")
