"""Errors found in the source code of a class when it is built, and valid code that resembles them."""

from __future__ import annotations

import linecache
from pathlib import Path

import pytest

import acausal as ac
from acausal.language.source_code import returns_nothing

HEAD = """
from typing import overload
import acausal as ac
from acausal import Model, Scalar, chain, connect, der, output, part, require
from components import Revolute, World
from components.rotational import Inertia

class M(Model):
    x: Scalar = output("x")

    def equations(self):
        yield der(self.x) == -self.x
"""


def built(text, known=True):
    """Execute a class with lines of a body more, and compile it."""
    lines = HEAD + "\n" + "\n".join(f"    {line}" for line in text.strip("\n").split("\n")) + "\n"
    name = f"source_of_{abs(hash(text))}.py"
    space = {"__name__": "somewhere"}
    if known:
        linecache.cache[name] = (len(lines), None, lines.splitlines(True), name)
    try:
        exec(compile(lines, name, "exec"), space)
        return ac.compile(space["M"]())
    finally:
        linecache.cache.pop(name, None)


FIRST = HEAD.count("\n") + 2


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        ("def more(self):\n    1 == self.x", 1, "M: this equation, `... == ...`, has no effect.* Write `yield`"),
        ("def more(self):\n    for k in range(2):\n        if k:\n            require(k)", 3, r"M: require\(\.\.\.\)"),
        ("def more(self):\n    try:\n        pass\n    except ValueError:\n        ac.when(1)", 4, r"when\(\.\.\.\)"),
        ("def more(self):\n    match 1:\n        case 1:\n            connect(\n 1, 2)", 3, r"connect\(\.\.\.\)"),
        ("@staticmethod\ndef one(): pass\nconnect == 3", 2, r"no effect.* Yield it in equations\(\)"),
        ("a = 1\nb = 2\na = 3", 2, f"M.a is defined twice .* is in line {FIRST}"),
        ("def a(self): return a\ndef a(self): return 2", 1, "M.a is defined twice"),
        ("if True:\n    a = 1\n    a = 2", 2, "M.a is defined twice"),
        ("a = [k for k in range(3)]\nb, (a, c) = 1, (2, 3)", 1, "M.a is defined twice"),
    ],
)
def test_what_is_refused(text, line, message):
    with pytest.raises(ac.AcausalError, match=rf"\.py:{FIRST + line}: .*{message}"):
        built(text)
    built(text, known=False)  # without its text nothing is known


@pytest.mark.parametrize(
    "text",
    [
        "@property\ndef a(self): return 1\n@a.setter\ndef a(self, value): pass",
        "@overload\ndef a(self, k: int): ...\n@overload\ndef a(self, k: str): ...\ndef a(self, k): return k",
        "a = 1\nif a:\n    a = 2\nelse:\n    a = 3\na = 4",
        "try:\n    a = 1\nexcept ValueError:\n    a = 2",
        "_ = 1\n_ = 2",
        "a = 1\nb = a + 1\na = 2",
        "a = 1\na = a + 1",
        "a = {}\na['k'] = 1\na = 2",
        "a: int\na = 1",
        "b = [k for k in range(2)]\nc = [k for k in range(2)]",
        "def more(self):\n    a = self.x == 1\n    self.connect(1)\n    return a",
        "@part\ndef none(self):\n    return None",
        "@part\ndef none(self):\n    pass",
        "@part\ndef none(self):\n    if self is None:\n        return Inertia(J=1)",
    ],
)
def test_what_is_meant(text):
    built(text)


@pytest.mark.parametrize(
    "body", ["Inertia(J=1)", "wheel = Inertia(J=1)", "if self:\n        Inertia(J=1)\n    return None"]
)
def test_a_part_that_is_not_returned(body):
    with pytest.raises(ac.DeclarationError, match="this method returns nothing; write `return`"):
        built(f"@part\ndef wheel(self):\n    {body}")


def test_decorated_classes_and_their_bases_are_found(tmp_path: Path):
    file = tmp_path / "decorated.py"
    text = HEAD.replace("class M(Model):", "@(lambda c: c)\nclass M(\n    Model,\n):")
    file.write_text(text + "\n    a = 1\n    a = 2\n\nclass N(M):\n    pass\n")
    space = {"__name__": "decorated"}
    exec(compile(file.read_text(), str(file), "exec"), space)
    with pytest.raises(ac.DeclarationError, match=r"M\.a is defined twice"):
        ac.compile(space["N"]())


def test_what_has_no_text_returns_something():
    assert not returns_nothing(print)
    assert not returns_nothing(lambda: print())


def test_a_name_that_resembles_a_setting_is_refused_only_where_the_text_shows_that_nothing_reads_it():
    with pytest.raises(ac.DeclarationError, match=r"\.py:\d+: M.stop_tme is new, .* did you mean `stop_time`"):
        built("stop_tme = 3")
    built("stop_tme = 3", known=False)
    built("stop_tme = 3\ndef more(self): return self.stop_tme")
    built("stop_tme = 3\ndef more(self): self.stop_tme += 1")


@pytest.mark.parametrize(("known", "line"), [(True, FIRST + 1), (False, HEAD[: HEAD.index("class")].count("\n") + 1)])
def test_a_reserved_name_is_located_as_well_as_the_text_allows(known, line):
    with pytest.raises(ac.DeclarationError, match=rf"\.py:{line}: M.check: "):
        built("a = 1\ncheck = 3", known)


def test_connections_in_equations_without_a_text_leave_the_first_error():
    text = "world = World()\nhinge = Revolute()\ndef equations(self):\n    yield chain(self.world, self.hinge)"
    with pytest.raises(ac.ConnectError, match="neither to a root"):
        built(text, known=False)
