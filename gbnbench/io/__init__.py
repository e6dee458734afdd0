"""Files: point sets, lists of frequencies and weights, and atomic writes."""
