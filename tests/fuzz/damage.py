"""Slips that a user may make in the source text of a machine."""

from __future__ import annotations

import re

from hypothesis import assume
from hypothesis import strategies as st

from tests.fuzz.machines import HEAD, machines

VALUES = (
    *(
        "0",
        "0.0",
        "-1",
        "1e300",
        "1e-300",
        "float('nan')",
        "float('inf')",
        "2j",
        "True",
        "None",
        "'text'",
        "[]",
        "()",
        "{}",
    ),
    *(
        "(1, 2)",
        "(1, 2, 3)",
        "np.zeros((2, 2))",
        "np.eye(3)",
        "np.array(1.0)",
        "time",
        "sin(time)",
        "World()",
        "Revolute",
        "fixed(1)",
    ),
    *(
        "guess(0)",
        "fixed(time)",
        "fixed('text')",
        "fixed((1, 2))",
        "lambda: 1",
        "range(3)",
        "1 / 0",
        "parameter('p')",
        "ac",
        "self",
    ),
    *(
        "time > 1",
        "time == 1",
        "-time**0.5",
        "10**400",
        "1e-12",
        "1e12",
        "b'1'",
        "object()",
        "print",
        "...",
        "int",
        "10**9",
    ),
)
SWAPS = (
    *(
        ("frame_a", "frame_b"),
        ("frame_b", "frame_a"),
        ("flange_a", "flange_b"),
        ("fixed", "guess"),
        ("guess", "fixed"),
        ("self.", ""),
    ),
    *(
        ("yield ", ""),
        ("yield", "return"),
        (" == ", " >= "),
        (" == ", " - "),
        (" == ", " != "),
        ("chain", "connect"),
        ("connect", "chain"),
    ),
    *(
        ("Revolute", "Prismatic"),
        ("Prismatic", "Revolute"),
        ("Spherical", "Revolute"),
        ("Revolute", "Spherical"),
        ("Body", "BodyShape"),
    ),
    *(
        ("BodyShape", "BodyRod"),
        ("Spring", "Damper"),
        ("SpringDamper", "Spring"),
        ("Inertia", "Torque"),
        ("Torque", "Inertia"),
    ),
    *(
        ("rotational.", ""),
        ("FlexibleBeam", "SubstructuredBeam"),
        ("SubstructuredBeam", "FlexibleBeam"),
        ("World(", "Body(m=1, "),
    ),
    *(
        (" = ", ": Scalar = "),
        (": Scalar", ""),
        ("Scalar", "Vector3"),
        ("output", "parameter"),
        ("output", "fixed"),
        ("()", ""),
    ),
    *(
        (", ", " "),
        ("(", "(1, "),
        ("=", "_="),
        ("time", "time()"),
        ("sin", "np.sin"),
        ("use_axis_flange=True, ", ""),
        ("angles_fixed=True, ", ""),
    ),
    *(
        (".frame_a", ""),
        (".frame_b", ""),
        (".flange", ""),
        (".axis", ""),
        (".phi", ".w"),
        (".phi", ".tau"),
        (".phi", ""),
        ("class Machine", "class Machine2"),
    ),
    *(
        ("def connections", "def connection"),
        ("def equations", "def connections"),
        ("def connections", "def equations"),
        ("(Model)", ""),
    ),
)
NUMBER = re.compile(r"(?<![\w.'])-?\d+\.?\d*(?:e-?\d+)?(?![\w'])")
NAME = re.compile(r"[A-Za-z_]{3,}")


def _replaced(draw: st.DrawFn, line: str, pattern: re.Pattern[str], by: st.SearchStrategy[str]) -> str:
    found = list(pattern.finditer(line))
    if not found:
        return line
    one = draw(st.sampled_from(found))
    return line[: one.start()] + draw(by) + line[one.end() :]


@st.composite
def _misspelt(draw: st.DrawFn, line: str) -> str:
    found = list(NAME.finditer(line))
    if not found:
        return line
    one = draw(st.sampled_from(found))
    k = draw(st.integers(one.start(), one.end() - 2))
    return draw(
        st.sampled_from(
            [line[:k] + line[k + 1 :], line[:k] + line[k + 1] + line[k] + line[k + 2 :], line[:k] + "_" + line[k:]]
        )
    )


@st.composite
def damaged(draw: st.DrawFn) -> str:
    """Return the source of a machine with one slip or a few."""
    lines = draw(machines()).removeprefix(HEAD).split("\n")
    for _ in range(draw(st.integers(1, 3))):
        k = draw(st.sampled_from([k for k, line in enumerate(lines) if line.strip()]))
        line, others = lines[k], [line for line in lines if line.strip()]
        match draw(st.sampled_from(["drop", "twice", "value", "value", "swap", "swap", "misspell", "name", "move"])):
            case "drop":
                lines[k] = ""
            case "twice":
                lines.insert(k, line)
            case "value":
                lines[k] = _replaced(draw, line, NUMBER, st.sampled_from(VALUES))
            case "swap":
                fit = [(old, new) for old, new in SWAPS if old in line]
                if fit:
                    old, new = draw(st.sampled_from(fit))
                    lines[k] = line.replace(old, new, draw(st.sampled_from([1, -1])))
            case "misspell":
                lines[k] = draw(_misspelt(line))
            case "name":
                other = NAME.findall(draw(st.sampled_from(others)))
                lines[k] = _replaced(draw, line, NAME, st.sampled_from(other)) if other else line
            case _:
                lines[k] = draw(st.sampled_from(others))
    source = HEAD + "\n".join(lines)
    assume(_compiles(source) and "class Machine(" in source)
    return source


def _compiles(source: str) -> bool:
    """Whether Python takes the text: what it refuses itself is its own concern."""
    try:
        compile(source, "machine.py", "exec")
    except SyntaxError:
        return False
    return True
