"""A reduced body in a model: its equations, range of validity, shape and nodal results."""
