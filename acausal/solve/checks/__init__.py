"""Whether a run was used within what its components and laws promise."""
