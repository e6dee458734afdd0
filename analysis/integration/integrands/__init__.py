"""Functions with known integrals, to try point sets on."""
