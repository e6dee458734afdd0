"""The gridded FFT: points are carried to a real grid by a window on every axis, and the grid is transformed."""
