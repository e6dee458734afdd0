"""Labels of logarithmic axes in plain text, 10⁻⁴: to set them as mathematics takes twenty times as long."""

from __future__ import annotations

import re

from matplotlib.ticker import LogFormatterSciNotation

SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
MATHEMATICS = re.compile(r"\$\\mathdefault\{(?:(\S+)\\times)?10\^\{(-?\d+)\}\}\$")


class PowersOfTen(LogFormatterSciNotation):
    r"""matplotlib's labels of the marks of a logarithmic axis, with the exponent in signs of the font.

    Examples
    --------
    >>> PowersOfTen.plain(r"$\mathdefault{2\times10^{-14}}$")
    '2×10⁻¹⁴'
    """

    def __call__(self, x: float, pos: int | None = None) -> str:
        """Return the label of a mark."""
        return self.plain(str(super().__call__(x, pos)))

    @staticmethod
    def plain(label: str) -> str:
        """Return a label that matplotlib sets as mathematics as plain text; any other as it is."""
        return MATHEMATICS.sub(_in_signs, label)


def _in_signs(label: re.Match[str]) -> str:
    factor, exponent = label.groups()
    return (f"{factor}×" if factor else "") + "10" + exponent.translate(SUPERSCRIPTS)
