"""A library of ready point sets: its manifest, the places where it may stand, and the check of its files."""
