"""Figures and tables of a comparison, one module for each kind."""
