"""Data flows one way between the folders of FE bodies: matrices, reduction, files, body, motion in reconfigured frames."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.acausal.test_layers import imports

FOLDER = Path(__file__).parents[3] / "components/fe"
ORDER = ("arrays", "nodes", "user_warning", "elements", "reduction", "formats", "body", "reconfigured")


@pytest.mark.parametrize("name", ORDER)
def test_imports_only_earlier_ones(name):
    earlier = set(ORDER[: ORDER.index(name) + 1])
    for path in [*FOLDER.glob(f"{name}.py"), *(FOLDER / name).rglob("*.py")]:
        ours = [module for module in imports(path) if module.startswith("components.fe")]
        used = {f"{module}.".split(".")[2] for module in ours}
        assert used <= earlier, f"{path} imports {used - earlier}"


def test_every_module_has_its_place():
    found = {path.stem for path in FOLDER.iterdir() if not path.stem.startswith("__")}
    assert found == set(ORDER)
