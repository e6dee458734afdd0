"""Points as particles whose kernels are to add up to the density."""
