"""Folders and files of the user that hide the packages `components` and `models`."""

from __future__ import annotations

import sys
from importlib.util import find_spec
from pathlib import Path

HOME = Path(__file__).parent.parent
NAMES = ("components", "models")


def shadowed() -> str:
    """Name what hides `components` or `models` where Python looks for packages, and the remedy; "" if nothing does."""
    for name in NAMES:
        own = HOME / name / "__init__.py"
        found = _file(name)
        if found and own.is_file() and Path(found).resolve() != own.resolve():
            path = Path(found)
            what = f"folder {path.parent}" if path.name == "__init__.py" else f"file {path}"
            return (
                f"the {what} hides the package `{name}` of acausal, so that what is imported from `{name}` comes from there. "
                "Rename it, or start Python in another folder."
            )
    return ""


def _file(name: str) -> str:
    """The file of a module that is loaded, or would be."""
    if name in sys.modules:
        return getattr(sys.modules[name], "__file__", None) or ""
    try:
        spec = find_spec(name)
    except (ImportError, ValueError):
        return ""
    return (spec.origin or "") if spec else ""
