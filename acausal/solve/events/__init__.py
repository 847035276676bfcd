"""Where the equations of a run change, and what happens there."""
