"""Runs: named sources, resumable folders, results on disk, baselines and provenance."""
