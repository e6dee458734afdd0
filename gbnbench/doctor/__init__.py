"""Whether an OpenCL device can be trusted, proved on the user's own machine."""
