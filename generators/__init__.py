"""Generators of point sets on the unit torus: one file a generator, one protocol, one registry."""
