"""Every family of integrands by name."""

from __future__ import annotations

from gbnbench.analysis.integration.integrands.ball import Balls
from gbnbench.analysis.integration.integrands.gaussians import Gaussians
from gbnbench.analysis.integration.integrands.genz import Genz
from gbnbench.analysis.integration.integrands.half_space import HalfSpaces
from gbnbench.analysis.integration.integrands.korobov import Korobov
from gbnbench.analysis.integration.integrands.protocol import Family
from gbnbench.analysis.integration.integrands.waves import Waves
from gbnbench.core.errors import InputError
from gbnbench.core.settings import configure, nearest, parse

FAMILIES: dict[str, type[Family]] = {
    "gaussians": Gaussians,
    "half-space": HalfSpaces,
    "korobov": Korobov,
    "waves": Waves,
    "ball": Balls,
    "genz": Genz,
}


def find(text: str) -> Family:
    """Return the family that a text such as ``gaussians[count=16]`` describes.

    Parameters
    ----------
    text : str
        A name of ``FAMILIES``, with settings in brackets where they are not the defaults;
        ``gbnbench.core.settings.specification`` writes it back.

    Raises
    ------
    InputError
        If the text is malformed, the name or a setting unknown, or a value wrong.

    Examples
    --------
    >>> find("genz[kind=corner-peak]")
    Genz(kind='corner-peak', difficulty=None)
    """
    name, settings = parse(text, "an integrand")
    if name not in FAMILIES:
        raise InputError(
            f"no integrand is named {name!r}{nearest(name, FAMILIES)}; there are {', '.join(FAMILIES)}"
        )
    return configure(FAMILIES[name], settings)
