"""The study of integration: variances of estimates against the number of points."""
