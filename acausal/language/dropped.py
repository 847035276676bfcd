"""Statements without `yield`: Python forms them and throws them away."""

from __future__ import annotations

import dis
import re
from collections.abc import Iterable, Iterator
from types import CodeType, FunctionType

from acausal.errors import ConnectError, DeclarationError
from acausal.language.arguments import refused

CONNECTIONS = ("connect", "chain", "branch", "root", "potential_root")
STATEMENTS = (*CONNECTIONS, "when", "require", "expect", "apart")
_COMPARED, _CALLED = (
    re.compile(
        b"(?s)" + re.escape(bytes([dis.opmap[name]])) + b".(?:\x00.)*" + re.escape(bytes([dis.opmap["POP_TOP"]]))
    )
    for name in ("COMPARE_OP", "CALL")
)


def refuse_dropped(kind: str, methods: Iterable[FunctionType | CodeType]) -> None:
    """Raise DeclarationError for an equation or a statement that is formed and not yielded.

    Parameters
    ----------
    kind : str
        Name of the class.
    methods : iterable of function or code
        Its body and its methods.
    """
    for method in methods:
        code = method.__code__ if isinstance(method, FunctionType) else method
        for what, line in _dropped(code):
            inside = "Yield it in equations()." if code.co_name == kind else "Write `yield` before it."
            text = f"{kind}: {what} has no effect, as it is not yielded. {inside}"
            error = ConnectError if what.partition("(")[0] in CONNECTIONS else DeclarationError
            raise refused(text, f"{code.co_filename}:{line}", error)


def _dropped(code: CodeType) -> Iterator[tuple[str, int]]:
    """Yield what is formed in vain, with its line; a quick look decides whether the code is read at all."""
    called = not set(STATEMENTS).isdisjoint(code.co_names) and _CALLED.search(code.co_code)
    if not called and not _COMPARED.search(code.co_code):
        return
    begun: dict[tuple[int | None, int | None], str] = {}
    last = None
    for step in dis.get_instructions(code):
        at = step.positions
        if step.opname in ("LOAD_GLOBAL", "LOAD_NAME") and step.argval in STATEMENTS and at:
            begun[at.lineno, at.col_offset] = step.argval
        if step.opname == "POP_TOP" and last is not None and last.positions:
            start = last.positions.lineno, last.positions.col_offset
            if last.opname == "COMPARE_OP" and "==" in str(last.argval):
                yield "this equation, `... == ...`,", start[0] or 0
            elif last.opname == "CALL" and start in begun:
                yield f"{begun[start]}(...)", start[0] or 0
        last = step
