"""Measures of the points themselves: distances, neighbours, correlations, discrepancies, zone plates."""
