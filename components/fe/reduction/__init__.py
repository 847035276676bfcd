"""From mass and stiffness matrices to a reduced body, and its file."""
