"""Colours of inks and of paper: read, and how light they are."""

from __future__ import annotations

from gbnbench.core.errors import InputError
from gbnbench.io.images.image import LUMA


def read_colour(text: str, among: str = "") -> str:
    """Read a colour.

    Parameters
    ----------
    text : str
        ``#rgb``, ``#rrggbb`` or a name of CSS.
    among : str
        What the message of an error ends in, where several may be given.

    Returns
    -------
    str
        ``#rrggbb``.

    Raises
    ------
    InputError
        If it is none.

    Examples
    --------
    >>> read_colour("gold"), read_colour("#08c")
    ('#ffd700', '#0088cc')
    """
    from PIL import ImageColor

    try:
        red, green, blue = ImageColor.getrgb(text.strip())[:3]
    except ValueError:
        raise InputError(
            f"{text.strip()!r} is no colour: write #rgb, #rrggbb or a name of CSS{among}"
        ) from None
    return f"#{red:02x}{green:02x}{blue:02x}"


def luma(colour: str) -> float:
    """Lightness of ``#rrggbb`` as coded (Rec. ITU-R BT.709), 0 black to 1 white.

    Examples
    --------
    >>> luma("#000000"), luma("#ffffff")
    (0.0, 1.0)
    """
    shares = (int(colour[k : k + 2], 16) / 255 for k in (1, 3, 5))
    return round(sum(weight * share for weight, share in zip(LUMA, shares, strict=True)), 12)
