"""Solution of a compiled model: consistent initial values, integration, events."""
