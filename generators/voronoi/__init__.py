"""Generators that move points by their toroidal Voronoi cells."""
