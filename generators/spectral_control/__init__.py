"""Generators that are given a spectrum: deep and stealthy blue noise."""
