"""The quantitative claims of Ahmed, Ren & Wonka (2022), each measured by a small function."""
