from gbnbench.analysis.spectrum.error_model import Errors
def fft_errors(p, grid, n, at): return Errors(1e-15,1e-13)
