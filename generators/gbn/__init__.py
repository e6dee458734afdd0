"""Gaussian Blue Noise (Ahmed, Ren & Wonka 2022): its energy, its optimiser and the generator."""
