"""Execution: a pool of worker processes, and the progress that is shown of their work."""
