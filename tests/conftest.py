"""Interrupts that are heard however tests are started, and the option that runs them with another method."""

from __future__ import annotations

import signal

import pytest

from acausal.solve import run


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--method", choices=("idas", "rosenbrock"), help="what runs take where they may take any method")


def pytest_configure(config: pytest.Config) -> None:
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:  # so it is for what a shell starts in the background
        signal.signal(signal.SIGINT, signal.default_int_handler)
    if method := config.getoption("--method"):
        chosen = run.chosen

        def given(asked: str, max_order: int | None = None) -> tuple[str, ...]:
            return chosen(method if asked == "auto" and max_order is None else asked, max_order)

        run.chosen = given
