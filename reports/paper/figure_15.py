"""Figure 15: stipplings of one image by BNOT, KDM and Gaussian blue noise."""

from __future__ import annotations

from gbnbench.reports.paper.stippling_row import stippling_row

FIGURE = stippling_row(
    "15",
    "Stippling of an image",
    "Stippling comparison of the flower test image (Secord 2002) by BNOT, KDM and the paper's method.",
    ("bnot", "kdm"),
)
