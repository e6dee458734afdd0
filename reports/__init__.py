"""Figures, tables and the HTML report, each made from a saved run."""
