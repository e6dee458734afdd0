"""Stipplings on paper: dots in millimetres as SVG, PDF, EPS, PNG and G-code."""
