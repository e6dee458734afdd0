"""Experiments kept in the checkout: each a script that writes one table under benchmarks/results."""
