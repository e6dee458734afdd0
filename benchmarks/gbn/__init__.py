"""Noise floor against time of the optimisers of Gaussian Blue Noise."""
