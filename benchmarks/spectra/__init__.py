"""Speed against error of power spectra, beside the rivals that a user could take instead."""
