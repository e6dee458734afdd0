"""Power cells that have equal shares of a density, and points at their centroids."""
