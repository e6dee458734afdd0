"""Generators of low discrepancy: rank-1 lattices, sequences, nets and optimised Latin hypercubes."""
