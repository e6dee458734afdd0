"""The sets that a library shall hold: generators at every n and d that they serve, and what they refuse."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.least_values import require
from gbnbench.core.settings import specification
from gbnbench.generators.protocol import Generator
from gbnbench.generators.registry import find
from gbnbench.generators.third_parties.faults import refusal_of
from gbnbench.io.set_library.entries import RefusedSets, set_file_stem
from gbnbench.runs.generator_identity import generator_identity
from gbnbench.runs.source_names import unique_key

DEFAULT_GENERATORS = ("gbn", "deep", "stealthy", "bnot")
DEFAULT_D = tuple(range(1, 9))
DEFAULT_N = tuple(2**k for k in range(4, 17))
DEFAULT_REALIZATIONS = 8


@dataclass(frozen=True)
class RequestedSets:
    """The sets of one file.

    Attributes
    ----------
    key : str
        The path of the file without its suffix, such as ``gbn/2d/gbn-2d-1024``.
    generator : Generator
        What draws them.
    n, d, realizations : int
        Points a set, dimension, number of sets.
    """

    key: str
    generator: Generator
    n: int
    d: int
    realizations: int

    @property
    def text(self) -> str:
        """The generator, with settings in brackets where they are not the defaults."""
        return specification(self.generator)

    @property
    def file(self) -> str:
        """The path of the file below the library."""
        return f"{self.key}.npy"

    @property
    def bytes(self) -> int:
        """Of the coordinates."""
        return 8 * self.realizations * self.n * self.d

    @property
    def settings(self) -> dict[str, Any]:
        """All settings of the generator, and where it is from if it is not gbnbench's own."""
        identity = generator_identity(self.generator)
        return {**identity.pop("settings"), **identity}


@dataclass(frozen=True)
class LibraryRequest:
    """Everything that one call shall make.

    Attributes
    ----------
    sets : tuple of RequestedSets
        By n, then in the order of the generators and of d.
    refused : tuple of RefusedSets
        What the rules of the generators exclude.
    """

    sets: tuple[RequestedSets, ...]
    refused: tuple[RefusedSets, ...]


def library_request(
    generators: Sequence[str] = DEFAULT_GENERATORS,
    n: Sequence[int] = DEFAULT_N,
    d: Sequence[int] = DEFAULT_D,
    realizations: int = DEFAULT_REALIZATIONS,
) -> LibraryRequest:
    """List the sets of generators at every n and d.

    Parameters
    ----------
    generators : sequence of str
        With or without settings, such as ``gbn[sigma=0.8]``.
    n, d : sequence of int
        Points a set, and dimensions.
    realizations : int
        Sets of each, >= 1.

    Returns
    -------
    LibraryRequest

    Raises
    ------
    InputError
        If a name, a setting or a number is wrong, or two generators would have files of one name.
    RefusalError
        If nothing is left.

    Examples
    --------
    >>> request = library_request(["gbn", "bnot"], n=(16, 32), d=(2, 3))
    >>> [sets.file for sets in request.sets if sets.n == 32]
    ['gbn/2d/gbn-2d-32.npy', 'gbn/3d/gbn-3d-32.npy', 'bnot/2d/bnot-2d-32.npy']
    >>> request.refused[0].reason
    'bnot cuts the plane into power cells; got d=3, use d=2'
    """
    require(realizations=(realizations, 1), n=(min(n, default=0), 1), d=(min(d, default=0), 1))
    found = list(dict.fromkeys(find(text) for text in generators))
    if not found:
        raise InputError("no generator given: name one, such as gbn")
    slugs: dict[str, str] = {}
    sets, refused = [], []
    for size in sorted(set(n)):
        for generator in found:
            text = specification(generator)
            slug = unique_key(text, set())
            if slugs.setdefault(slug, text) != text:
                raise InputError(f"{slugs[slug]} and {text} would have files of one name, {slug}")
            for dimension in sorted(set(d)):
                if reason := refusal_of(generator, size, dimension):
                    refused.append(RefusedSets(text, size, dimension, reason))
                    continue
                key = set_file_stem(slug, size, dimension)
                sets.append(RequestedSets(key, generator, size, dimension, realizations))
    if not sets:
        raise RefusalError("; ".join(dict.fromkeys(entry.reason for entry in refused)))
    return LibraryRequest(tuple(sets), tuple(refused))
