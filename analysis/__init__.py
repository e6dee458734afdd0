"""Measures of point sets: one file a measure, each with its definition and source."""
