"""The gridded FFT: points are carried to a real grid by a window, and the grid is transformed."""
