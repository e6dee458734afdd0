"""Generators from elsewhere by name: programs of the user's file first, then those of packages."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from typing import Any

from gbnbench.core.errors import InputError
from gbnbench.generators.protocol import Generator
from gbnbench.generators.third_parties import installed
from gbnbench.generators.third_parties.program import ExternalProgram
from gbnbench.generators.third_parties.program_file import program_file, read_programs


@dataclass(frozen=True)
class ThirdParty:
    """A generator from elsewhere.

    Attributes
    ----------
    kind : type
        Its class.
    origin : str
        The package with its version, or the file of programs.
    """

    kind: type[Generator]
    origin: str


def third_party_names() -> list[str]:
    """List the names on offer, in order; nothing is imported."""
    path = program_file()
    kinds, faults = ({}, {}) if path is None else read_programs(path)
    names = [*kinds, *(name for name in faults if name), *(entry.name for entry in installed.entry_points())]
    return list(dict.fromkeys(names))


def third_party(name: str) -> type[Generator] | None:
    """Find one by name; only its own package is imported.

    Parameters
    ----------
    name : str
        As commands call it.

    Returns
    -------
    type or None
        Its class; None where there is none of that name.

    Raises
    ------
    InputError
        If there is one that cannot be used, or there is none of that name and the file of programs, where it
        might have been, cannot be read.
    """
    path = program_file()
    kinds, faults = ({}, {}) if path is None else read_programs(path)
    if name in kinds:
        return kinds[name]
    if name in faults:
        raise InputError(faults[name])
    for entry in installed.entry_points():
        if entry.name == name:
            return installed.load(entry)
    if "" in faults:
        raise InputError(
            f"no generator is named {name!r}, and the file of programs cannot be read: {faults['']}"
        )
    return None


def third_parties(taken: Collection[str]) -> tuple[dict[str, ThirdParty], tuple[str, ...]]:
    """Find all of them.

    Parameters
    ----------
    taken : collection of str
        Names that are gbnbench's own.

    Returns
    -------
    found : dict of ThirdParty
        By name.
    faults : tuple of str
        A sentence for each that cannot be used, which names its package or file.
    """
    found: dict[str, ThirdParty] = {}
    path = program_file()
    kinds, wrong = ({}, {}) if path is None else read_programs(path)
    faults = list(wrong.values())
    for name, kind in kinds.items():
        if name in taken:
            faults.append(
                f"{path}: generator {name!r} cannot be used: gbnbench has one of that name; rename it"
            )
        else:
            found[name] = ThirdParty(kind, str(path))
    for entry in installed.entry_points():
        package = installed.package(entry)
        owners = {**dict.fromkeys(wrong, str(path)), **{name: one.origin for name, one in found.items()}}
        owners |= dict.fromkeys(taken, "gbnbench")
        if owner := owners.get(entry.name):
            faults.append(
                f"generator {entry.name!r} of the package {package} cannot be used: {owner} has one of that "
                "name"
            )
            continue
        try:
            found[entry.name] = ThirdParty(installed.load(entry), package)
        except InputError as error:
            faults.append(str(error))
    return found, tuple(faults)


def third_party_origin(kind: type[Generator]) -> str:
    """Name the package, or the file of programs, that a generator from elsewhere is from."""
    if issubclass(kind, ExternalProgram):
        return str(program_file())
    return str(provenance(kind).get("package", kind.__module__))


def provenance(kind: type[object]) -> dict[str, Any]:
    """Return what a run folder keeps of a generator from elsewhere beside its settings, JSON-ready.

    Parameters
    ----------
    kind : type
        Its class, or that of somebody's own instance.

    Returns
    -------
    dict
        Of a program its command with checksums of the files that it names; else the class, and the package
        with its version where it is one that was found by its entry point.
    """
    if issubclass(kind, ExternalProgram):
        return {"program": kind.definition.provenance()}
    package = installed.package_of(kind)
    named = f"{kind.__module__}.{kind.__qualname__}"
    return {"class": named, **({"package": package} if package else {})}
