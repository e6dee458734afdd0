"""Ready point sets from Python: those that are installed with gbnbench, or those of a library of your own."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

from gbnbench.core.errors import RefusalError
from gbnbench.core.settings import specification
from gbnbench.core.torus import FloatArray
from gbnbench.generators.registry import find
from gbnbench.io.set_library.entries import RefusedSets
from gbnbench.io.set_library.manifest import Manifest
from gbnbench.io.set_library.places import BUNDLED, Place, manifest_of, open_place
from gbnbench.io.set_library.set_file import read_sets

if TYPE_CHECKING:
    import pandas as pd


def ready_set(
    name: str,
    n: int,
    d: int = 2,
    realization: int | None = 0,
    *,
    library: str | os.PathLike[str] = BUNDLED,
) -> FloatArray:
    """Return a point set that was made before, without making it.

    Parameters
    ----------
    name : str
        A generator, with settings in brackets where they are not the defaults, such as ``"gbn"``.
    n : int
        Points.
    d : int
        Dimension.
    realization : int or None
        The number of the set; None for all of this generator, n and d.
    library : str or path
        A folder or an archive that ``gbnbench library`` made; by default the choice that is installed.

    Returns
    -------
    (n, d) or (realizations, n, d) float64
        On the unit torus, in [0, 1): the same bits as ``gbnbench.generate`` gave where the library was made.

    Raises
    ------
    RefusalError
        If the library has no such set; the text says what it has, and which command makes it.
    InputError
        If the name or a setting is wrong, or there is no such library.
    FormatError
        If a file of the library is missing or was changed.

    Examples
    --------
    >>> import gbnbench
    >>> x = gbnbench.ready_set("gbn", n=1024)
    >>> x.shape, bool(gbnbench.measures(x)["noise_floor"] < 1e-9)
    ((1024, 2), True)
    """
    text = specification(find(name))
    with open_place(_where(library)) as place:
        manifest = manifest_of(place)
        entry = manifest.entry(text, n, d)
        if entry is None or isinstance(entry, RefusedSets):
            if entry is not None:
                raise RefusalError(f"{text}, n={n}, d={d} cannot be made: {entry.reason}")
            raise RefusalError(_lacking(place, manifest, text, n, d))
        if realization is None:
            return read_sets(place, entry)
        if realization not in entry.realizations:
            numbers = ", ".join(map(str, entry.realizations))
            raise RefusalError(
                f"{text}, n={n}, d={d} has the realizations {numbers} in the {_named(place)}; got "
                f"{realization}. " + _how(text, n, d, max(realization, 0) + 1)
            )
        one: FloatArray = read_sets(place, entry)[entry.realizations.index(realization)]
        return one


def ready_sets(library: str | os.PathLike[str] = BUNDLED) -> pd.DataFrame:
    """List the point sets that a library has, with their measures.

    Parameters
    ----------
    library : str or path
        A folder or an archive that ``gbnbench library`` made; by default the choice that is installed.

    Returns
    -------
    pandas.DataFrame
        A row a file: file, generator, n, d, realizations (how many), cpu_seconds (of making one), every
        measure of the realizations together as ``gbnbench.measures`` has it, nan where undefined, sha256.

    Raises
    ------
    InputError
        If there is no such library.
    FormatError
        If its manifest is damaged.

    Examples
    --------
    >>> import gbnbench
    >>> table = gbnbench.ready_sets()
    >>> sorted(set(table.generator))
    ['bnot', 'deep', 'gbn', 'stealthy']
    """
    with open_place(_where(library)) as place:
        return manifest_of(place).to_frame()


def _where(library: str | os.PathLike[str]) -> str | Path:
    return BUNDLED if library == BUNDLED else Path(library)


def _named(place: Place) -> str:
    if place.path == Path(BUNDLED):
        return "choice that is installed"
    return f"library {place.path}"


def _lacking(place: Place, manifest: Manifest, text: str, n: int, d: int) -> str:
    """Say that there is no such file, what there is nearest to it, and how it is made."""
    same = [entry for entry in manifest.files if entry.generator == text]
    if not same:
        names = ", ".join(dict.fromkeys(entry.generator for entry in manifest.files)) or "nothing"
        there = f"of the generators there are {names}"
    elif sizes := sorted(entry.n for entry in same if entry.d == d):
        there = f"in d={d} there are n = {', '.join(map(str, sizes))}"
    else:
        there = f"there is d = {', '.join(map(str, sorted({entry.d for entry in same})))}"
    return f"{text}, n={n}, d={d} is not in the {_named(place)}: {there}. {_how(text, n, d, 8)}"


def _how(text: str, n: int, d: int, realizations: int) -> str:
    quoted = f"'{text}'" if "[" in text else text
    sets = "" if realizations <= 8 else f" --realizations {realizations}"
    return f"gbnbench library {quoted} -n {n} -d {d}{sets} -o FOLDER makes it, for library=FOLDER"
