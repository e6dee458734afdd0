"""Fonts of figures: DejaVu Sans, and beside it installed fonts for Chinese, Japanese and Korean labels."""

from __future__ import annotations

import contextlib
import logging
from collections.abc import Iterator
from functools import lru_cache

from matplotlib.font_manager import FontProperties, findfont, findSystemFonts, fontManager, get_font

MAIN = "DejaVu Sans"  # comes with matplotlib
SAMPLES = "中あ한"  # a sign of each script that a fallback is sought for
# In the order of preference: free fonts, then those of Windows and macOS.
FALLBACKS = (
    "Noto Sans CJK SC", "Noto Sans CJK TC", "Noto Sans CJK JP", "Noto Sans CJK KR", "Noto Sans SC",
    "Noto Sans TC", "Noto Sans JP", "Noto Sans KR", "Source Han Sans SC", "Source Han Sans CN",
    "Source Han Sans TW", "Source Han Sans JP", "Source Han Sans", "Source Han Sans KR",
    "WenQuanYi Zen Hei", "WenQuanYi Micro Hei", "IPAexGothic", "IPAGothic", "IPAPGothic", "TakaoGothic",
    "VL Gothic", "NanumGothic", "UnDotum", "Baekmuk Gulim", "Droid Sans Fallback", "AR PL UMing CN",
    "Microsoft YaHei", "SimHei", "SimSun", "Microsoft JhengHei", "Yu Gothic", "Meiryo", "MS Gothic",
    "Malgun Gothic", "PingFang SC", "PingFang HK", "Heiti TC", "STHeiti", "Hiragino Sans GB",
    "Hiragino Sans", "Apple SD Gothic Neo", "AppleGothic", "Arial Unicode MS",
)  # fmt: skip


@lru_cache(maxsize=1)
def families() -> tuple[str, ...]:
    """Return the families that figures are drawn with: a sign is taken from the first that has it.

    Returns
    -------
    tuple of str
        ``DejaVu Sans`` and, for each script of ``SAMPLES``, the first installed fallback that has it.
    """
    found = _fallbacks()
    if None in found:  # matplotlib's own list of fonts is as old as its cache
        known = {font.fname for font in fontManager.ttflist}
        for path in findSystemFonts():
            if path not in known:
                with contextlib.suppress(RuntimeError, OSError, ValueError):  # not every file is a font
                    fontManager.addfont(path)
        found = _fallbacks()
    return tuple(dict.fromkeys([MAIN, *(family for family in found if family is not None)]))


@lru_cache(maxsize=4096)
def has_sign(sign: str) -> bool:
    """Whether a font of ``families`` has a sign."""
    return any(_has(family, sign) for family in families())


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


def _fallbacks() -> list[str | None]:
    """For each script the first installed fallback."""
    installed = {font.name for font in fontManager.ttflist}
    there = [family for family in FALLBACKS if family in installed]
    return [next((family for family in there if _has(family, sign)), None) for sign in SAMPLES]


def _has(family: str, sign: str) -> bool:
    with without_font_warnings():
        path = findfont(FontProperties(family=[family]), fallback_to_default=False)
    return bool(get_font(path).get_char_index(ord(sign)))
