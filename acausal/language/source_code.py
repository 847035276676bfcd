"""Analysis of the source code of classes and functions: duplicate names, statements without yield, missing returns."""

from __future__ import annotations

import ast
import linecache
import warnings
from collections import defaultdict
from collections.abc import Iterator, Mapping
from functools import lru_cache
from types import CodeType, FunctionType
from typing import Any
from weakref import WeakSet

from acausal.errors import ConnectError, DeclarationError, user_line
from acausal.garbage import uncollected
from acausal.language.call_arguments import declaration_error

ENGINE = "acausal.language.component"
CONNECTIONS = {"connect", "chain", "branch", "root", "potential_root"}
STATEMENTS = {*CONNECTIONS, "when", "require", "expect", "apart"}
DEFINITIONS = ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef
COMPOUND = (ast.If, ast.For, ast.While, ast.With, ast.Try, ast.TryStar, ast.Match)
_CHECKED: WeakSet[type] = WeakSet()


def refuse_ineffective_code(cls: Any) -> None:
    """Raise DeclarationError for a duplicate name, or a statement that is not yielded, in a class or its bases.

    Parameters
    ----------
    cls : Component class
        Without source code, nothing is checked.
    """
    for base in cls.__mro__:
        if "_line" in vars(base) and base.__module__ != ENGINE and base not in _CHECKED:
            _refuse(base)
            _CHECKED.add(base)


def returns_nothing(function: Any) -> bool:
    """Return whether a function calls something and returns only None; False without source code."""
    code = getattr(function, "__code__", None)
    return code is not None and _lacks_return(code)


def body_line(cls: Any, name: str) -> str:
    """Return file and line of a name in the class body that was just executed, "" if unknown."""
    where = user_line()
    parts = [part for node in _class(cls.__name__, where) for part in _statements(node.body) if name in _bound(part)]
    return f"{where.rpartition(':')[0]}:{parts[0].lineno}" if parts else ""


def body_reads(cls: Any, name: str) -> bool:
    """Return whether the body of a class, which may be in execution, reads a name; False without source code."""
    return any(_reads(node.body, name) for node in _class(cls.__name__, vars(cls).get("_line") or user_line()))


def may_read(code: CodeType, name: str) -> bool:
    """Return whether a function may read an attribute, also by getattr(self, "name"); True without source code."""
    nodes = _function(code)
    return not nodes or any(
        (isinstance(n, ast.Attribute) and n.attr == name and not isinstance(n.ctx, ast.Store))
        or (isinstance(n, ast.AugAssign) and getattr(n.target, "attr", "") == name)
        or (isinstance(n, ast.Constant) and n.value == name)
        for node in nodes
        for n in ast.walk(node)
    )


def calls(function: Any, *words: str) -> str:
    """Return the first of some statements that a function calls, "" if none or without source code."""
    nodes = _function(function.__code__) if hasattr(function, "__code__") else []
    called = {_statement(n) for node in nodes for n in ast.walk(node) if isinstance(n, ast.Call)}
    return next((word for word in words if word in called), "")


def _refuse(cls: Any) -> None:
    name, file = cls.__name__, cls._line.rpartition(":")[0]
    bodies = _class(name, cls._line)
    for again, first, second in (slip for body in bodies for slip in _duplicates(body.body)):
        raise declaration_error(
            f"{name}.{again} is defined twice in the class body, and only the last definition counts; the first is in "
            f"line {first}. Rename or remove one of them.",
            f"{file}:{second}",
        )
    codes = [value.__code__ for value in vars(cls).values() if isinstance(value, FunctionType)]
    methods = [(code.co_filename, node) for code in codes for node in _function(code)]
    for path, node in [*((file, body) for body in bodies), *methods]:
        for part in _statements(node.body) if not isinstance(node, ast.Lambda) else ():
            if what := _not_yielded(part):
                remedy = "Yield it in equations()." if isinstance(node, ast.ClassDef) else "Write `yield` before it."
                kind = ConnectError if what.partition("(")[0] in CONNECTIONS else DeclarationError
                text = f"{name}: {what} has no effect, as it is not yielded. {remedy}"
                raise declaration_error(text, f"{path}:{part.lineno}", kind)


def _class(name: str, where: str) -> list[Any]:
    """Return the syntax trees of a class whose definition begins at a line."""
    file, _, line = where.rpartition(":")
    return _definitions(file).get((name, int(line)), [])


def _function(code: CodeType) -> list[Any]:
    """Return the syntax trees of a function; several lambdas may begin in one line."""
    return _definitions(code.co_filename).get((code.co_name, code.co_firstlineno), [])


def _definitions(file: str) -> Mapping[tuple[str, int], list[Any]]:
    """Return the classes and functions of a file by name and first line; none without source code."""
    linecache.checkcache(file)
    return _definitions_in("".join(linecache.getlines(file)))


@lru_cache(maxsize=16)
def _definitions_in(text: str) -> Mapping[tuple[str, int], list[Any]]:
    found = defaultdict[tuple[str, int], list[Any]](list)
    try:
        with uncollected(), warnings.catch_warnings():
            warnings.simplefilter("ignore")  # Python already gave its warnings when it compiled the file
            tree = ast.parse(text)
        for node in ast.walk(tree):
            if isinstance(node, DEFINITIONS | ast.Lambda):
                # The first line of a function is that of its first decorator; that of a class is either one.
                for line in {first.lineno for first in (node, *getattr(node, "decorator_list", ()))}:
                    found[getattr(node, "name", "<lambda>"), line].append(node)
    except (SyntaxError, ValueError):
        return {}
    return dict(found)


def _statements(block: list[ast.stmt]) -> Iterator[ast.stmt]:
    """Yield the statements of a block and of the blocks in it, without those of the definitions in it."""
    for node in block:
        yield node
        for inner in _blocks(node):
            yield from _statements(inner)


def _blocks(node: Any) -> list[list[ast.stmt]]:
    """Return the blocks of a compound statement, none for a definition or a simple statement."""
    if not isinstance(node, COMPOUND):
        return []
    cases = [*getattr(node, "handlers", []), *getattr(node, "cases", [])]
    own = [getattr(node, name, []) for name in ("body", "orelse", "finalbody")]
    return [*own, *(case.body for case in cases)]


def _not_yielded(node: ast.stmt) -> str:
    """Return the text of an equation or statement that is not yielded, "" for other Python statements."""
    made = node.value if isinstance(node, ast.Expr) else None
    if isinstance(made, ast.Compare) and any(isinstance(op, ast.Eq) for op in made.ops):
        return "this equation, `... == ...`,"
    name = _statement(made) if isinstance(made, ast.Call) else ""
    return f"{name}(...)" if name in STATEMENTS else ""


def _statement(call: ast.Call) -> str:
    """Return the name of the called function, without the package."""
    return ast.unparse(call.func).removeprefix("acausal.").removeprefix("ac.")


@lru_cache(maxsize=256)
def _lacks_return(code: CodeType) -> bool:
    """Return whether a function calls something and returns only None."""
    inside = [part for node in _function(code) if not isinstance(node, ast.Lambda) for part in _statements(node.body)]
    returned = [node.value for node in inside if isinstance(node, ast.Return) and node.value]
    made = any(isinstance(node, ast.Expr | ast.Assign) and isinstance(node.value, ast.Call) for node in inside)
    return made and all(isinstance(value, ast.Constant) and value.value is None for value in returned)


def _duplicates(block: list[ast.stmt]) -> Iterator[tuple[str, int, int]]:
    """Yield names that a block of a class body rebinds without reading them, with both lines; branches are separate."""
    bound: dict[str, ast.stmt] = {}
    for node in block:
        blocks = _blocks(node)
        for inner in blocks:
            yield from _duplicates(inner)
        if blocks:
            bound.clear()
        for name in _bound(node):
            first = bound.get(name)
            if first and name.strip("_") and not _reads(block[block.index(first) + 1 : block.index(node) + 1], name):
                yield name, first.lineno, node.lineno
            bound[name] = node


def _bound(node: ast.stmt) -> list[str]:
    """Return the names that a simple statement or a definition binds."""
    if isinstance(node, DEFINITIONS):
        return [] if any(ast.unparse(mark).endswith("overload") for mark in node.decorator_list) else [node.name]
    targets = node.targets if isinstance(node, ast.Assign) else []
    if isinstance(node, ast.AnnAssign) and node.value:
        targets = [node.target]
    return [n.id for t in targets for n in ast.walk(t) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)]


def _reads(block: list[ast.stmt], name: str) -> bool:
    """Return whether statements of a class body read a name; bodies of definitions do not see it."""
    roots: list[ast.AST] = []
    for node in block:
        is_definition = isinstance(node, DEFINITIONS)
        roots += [n for n in ast.iter_child_nodes(node) if not isinstance(n, ast.stmt)] if is_definition else [node]
    names = [n for root in roots for n in ast.walk(root) if isinstance(n, ast.Name) and n.id == name]
    return any(not isinstance(n.ctx, ast.Store) for n in names)
