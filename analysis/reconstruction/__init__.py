"""A density found back from points: Algorithm 2 and kernels summed, and estimates to compare it with."""
