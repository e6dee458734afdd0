"""Slow references in plain numpy and mpmath, which share no code with the package they are to check."""
