"""Generators held against the figures that were published of them."""
