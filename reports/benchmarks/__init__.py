"""Pictures of benchmarks, drawn from their saved tables."""
