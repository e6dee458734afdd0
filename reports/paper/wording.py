"""Words of the captions of several figures: lists, counts of sets, numbers, sets that were not given."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence

from gbnbench.reports.paper import gallery_requests
from gbnbench.reports.paper.figure import FigureOptions
from gbnbench.reports.paper.method_columns import Column
from gbnbench.reports.paper.method_styles import NAMES


def missing_sets_note(options: FigureOptions, methods: Iterable[str], whose: str = "of the paper") -> str:
    """Name the methods without sets and generator in a sentence for the caption.

    Parameters
    ----------
    options : FigureOptions
        Scale, sets of the user and seed.
    methods : iterable of str
        Methods that the figure could show.
    whose : str
        Words after their names.

    Returns
    -------
    str
        The sentence, empty where all are shown.
    """
    names = [name for name in methods if name not in gallery_requests.methods_shown(options, [name])]
    if not names:
        return ""
    verb, them = ("is", "it") if len(names) == 1 else ("are", "them")
    return (
        f"{listed([NAMES[name] for name in names])} {whose} {verb} left out: no generator here makes {them} "
        f"and no sets were given (--sets {names[0]}=PATH)."
    )


def listed(words: Sequence[str]) -> str:
    """Join words as in a sentence, such as ``a, b and c``."""
    return " and ".join(filter(None, [", ".join(words[:-1]), *words[-1:]]))


def counted(columns: Sequence[Column]) -> str:
    """Say how many sets of how many points are shown: ``16 sets of 1,024 points (BNOT: 4 of 1,024)``."""
    counts = Counter((one.source.n, one.source.realizations) for one in columns)
    most = counts.most_common(1)[0][0]
    usual = next(one.source for one in columns if (one.source.n, one.source.realizations) == most)
    text = f"{_sets(usual.realizations)} of {usual.n:,} points"
    odd = [
        f"{one.title}: {one.source.realizations:,} of {one.source.n:,}"
        for one in columns
        if (one.source.n, one.source.realizations) != (usual.n, usual.realizations)
    ]
    return text + (f" ({'; '.join(odd)})" if odd else "")


def _sets(count: int) -> str:
    return f"{count:,} set{'' if count == 1 else 's'}"


def rounded(value: float) -> str:
    """Format a number for a caption with two digits, such as 1.2e-09 or 0.31."""
    return f"{value:.1e}" if value and not 0.01 <= abs(value) < 1000 else f"{value:.2g}"
