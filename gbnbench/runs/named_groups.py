"""Groups of generators under one name: a family, or the methods of the paper's figures."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from gbnbench.core.errors import InputError
from gbnbench.core.settings import nearest
from gbnbench.generators.listing import generator_entries
from gbnbench.generators.registry import GENERATORS

FAMILY, PRESET = "family:", "preset:"


@dataclass(frozen=True)
class PaperMethod:
    """A method that a figure of the paper shows.

    Attributes
    ----------
    generator : str
        The name of its generator, if there is one.
    title : str
        As the paper calls it, with its source.
    figures : tuple of str
        Where it is shown.
    """

    generator: str
    title: str
    figures: tuple[str, ...]


# Fig. 1 by its caption. That of Fig. 8 names no methods: its columns are those of ``gbnbench figures 8``.
PAPER = (
    PaperMethod("jittered", "stratified sets", ("1", "8")),
    PaperMethod("lloyd", "CVT (Lloyd 1982)", ("8",)),
    PaperMethod("bnot", "BNOT (de Goes et al. 2012)", ("1", "8")),
    PaperMethod("kdm", "KDM (Fattal 2011)", ("1", "8")),
    PaperMethod("voidcluster", "VnC, void and cluster (Ulichney 1993)", ("1", "8")),
    PaperMethod("ccvt", "CCVT (Balzer et al. 2009)", ("8",)),
    PaperMethod("bluenets", "BlueNets (Ahmed & Wonka 2021)", ("1", "8")),
    PaperMethod("fpo", "FPO (Schlömer et al. 2011)", ("1", "8")),
    PaperMethod("gbn", "GBN (Ahmed, Ren & Wonka 2022)", ("1", "8")),
)
PRESETS = {"paper": PAPER}


def is_group(name: object) -> bool:
    """Return whether a source is a group of generators: ``family:cellular`` or ``preset:paper``."""
    return isinstance(name, str) and name.startswith((FAMILY, PRESET))


def expanded(names: Iterable[Any]) -> tuple[list[Any], tuple[str, ...]]:
    """Put the generators of each group in its place.

    Parameters
    ----------
    names : iterable
        Sources; those that are no group stay as they are.

    Returns
    -------
    names : list
        Without groups. A generator that is there already, or is in two groups, comes once.
    told : tuple of str
        A sentence for each method of a preset that has no generator, and for each generator from elsewhere
        that cannot be used.

    Raises
    ------
    InputError
        If there is no such family or preset, or a family is empty.
    """
    names = list(names)
    there = {name for name in names if isinstance(name, str)}
    found: list[Any] = []
    told: list[str] = []
    for name in names:
        if not is_group(name):
            found.append(name)
            continue
        members, missing = _members(name)
        told += missing
        found += [member for member in members if member not in there]
        there.update(members)
    return found, tuple(dict.fromkeys(told))


def _members(group: str) -> tuple[Sequence[str], Sequence[str]]:
    """Return the generators of a group, and what is to be told of the others."""
    if group.startswith(FAMILY):
        family = group.removeprefix(FAMILY)
        entries, faults = generator_entries(family)
        if not entries:
            raise InputError(f"the family {family} has no generators")
        return [one.name for one in entries], faults
    preset = group.removeprefix(PRESET)
    if preset not in PRESETS:
        raise InputError(
            f"no preset is named {preset!r}{nearest(preset, PRESETS)}; there is {', '.join(PRESETS)}"
        )
    methods = PRESETS[preset]
    missing = [
        f"{one.title} of the paper's Fig. {' and '.join(one.figures)}: gbnbench has no generator of it; give "
        "its sets as a file"
        for one in methods
        if one.generator not in GENERATORS
    ]
    return [one.generator for one in methods if one.generator in GENERATORS], missing
