"""Tests of generators from elsewhere."""
