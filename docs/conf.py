"""Sphinx: the site. Built by `python -m sphinx -W docs build/site`, without a network."""

from __future__ import annotations

import logging
import re
import sys
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parent))

project = "acausal"
author = copyright = "the authors of acausal"
extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "generate.mathml",
    "generate.scenes",
    "generate.command_line",
]
myst_enable_extensions = ["dollarmath", "colon_fence"]
myst_heading_anchors = 3
html_theme = "furo"
html_title = "acausal"
html_static_path = ["static"]
html_css_files = ["site.css"]
html_extra_path = ["_generated/extra"]
html_math_renderer = "mathml"
html_copy_source = False
exclude_patterns = ["generate", "_generated/extra"]
default_role = "code"
autodoc_typehints = "none"
napoleon_google_docstring = False


def escape(app: Any, what: str, name: str, obj: Any, options: Any, lines: list[str]) -> None:
    """Escape characters of formulas in a docstring that reStructuredText would read as markup."""
    for k, line in enumerate(lines):
        if line.lstrip().startswith((">>>", "...")):
            continue
        code = line.split("`")
        lines[k] = "`".join(part if n % 2 else re.sub(r"([|*])", r"\\\1", part) for n, part in enumerate(code))


def setup(app: Any) -> None:
    """Write the pages that follow from the code before the first page is read."""
    from generate import components, scenes

    logging.getLogger("skfem").setLevel(logging.WARNING)

    app.connect("autodoc-process-docstring", escape, priority=100)  # before napoleon
    Path(app.srcdir, scenes.FOLDER).mkdir(parents=True, exist_ok=True)
    app.connect("builder-inited", lambda app: components.write(Path(app.srcdir, "components")))
