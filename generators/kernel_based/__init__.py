"""Generators that spread kernels placed on the points: void-and-cluster, kernel densities, repulsion."""
