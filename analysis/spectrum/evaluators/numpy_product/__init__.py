"""The product in plain numpy, for machines without an OpenCL device."""
