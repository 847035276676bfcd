"""The option that runs tests with another method of integration."""

from __future__ import annotations

import pytest

from acausal.solve import run


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--method", choices=("idas", "rosenbrock"), help="what runs take where they may take any method")


def pytest_configure(config: pytest.Config) -> None:
    if method := config.getoption("--method"):
        chosen = run.chosen

        def given(asked: str, max_order: int | None = None) -> tuple[str, ...]:
            return chosen(method if asked == "auto" and max_order is None else asked, max_order)

        run.chosen = given
