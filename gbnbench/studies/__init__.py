"""Studies: comparisons of point sets and of stipplings, numerical integration, and stippling itself."""
