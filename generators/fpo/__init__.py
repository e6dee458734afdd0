"""Farthest-point optimisation (Schlömer, Heck & Deussen 2011)."""
