"""Power spectra of point sets: requests, plans, periodograms and shells."""
