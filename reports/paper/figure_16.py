"""Figure 16: stipplings of an image of stripes by BNOT and Gaussian blue noise."""

from __future__ import annotations

from gbnbench.reports.paper.stippling_row import stippling_row

FIGURE = stippling_row(
    "16",
    "Stippling of stripes",
    "Stippling comparison of the zebra test image (de Goes et al. 2012) by BNOT and the paper's method.",
    ("bnot",),
)
