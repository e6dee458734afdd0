"""Names of sources: generators, files and folders, and which of them a name means."""

from __future__ import annotations

import difflib
import re
from collections import Counter
from collections.abc import Callable, Hashable, Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, ClassVar, Protocol, TypeVar

from gbnbench.core.errors import InputError
from gbnbench.core.readable_text import without_bytes
from gbnbench.generators.protocol import Generator
from gbnbench.generators.registry import find, generator_names, kind_named


def generator_named(name: str) -> Generator | None:
    """Parse a generator's text.

    Parameters
    ----------
    name : str
        A generator with or without settings, or a path.

    Returns
    -------
    Generator or None
        None where the name is an existing path instead, or a path with brackets that no generator reads.

    Raises
    ------
    InputError
        If it is neither.
    """
    if not name.strip():
        raise InputError("a source is an empty text, such as an unset variable of the shell leaves")
    base, bracket, _ = name.partition("[")
    base = base.strip()
    names = generator_names()
    if base in names:
        try:
            return find(name)
        except InputError:
            if bracket and Path(name).exists():  # a file such as ``sobol[1].txt``
                return None
            raise
    if Path(name).exists():
        return None
    kind_named(base)  # has an error of its own where a file of programs cannot be read
    close = difflib.get_close_matches(base.lower(), names, n=2)
    near = f"; did you mean {' or '.join(close)}?" if close else "."
    raise InputError(
        f"{name!r} is neither a generator nor an existing file or folder{near} "
        f"The generators are {', '.join(names)}"
    )


def double_meanings(names: Iterable[object]) -> list[str]:
    """Say what is taken of names that are those of a generator and of an existing file or folder.

    Parameters
    ----------
    names : iterable
        Sources as the user gave them.

    Returns
    -------
    list of str
        A sentence for each, with the way to ask for the other.
    """
    told = []
    known = generator_names()
    for name in dict.fromkeys(names):
        if not isinstance(name, str) or name.partition("[")[0].strip() not in known:
            continue
        if not Path(name).exists():
            continue
        what = "folder" if Path(name).is_dir() else "file"
        if generator_named(name) is None:
            told.append(f"{name} is the {what} of that name; as settings of a generator it cannot be read")
        else:
            told.append(f"{name} is the generator; the {what} of that name is ./{name}")
    return told


class Labelled(Protocol):
    """A source with a label, and a key that is safe for a file: a frozen dataclass."""

    __dataclass_fields__: ClassVar[dict[str, Any]]

    @property
    def key(self) -> str:
        """Unique among sources."""
        ...

    @property
    def label(self) -> str:
        """What the user reads."""
        ...


S = TypeVar("S", bound=Labelled)


def told_apart(
    sources: Sequence[S],
    group: Callable[[S], Hashable] = lambda _: None,
    ending: Callable[[S], str] = lambda _: "",
) -> tuple[S, ...]:
    """Count repeated labels, and give every source a key of its own.

    Parameters
    ----------
    sources : sequence of dataclass
        With a ``key`` and a ``label``.
    group : callable, optional
        Labels are counted among sources for which this is the same; by default among all.
    ending : callable, optional
        What the key of a source ends in.

    Returns
    -------
    tuple of dataclass
        In the same order.
    """
    seen: Counter[tuple[Hashable, str]] = Counter()
    keys: set[str] = set()
    result = []
    for source in sources:
        label = without_bytes(source.label)
        seen[group(source), label] += 1
        times = seen[group(source), label]
        text = label if times == 1 else f"{label} ({times})"
        result.append(replace(source, key=unique_key(text, keys, ending(source)), label=text))
    return tuple(result)


def unique_key(label: str, taken: set[str], ending: str = "") -> str:
    """Turn a label into a name that is safe for a file, and take it.

    Parameters
    ----------
    label : str
        What the user reads.
    taken : set of str
        Names that are taken; the new one is added.
    ending : str
        What the name ends in.

    Returns
    -------
    str
        In lower case, with a number where another label has the same name.

    Examples
    --------
    >>> taken = set()
    >>> unique_key("GBN[sigma=0.8]", taken), unique_key("gbn(sigma=0.8)", taken)
    ('gbn-sigma-0.8', 'gbn-sigma-0.8-2')
    """
    slug = re.sub(r"[^a-z0-9.]+", "-", label.lower()).strip("-.")[:60] or "set"
    stem = key = f"{slug}{ending}"
    twin = 1
    while key in taken:  # different labels may share a slug
        twin += 1
        key = f"{stem}-{twin}"
    taken.add(key)
    return key
