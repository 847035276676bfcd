"""Layers of imports: data flows one way, and the engine imports no mechanics."""

from __future__ import annotations

import ast
from pathlib import Path

import networkx as nx
import pytest

ROOT = Path(__file__).parents[2]
BASE = {
    "errors",
    "garbage",
    "instructions",
    "locks",
    "nearest",
    "policy",
    "shadowed",
    "signals",
    "symbols",
    "tracebacks",
    "units",
}
MAY = {
    "language": BASE | {"core"},
    "flatten": BASE | {"language", "structure"},
    "structure": {"errors"},
    "reduce": BASE | {"language", "flatten", "structure"},
    "core": BASE,
    "compiler": BASE | {"language", "flatten", "structure", "reduce", "core"},
    "animation": BASE | {"language"},
    "result": BASE | {"language", "flatten", "animation"},
    "solve": BASE | {"language", "flatten", "structure", "reduce", "core", "compiler", "result"},
    "simulation": BASE | {"language", "flatten", "compiler", "result", "solve"},
    "export": BASE
    | {"language", "flatten", "structure", "reduce", "core", "compiler", "result", "solve", "simulation"},
    "study": BASE | {"language", "flatten", "compiler", "result", "simulation"},
    "cli": BASE | {"", "language", "flatten", "reduce", "compiler", "result", "solve", "simulation", "study", "export"},
}
ROOMS = {"measuring": {"measuring"}, "studies": {"measuring", "studies"}, "effects": {"measuring", "effects"}}
SOLVE = (
    "point",
    "sparse_blocks",
    "coordinate_scaling",
    "problem",
    "looks",
    "diagnosis",
    "initialization",
    "diagnosis.conflicts",
    "initialization.initialize",
    "initialization.initial_modes",
    "integrate",
    "events",
    "results",
    "checks",
    "diagnosis.failure",
    "initialization.initial_events",
    "initialization.initial_point",
    "run",
)
# Files that may import a package which is installed with an extra, and only there.
EXTRAS = {
    "components/gradient.py": {"casadi"},
    "components/blocks/casadi_function.py": {"casadi"},
    "components/fmu/interface.py": {"fmpy"},
    "models/signals/crane.py": {"numpy", "scipy"},
    "models/signals/quarter_car.py": {"numpy"},
    "components/fmu/instance.py": {"fmpy"},
    "components/fe/elements/quadratic.py": {"skfem"},
    "components/fe/formats/ansys_process.py": {"ansys"},
    "components/fe/body/recovery.py": {"meshio"},
    "components/fe/__main__.py": {"typer"},
}
# Files of components that read and write files, or are a command, as the engine does.
FILES = {"acausal.result", "acausal.result.files"}
INSIDE = {
    "components/blocks/fixed_delay.py": {"acausal.language.history"},
    "components/fmu/signals.py": {"acausal.units"},
    "components/fmu/exchange_events.py": {"acausal.core.externals", "acausal.core.library"},
    "components/fmu/exchange_function.py": {"acausal.core.externals", "acausal.core.library"},
    "components/fe/reduction/archive.py": FILES,
    "components/fe/formats/third_party.py": FILES,
    "components/fe/formats/readers.py": FILES,
    "components/fe/formats/matrix_market.py": FILES,
    "components/fe/formats/sid.py": FILES,
    "components/fe/formats/text.py": FILES,
    "components/fe/body/recovery.py": FILES,
    "components/fe/__main__.py": FILES
    | {
        "acausal.cli.common",
        "acausal.cli.output",
        "acausal.cli.progress",
        "acausal.cli.streams",
        "acausal.cli.option_values",
    },
}
OUTSIDE_STRUCTURE = {"numpy", "scipy", "networkx"}


def imports(path: Path) -> set[str]:
    names = set()
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            names.add(node.module or "")
    return names


def import_graph() -> nx.DiGraph:
    """Our modules and what they import of ours, wherever the statement stands."""
    paths = {}
    for path in (p for folder in ("acausal", "components", "models") for p in (ROOT / folder).rglob("*.py")):
        parts = path.relative_to(ROOT).with_suffix("").parts
        paths[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    graph = nx.DiGraph()
    graph.add_nodes_from(paths)
    for module, path in paths.items():
        for node in ast.walk(ast.parse(path.read_text())):
            names = [alias.name for alias in node.names] if isinstance(node, ast.Import | ast.ImportFrom) else []
            if isinstance(node, ast.ImportFrom):
                names = [n if (n := f"{node.module}.{name}") in paths else node.module for name in names]
            graph.add_edges_from((module, name) for name in names if name in paths)
    return graph


def test_no_import_circles() -> None:
    graph = import_graph()
    assert nx.is_directed_acyclic_graph(graph), nx.find_cycle(graph)


@pytest.mark.parametrize("package", MAY)
def test_stage_imports_only_earlier_ones(package: str) -> None:
    for path in (ROOT / "acausal" / package).rglob("*.py"):
        for name in imports(path):
            top, _, rest = name.partition(".")
            if top == "acausal":
                assert rest.split(".")[0] in MAY[package] | {package}, f"{path} imports {name}"
            assert top not in ("components", "models"), f"{path} imports {name}"


@pytest.mark.parametrize("room", ROOMS)
def test_rooms_of_studies(room: str) -> None:
    for path in (ROOT / "acausal/study" / room).rglob("*.py"):
        used = {name.split(".")[2] for name in imports(path) if name.startswith("acausal.study.")}
        assert used <= ROOMS[room], f"{path} imports {used - ROOMS[room]}"


def place(module: str) -> int:
    """Position of a module of solve in the order: its own if it is listed, else that of its folder."""
    return SOLVE.index(module if module in SOLVE else module.split(".")[0])


def test_modules_of_solve_import_earlier_ones() -> None:
    folder = ROOT / "acausal/solve"
    modules = {".".join(path.relative_to(folder).with_suffix("").parts): path for path in folder.rglob("[a-z]*.py")}
    assert set(SOLVE) <= {*modules, *(module.split(".")[0] for module in modules)}
    for module, path in modules.items():
        used = {name.removeprefix("acausal.solve.") for name in imports(path) if name.startswith("acausal.solve.")}
        assert all(place(name) <= place(module) for name in used), f"{path} imports {used}"


def test_structure_sees_integers_only() -> None:
    for path in (ROOT / "acausal/structure").rglob("*.py"):
        ours = {n for n in imports(path) if n.split(".")[0] in ("casadi", "sympy", "components", "models")}
        assert not ours, f"{path} imports {ours}"


@pytest.mark.parametrize(
    ("folder", "allowed"),
    [
        ("components", {"acausal", "components", "numpy", "scipy"}),
        ("models", {"acausal", "components", "models"}),
    ],
)
def test_libraries_use_public_names_only(folder: str, allowed: set[str]) -> None:
    import sys

    for path in (ROOT / folder).rglob("*.py"):
        file = path.relative_to(ROOT).as_posix()
        extras, inside = EXTRAS.get(file, set()), INSIDE.get(file, set()) | {"acausal"}
        for name in imports(path):
            top = name.split(".")[0]
            assert top in allowed | extras or top in sys.stdlib_module_names, f"{path} imports {name}"
            assert top != "acausal" or name in inside, f"{path} imports {name}"


def test_files_are_short() -> None:
    long = [
        str(path.relative_to(ROOT))
        for folder, most in (("acausal", 300), ("components", 300), ("models", 60))
        for path in (ROOT / folder).rglob("*.py")
        if path.read_text().count("\n") > most
    ]
    assert not long
