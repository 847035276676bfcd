"""The scenes spin-up, pendulum and slider-crank compared with Exudyn, which is optional: pip install ".[benchmark]"."""
