"""Published figures of sets made by kernels placed on the points: void-and-cluster, kernel density model."""

from __future__ import annotations

from gbnbench.verification.published_figure import SETS, PublishedFigure

MASKS = "measured on free void-and-cluster masks of 64 and 128 pixels squared, thresholded"
PAPER = "Ahmed, Ren & Wonka, Gaussian Blue Noise, 2022, Fig. 1(g) and Sec. 3.2"
KDM = "measured on ten sets of some 1,012 points by the author's program"
WIDER = "a tenth: some hundred frequencies a set; the masks are of sigma 1.9, 1.5 gives a third more"

KERNEL_BASED = (
    PublishedFigure(
        "voidcluster[sigma=1.9]", "noise_floor", "4e-2", 3.6e-2, 4.4e-2, WIDER, MASKS, kind=SETS, sets=16
    ),
    PublishedFigure(
        "voidcluster[sigma=1.9,share=0.125]", "noise_floor", "2.3e-2", 2.07e-2, 2.53e-2, WIDER,
        MASKS, kind=SETS,
        n=2048, sets=8,
    ),
    PublishedFigure(
        "voidcluster[sigma=1.9,share=0.25]", "noise_floor", "1.5e-2", 1.35e-2, 1.65e-2, WIDER,
        MASKS, kind=SETS,
        n=4096, sets=8,
    ),
    PublishedFigure(
        "voidcluster", "profile_c", "that of FPO, 4.9", 4.2, 5.6, "15%: read off a plot of 4,096 points",
        PAPER, sets=20,
    ),
    PublishedFigure(
        "kdm", "noise_floor", "2.9e-3", 2.3e-3, 3.5e-3, "a fifth: some hundred frequencies a set",
        KDM, kind=SETS,
        n=1012, sets=8,
    ),
    PublishedFigure(
        "kdm", "power_at_1", "5e-3", 2e-3, 9e-3, "two independent frequencies a set, exponential each",
        KDM, kind=SETS,
        n=1012, sets=8,
    ),
)  # fmt: skip
