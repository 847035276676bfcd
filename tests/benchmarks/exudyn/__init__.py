"""Machines in a plane and in space compared with Exudyn, which is optional: pip install ".[benchmark]"."""
