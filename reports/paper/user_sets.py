"""Check of the user's sets of methods: sets that no figure can show are refused."""

from __future__ import annotations

import dataclasses
import difflib
from collections.abc import Sequence

from gbnbench.core.errors import InputError
from gbnbench.core.sides import as_sides
from gbnbench.generators.registry import GENERATORS
from gbnbench.reports.paper.figure import FigureOptions, PaperFigure
from gbnbench.reports.paper.method_styles import GIVEN
from gbnbench.runs.sources import resolve

CLOSE = 0.7  # likeness of names beyond which one is taken for a slip of the other
ANY_DIMENSION = ("9",)  # figures that show sets of the plane and others


def check_sets(figures: Sequence[PaperFigure], options: FigureOptions) -> None:
    """Refuse sets that no figure would show.

    Parameters
    ----------
    figures : sequence of PaperFigure
        Figures to be made.
    options : FigureOptions
        Settings with the sets.

    Raises
    ------
    InputError
        If a method is one whose sets the figures always make, if its name is close to that of a method of the
        paper, if none of the figures shows the method, if they show it in other dimensions than those of its
        sets, or if its torus has unequal sides.
    """
    for name, path in options.sets.items():
        if name in GENERATORS and name not in GIVEN:
            raise InputError(
                f"--sets {name}: {name} has a generator here, whose sets the figures show; give yours "
                "another name"
            )
        slips = difflib.get_close_matches(name, GIVEN, 1, CLOSE)
        if name not in GIVEN and slips:
            raise InputError(f"--sets {name}: no method is named so; did you mean {slips[0]}?")
        without = dataclasses.replace(options, sets={k: v for k, v in options.sets.items() if k != name})
        shows = [figure.name for figure in figures if figure.needs(options) != figure.needs(without)]
        if not shows:
            asked = ", ".join(figure.name for figure in figures)
            raise InputError(
                f"--sets {name}: figure {asked} shows no sets of it; figures 1, 8 and 9 show any method"
            )
        sources = resolve([path], (1,), (1,), 1, options.reading)[0]
        if any(as_sides(source.sides, source.d) is not None for source in sources):
            raise InputError(
                f"--sets {name}: its box has unequal sides, and the figures show sets of the unit torus; "
                "gbnbench compare measures and draws it"
            )
        found = sorted({source.d for source in sources})
        fits = (2, 3, 8) if set(shows) & set(ANY_DIMENSION) else (2,)
        if not set(found) & set(fits):
            raise InputError(
                f"--sets {name}: its sets are of d={', '.join(map(str, found))}, and figure "
                f"{', '.join(shows)} shows d={', '.join(map(str, fits))}"
            )
