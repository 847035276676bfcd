"""Files and folders of the user that shadow the packages `components` and `models`."""

from __future__ import annotations

import sys
from importlib.util import find_spec
from pathlib import Path

HOME = Path(__file__).parent.parent
NAMES = ("components", "models")


def shadowed() -> str:
    """Return a message on the file or folder that shadows `components` or `models`, "" if there is none."""
    for name in NAMES:
        own = HOME / name / "__init__.py"
        found = _file(name)
        if found and own.is_file() and Path(found).resolve() != own.resolve():
            path = Path(found)
            what = f"folder {path.parent}" if path.name == "__init__.py" else f"file {path}"
            return (
                f"the {what} hides the package `{name}` of acausal, so that imports from `{name}` read your file. "
                "Rename it, or start Python in another folder."
            )
    return ""


def _file(name: str) -> str:
    """Return the file of a module, loaded or not; "" if there is none."""
    if name in sys.modules:
        return getattr(sys.modules[name], "__file__", None) or ""
    try:
        spec = find_spec(name)
    except (ImportError, ValueError):
        return ""
    return (spec.origin or "") if spec else ""
