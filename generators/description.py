"""The description of one generator: what it does, what its settings mean, which n and d it serves."""

from __future__ import annotations

import dataclasses
import inspect
import re
import textwrap
import types
import typing
from dataclasses import dataclass

from gbnbench.generators.protocol import Generator
from gbnbench.generators.third_parties.faults import refusal_of

SECTION = re.compile(r"^(?P<title>[A-Z][\w ]*)\n-{3,}\n", re.MULTILINE)
SIZES = (1, 2, 3, 16, 64, 256, 1000, 1024, 4096, 16384)  # n that each is asked about
DIMENSIONS = (1, 2, 3, 4, 8)


@dataclass(frozen=True)
class Setting:
    """A setting of a generator.

    Attributes
    ----------
    name, type : str
        Its name, and its type in words; of a choice all that can be chosen.
    default, value : object
        What it is by default, and in the generator described.
    meaning : str
        What the class says of it.
    """

    name: str
    type: str
    default: object
    value: object
    meaning: str


@dataclass(frozen=True)
class ServedSizes:
    """The numbers of points that a generator serves in one dimension, among ``SIZES``.

    Attributes
    ----------
    d : int
        Dimension.
    n : tuple of int
        Those that it serves.
    refused : dict of str
        Why it refuses the others.
    """

    d: int
    n: tuple[int, ...]
    refused: dict[int, str]


@dataclass(frozen=True)
class Description:
    """What the docstring of a generator says, and what it serves.

    Attributes
    ----------
    opening, notes, references : str
        The first paragraphs, the Notes and the References of its docstring.
    settings : tuple of Setting
        In the order of the fields.
    serves : tuple of ServedSizes
        For each of ``DIMENSIONS``.
    """

    opening: str
    notes: str
    references: str
    settings: tuple[Setting, ...]
    serves: tuple[ServedSizes, ...]


def describe(generator: Generator) -> Description:
    """Describe a generator.

    Parameters
    ----------
    generator : Generator
        With its settings.

    Returns
    -------
    Description
    """
    kind = type(generator)
    text = _sections(inspect.getdoc(kind) or kind.summary)
    meanings: dict[str, str] = {}
    for base in reversed(kind.__mro__):  # what a class does not say of its settings its bases may
        said = _sections(inspect.cleandoc(vars(base).get("__doc__") or ""))
        meanings |= {**_entries(said.get("Attributes", "")), **_entries(said.get("Parameters", ""))}
    hints = typing.get_type_hints(kind)
    settings = tuple(
        Setting(
            field.name,
            type_text(hints[field.name]),
            field.default,
            getattr(generator, field.name),
            meanings.get(field.name, ""),
        )
        for field in dataclasses.fields(kind)  # type: ignore[arg-type]
    )
    return Description(
        opening=text[""],
        notes=text.get("Notes", ""),
        references=text.get("References", ""),
        settings=settings,
        serves=tuple(_served(generator, d) for d in DIMENSIONS),
    )


def type_text(hint: object) -> str:
    """Write a type as a user reads it.

    Examples
    --------
    >>> from typing import Literal
    >>> type_text(int), type_text(float | None), type_text(Literal["newton", "harmonics"])
    ('whole number', 'number or none', 'newton or harmonics')
    """
    origin, choices = typing.get_origin(hint), typing.get_args(hint)
    if origin in (typing.Union, types.UnionType):
        return " or ".join(map(type_text, choices))
    if origin is typing.Literal:
        return " or ".join(map(str, choices))
    names = {
        "bool": "true or false", "int": "whole number", "float": "number", "str": "text",
        "NoneType": "none", "Callable": "function",
    }  # fmt: skip
    name = str(getattr(hint, "__name__", hint))
    return names.get(name, name.lower())


def _served(generator: Generator, d: int) -> ServedSizes:
    reasons = {n: refusal_of(generator, n, d) for n in SIZES}
    refused = {n: reason for n, reason in reasons.items() if reason is not None}
    return ServedSizes(d, tuple(n for n in SIZES if n not in refused), refused)


def _sections(docstring: str) -> dict[str, str]:
    """Split a numpydoc docstring into its sections; what comes before the first is named ""."""
    heads = list(SECTION.finditer(docstring))
    ends = [*(head.start() for head in heads), len(docstring)]
    found = {"": docstring[: ends[0]].strip()}
    for head, end in zip(heads, ends[1:], strict=True):
        found[head["title"]] = docstring[head.end() : end].strip()
    return found


def _entries(section: str) -> dict[str, str]:
    """Return the meanings of a section of parameters by name."""
    found: dict[str, str] = {}
    for entry in re.split(r"\n(?=\S)", section):
        head, _, body = entry.partition("\n")
        for name in head.partition(" : ")[0].split(","):
            found[name.strip()] = " ".join(textwrap.dedent(body).split())
    return found
