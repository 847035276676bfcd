"""Motion of a free flexible body by single steps in reconfigured inertial frames."""
