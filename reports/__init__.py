"""Figures, tables and the HTML report, each made from a saved run."""

from gbnbench.reports.plotting_library import import_matplotlib

import_matplotlib()
