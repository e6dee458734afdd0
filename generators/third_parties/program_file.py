"""The file of external programs, TOML: which programs are generators, under which names."""

from __future__ import annotations

import keyword
import math
import os
import re
import shlex
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any, cast

from gbnbench.core.cache_folder import user_folder
from gbnbench.core.errors import FormatError, InputError
from gbnbench.core.readable_text import in_one_line
from gbnbench.core.settings import SPECIFICATION, nearest
from gbnbench.generators.kind_check import checked_kind
from gbnbench.generators.protocol import FAMILIES, Family, Generator
from gbnbench.generators.third_parties.program import (
    PLACEHOLDER,
    ProgramDefinition,
    ProgramSetting,
    program_kind,
)
from gbnbench.generators.third_parties.size_rule import FORMS, SizeRule

VARIABLE = "GBNBENCH_GENERATORS"
NAME = "generators.toml"  # in the user's folder of settings
TIMEOUT = 600.0  # seconds
KEYS = {
    "command": str, "summary": str, "family": str, "reference": str, "dimensions": (int, list),
    "n": (str, list), "toroidal": bool, "format": str, "timeout": (int, float), "settings": dict,
}  # fmt: skip


def program_file() -> Path | None:
    """Return the file that is read: ``$GBNBENCH_GENERATORS``, else the user's own if it is there."""
    if named := os.environ.get(VARIABLE):
        return Path(named).absolute()
    folder = user_folder("config", "gbnbench")
    own = None if folder is None else folder / NAME
    return own if own is not None and own.is_file() else None


def read_programs(path: Path) -> tuple[dict[str, type[Generator]], dict[str, str]]:
    """Read a file of programs.

    Parameters
    ----------
    path : Path
        TOML with a table ``[generators.NAME]`` for each program.

    Returns
    -------
    kinds : dict
        Class of each generator by name.
    faults : dict of str
        What is wrong with the others, by name; under the name "" what is wrong with the whole file.
    """
    try:
        content = tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        return {}, {"": f"{path}: {error.strerror}"}
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        return {}, {"": str(FormatError(path, f"is no TOML: {error}"))}
    tables = content.pop("generators", {})
    if content or not isinstance(tables, dict):
        return {}, {
            "": f"{path}: must hold tables [generators.NAME] alone; got {', '.join(content) or 'none'}"
        }
    kinds: dict[str, type[Generator]] = {}
    faults: dict[str, str] = {}
    for name, table in tables.items():
        try:
            kinds[name] = checked_kind(program_kind(definition(name, table, path.parent)), name)
        except InputError as error:
            faults[name] = f"{path}: generator {name!r} cannot be used: {error}"
    return kinds, faults


def definition(name: str, table: object, folder: Path) -> ProgramDefinition:
    """Read the table of one program.

    Parameters
    ----------
    name : str
        What commands call it.
    table : mapping
        Its keys and values.
    folder : Path
        Folder of the file: words of the command that name a file in it are taken from there.

    Returns
    -------
    ProgramDefinition

    Raises
    ------
    InputError
        If the name cannot be written with settings in brackets, a key is unknown, missing or of a wrong
        type, or the command lacks a placeholder.
    """
    if not SPECIFICATION.fullmatch(name):
        raise InputError("a name must be free of blanks, brackets, commas and =")
    if not isinstance(table, dict):
        raise InputError(f"it must be a table [generators.{name}]")
    for key, value in table.items():
        if key not in KEYS:
            raise InputError(f"there is no key {key!r}{nearest(key, KEYS)}; the keys are {', '.join(KEYS)}")
        kinds = cast(Any, KEYS[key])
        if not isinstance(value, kinds) or (isinstance(value, bool) and kinds is not bool):
            raise InputError(f"{key} must be {_words(kinds)}; got {value!r}")
    if not table.get("command", "").strip():
        raise InputError('it needs a command, such as "./program {n} {d} {seed} {output}"')
    family = table.get("family")
    if family is not None and family not in FAMILIES:
        raise InputError(f"family must be one of {', '.join(FAMILIES)}; got {family!r}")
    suffix = table.get("format", "txt").removeprefix(".")
    if not re.fullmatch(r"\w+(\.\w+)*", suffix):
        raise InputError(f"format must be the suffix of what it writes, such as txt or npy; got {suffix!r}")
    timeout = float(table.get("timeout", TIMEOUT))
    if not timeout > 0:
        raise InputError(f"timeout must be above 0 seconds; got {timeout:g}")
    settings = tuple(_setting(key, value) for key, value in table.get("settings", {}).items())
    dimensions = _dimensions(table.get("dimensions", 2))
    return ProgramDefinition(
        name=name,
        command=_command(table["command"], folder, settings, dimensions),
        summary=table.get("summary", f"external program: {in_one_line(' '.join(table['command'].split()))}"),
        family=cast("Family | None", family),
        reference=table.get("reference", ""),
        dimensions=dimensions,
        sizes=_sizes(table.get("n", "any")),
        toroidal=table.get("toroidal", False),
        format=suffix,
        timeout=timeout,
        settings=settings,
    )


def _command(
    text: str, folder: Path, settings: tuple[ProgramSetting, ...], dimensions: tuple[int, int | None]
) -> tuple[str, ...]:
    """Split a command into words, files beside the TOML file as absolute paths."""
    try:
        words = shlex.split(text)
    except ValueError as error:
        raise InputError(f"command cannot be read: {error}; got {text!r}") from None
    held = set(PLACEHOLDER.findall(text))
    needed = {"n", "seed", *(setting.name for setting in settings)}
    needed |= set() if dimensions[0] == dimensions[1] else {"d"}
    if lacks := sorted(needed - held):
        raise InputError(f"command must hold {', '.join(f'{{{name}}}' for name in lacks)}; got {text!r}")
    first, *others = words
    if "/" in first or os.sep in first:
        first = str(folder / first)
    return first, *(str(folder / word) if (folder / word).is_file() else word for word in others)


def _setting(name: str, value: object) -> ProgramSetting:
    if not re.fullmatch(r"[A-Za-z]\w*", name) or name == "output" or keyword.iskeyword(name):
        raise InputError(f"a setting must be named as a variable is, and not output; got {name!r}")
    fits = isinstance(value, Mapping) and set(value) == {"default", "meaning"}
    if not fits or not isinstance(value["default"], (bool, int, float, str)):  # type: ignore[index]
        raise InputError(
            f'setting {name} must read {{ default = 0.5, meaning = "what it is" }}; got {value!r}'
        )
    found = cast("Mapping[str, Any]", value)
    if isinstance(found["default"], float) and not math.isfinite(found["default"]):
        raise InputError(f"the default of setting {name} must be finite; got {found['default']}")
    return ProgramSetting(name, found["default"], str(found["meaning"]))


def _dimensions(value: object) -> tuple[int, int | None]:
    ends = [value, value] if isinstance(value, int) else value
    if isinstance(ends, list) and all(type(end) is int for end in ends) and len(ends) in (1, 2):
        least, most = ends[0], ends[1] if len(ends) == 2 else None
        if least >= 1 and (most is None or most >= least):
            return least, most
    raise InputError(f"dimensions must be d, [least, most] or [least], whole and >= 1; got {value!r}")


def _sizes(value: object) -> SizeRule:
    if value in FORMS:
        return cast("SizeRule", value)
    if isinstance(value, list) and value and all(type(n) is int and n >= 1 for n in value):
        return tuple(value)
    raise InputError(f"n must be one of {', '.join(FORMS)}, or a list of numbers >= 1; got {value!r}")


def _words(kinds: Any) -> str:
    names = {
        str: "text",
        bool: "true or false",
        dict: "a table",
        list: "a list",
        int: "whole",
        float: "a number",
    }
    return " or ".join(names[kind] for kind in (kinds if isinstance(kinds, tuple) else (kinds,)))
