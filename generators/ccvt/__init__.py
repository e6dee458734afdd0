"""Capacity-constrained Voronoi tessellations of a discrete space (Balzer, Schlömer & Deussen 2009)."""
