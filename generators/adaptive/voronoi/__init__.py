"""Stippling by Voronoi cells that are weighted with the density: Secord's method, and Linde-Buzo-Gray's."""
