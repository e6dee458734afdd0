"""Words in figures: labels as matplotlib draws them literally, names of sources, settings of a run."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from gbnbench.core.readable_text import display_width
from gbnbench.core.sides import sides_text
from gbnbench.reports.fonts import has_glyph
from gbnbench.reports.source_groups import Group, groups, members
from gbnbench.runs.comparison_result import Run, SourceResult

NBSP = "\N{NO-BREAK SPACE}"


def shown(text: str, width: int = 26) -> str:
    """Shorten a text and make matplotlib draw it literally, without mathtext.

    Parameters
    ----------
    text : str
        Text from the user, such as a label.
    width : int
        Most characters, of which Chinese, Japanese and Korean ones count as two; a longer text loses some of
        its middle.

    Returns
    -------
    str
        The text with ``$`` escaped, and a box for each sign that no font has.

    Examples
    --------
    >>> shown("gbn[iterations=1000]")
    'gbn[iterations=1000]'
    >>> shown("a" * 40, 9)
    'aaaaa…aaa'
    """
    wide = display_width(text)
    if wide > width:
        width = max(width * len(text) // wide, 3)
        tail = (width - 1) * 2 // 5
        text = f"{text[: width - 1 - tail]}…{text[len(text) - tail :]}"
    text = "".join(c if (c.isprintable() or c == NBSP) and has_glyph(c) else "\N{WHITE SQUARE}" for c in text)
    text = text.replace("$", r"\$")
    return f" {text}" if text.startswith("_") else text  # a legend drops labels that start with _


def name(source: SourceResult, run: Run, width: int = 26) -> str:
    """Return the label of a source for a figure.

    Parameters
    ----------
    source : SourceResult
        Source to name.
    run : Run
        The comparison.
    width : int
        Most characters of the label.

    Returns
    -------
    str
        The label, followed by n and d where they vary in the run, and by the ratio of unequal sides.
    """
    every = groups(run)
    marks = [f"n={source.n}"] if len({n for n, _ in every}) > 1 else []
    marks += [f"d={source.d}"] if len({d for _, d in every}) > 1 else []
    marks += [f"sides {sides_text(source.sides)}"] if source.sides is not None else []
    return shown(source.label, width) + (f" ({', '.join(marks)})" if marks else "")


def _span(values: Sequence[int]) -> str:
    low, high = min(values), max(values)
    return f"{low:,}" if low == high else f"{low:,} to {high:,}"


def settings(run: Run, group: Group | None = None) -> str:
    """Describe the settings of a run in one line for a caption.

    Parameters
    ----------
    run : Run
        The comparison.
    group : (n, d), optional
        Describe only the sources of this size and dimension.

    Returns
    -------
    str
        n, d, realizations, seed, device and version, as far as they are known.
    """
    sources = members(run, group)
    parts = []
    if sources:
        sets = _span([s.realizations for s in sources])
        parts = [f"n = {_span([s.n for s in sources])}", f"d = {_span([s.d for s in sources])}"]
        parts.append(f"{sets} realization{'' if sets == '1' else 's'}")
    if run.manifest.get("seed") is not None:
        parts.append(f"seed {run.manifest['seed']}")
    device = run.manifest.get("device")
    label = device.get("name") if isinstance(device, Mapping) else device
    if label:
        parts.append(str(label).strip())
    if run.manifest.get("version"):
        parts.append(f"gbnbench {run.manifest['version']}")
    return " · ".join(part.replace(" ", NBSP) for part in parts)
