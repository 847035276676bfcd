"""Results of a run: values of any expression along it, and runs that were computed by other means."""
