"""Fonts within PDF files: what of each is embedded, cut from a small part of the font where that suffices."""

from __future__ import annotations

import contextlib
import io
from collections.abc import Callable, Iterable, Iterator
from functools import lru_cache
from typing import Any, NamedTuple

from matplotlib.font_manager import get_font

LAYOUT_TABLES = ("GDEF", "GPOS", "GSUB", "MATH", "kern")
USUAL = (*range(32, 127), *range(160, 256))  # ASCII and Latin-1
SIGNS = "".join(map(chr, USUAL)) + "–−→↑…≤≥∞▲▼ﬁﬂαενπρσ⁰⁴⁵⁶⁷⁸⁹⁻"


class Part(NamedTuple):
    """A font cut down to ``SIGNS``.

    Attributes
    ----------
    content : bytes
        Its file.
    indices : dict of int
        Index of each of its glyphs, by the index that the glyph has in the whole font.
    """

    content: bytes
    indices: dict[int, int]


@contextlib.contextmanager
def lean_fonts() -> Iterator[None]:
    """Let a PDF take its fonts without their tables of layout, and from their part with the usual signs.

    Texts are laid out when they are drawn: the file holds glyphs and their places, and no reader looks at the
    tables of layout. Of the six thousand glyphs of our font a figure draws fifty: to read all of them anew
    for each figure took a third of the time of its PDF. A figure that has other signs takes them from the
    whole font, and so does each with a matplotlib that asks for characters instead of glyphs (before 3.11).
    """
    from fontTools import subset  # the modules for PDF alone need it
    from matplotlib.backends import _backend_pdf_ps as backend

    load = subset.load_font
    cut: Callable[..., Any] = backend.get_glyphs_subset

    def load_lean(*args: Any, **kwargs: Any) -> Any:
        font = load(*args, **kwargs)
        for table in LAYOUT_TABLES:
            if table in font:
                del font[table]
        return font

    def cut_lean(fontfile: Any, glyphs: Any) -> Any:
        if isinstance(glyphs, str):
            return cut(fontfile, glyphs)
        part = _part(fontfile, cut)
        if not part.indices.keys() >= set(glyphs):
            return cut(fontfile, glyphs)
        subset.load_font = lambda _, *args, **kwargs: load(io.BytesIO(part.content), *args, **kwargs)
        try:
            return _as_in_whole(cut(fontfile, {part.indices[glyph] for glyph in glyphs}), part, set(glyphs))
        finally:
            subset.load_font = load_lean

    subset.load_font, backend.get_glyphs_subset = load_lean, cut_lean
    try:
        yield
    finally:
        subset.load_font, backend.get_glyphs_subset = load, cut


@lru_cache(maxsize=16)
def _part(fontfile: Any, cut: Callable[..., Any]) -> Part:
    """Cut a font down to those of the usual signs that it has."""
    font = get_font(fontfile)
    content = io.BytesIO()
    with cut(fontfile, {0, *(font.get_char_index(ord(sign)) for sign in SIGNS)}) as part:
        part.font.save(content, reorderTables=False)
        return Part(content.getvalue(), dict(part.glyph_index_map))


@contextlib.contextmanager
def _as_in_whole(cutting: Any, part: Part, glyphs: Iterable[int]) -> Iterator[Any]:
    """Hand on what was cut from a part, its glyphs indexed as those of the whole font."""
    with cutting as found:
        index = {glyph: found.glyph_index_map[part.indices[glyph]] for glyph in glyphs}
        yield found._replace(glyph_index_map=index)
