"""The doctor: checks of the OpenCL kernels on the user's own device, and the trust that follows."""
