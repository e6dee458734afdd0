"""Regular lattices on the torus."""
