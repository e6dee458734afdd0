"""Pictures and tables of a comparison: one module each."""
