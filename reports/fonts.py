"""Fonts for the signs that a label needs and the figures' own font lacks, such as Chinese or Korean ones."""

from __future__ import annotations

import contextlib
import logging
from collections.abc import Iterator
from functools import cache

import matplotlib as mpl
from matplotlib.figure import Figure
from matplotlib.font_manager import findfont, findSystemFonts, fontManager, get_font
from matplotlib.text import Text

OWN = "DejaVu Sans"
LIKELY = ("cjk", "noto sans", "han", "gothic", "hei", "song", "ming", "unicode", "wqy", "droid", "nanum")

_fallbacks: list[str] = []  # families beside our own that the labels of this process needed
_without: dict[str, None] = {}  # signs that no font has


def families() -> list[str]:
    """Return the families of fonts of all figures: our own, then those that labels needed so far."""
    return [OWN, *_fallbacks]


def has_glyph(sign: str) -> bool:
    """Whether a figure can show a sign; a font that has it is looked for, and kept for all figures.

    Parameters
    ----------
    sign : str
        One character.
    """
    if _in_own(sign):
        return True
    family = _family_with(sign)
    if family is None:
        if sign.isprintable():
            _without[sign] = None
        return False
    if family not in _fallbacks:
        _fallbacks.append(family)
    mpl.rcParams["font.family"] = families()  # of the figure that is being drawn
    return True


def renew(figure: Figure) -> None:
    """Let texts of a figure fall back too that were made before a label needed another font: titles are.

    Parameters
    ----------
    figure : Figure
        Its texts in our own font change.
    """
    if _fallbacks:
        for text in figure.findobj(Text):
            if text.get_fontfamily()[0] == OWN:
                text.set_fontfamily(families())


def shortage() -> str:
    """Say which signs no installed font has, and forget them; empty where there are none."""
    signs = "".join(_without)
    _without.clear()
    if not signs:
        return ""
    few = signs if len(signs) <= 12 else f"{signs[:12]}…"
    return f"no installed font has {few}: pictures show a box for each; install one, such as Noto Sans CJK"


@contextlib.contextmanager
def without_font_warnings() -> Iterator[None]:
    """Keep matplotlib from saying that a font without a bold face is drawn in its regular one."""
    logger = logging.getLogger("matplotlib.font_manager")
    before = logger.level
    logger.setLevel(logging.ERROR)
    try:
        yield
    finally:
        logger.setLevel(before)


@cache
def _in_own(sign: str) -> bool:
    return bool(get_font(findfont(OWN)).get_char_index(ord(sign)))


@cache
def _family_with(sign: str) -> str | None:
    """Name a family of installed fonts that has a sign, likely ones first."""
    _find_new_fonts()
    known = [entry for entry in fontManager.ttflist if entry.name in _fallbacks]
    others = sorted(
        (entry for entry in fontManager.ttflist if entry.name != OWN and "Last Resort" not in entry.name),
        key=lambda entry: (
            not any(word in entry.name.lower() for word in LIKELY),
            entry.style != "normal",
            abs(int(entry.weight) - 400) if isinstance(entry.weight, int) else 0,
            entry.name,
        ),
    )
    for entry in (*known, *others):
        try:
            if get_font(entry.fname).get_char_index(ord(sign)):
                return entry.name
        except (OSError, RuntimeError):  # a font that was taken away, or cannot be read
            continue
    return None


@cache
def _find_new_fonts() -> None:
    """Add fonts that were installed after matplotlib made its list, which it keeps in a cache."""
    listed = {entry.fname for entry in fontManager.ttflist}
    for path in findSystemFonts():
        if path not in listed:
            with contextlib.suppress(RuntimeError, OSError, ValueError):  # not every file is a font
                fontManager.addfont(path)
