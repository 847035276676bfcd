"""The scenes spin-up, pendulum and slider-crank next to Exudyn, which is optional: pip install ".[benchmark]"."""
