"""Generators that place points directly: random, stratified and low-discrepancy ones."""
