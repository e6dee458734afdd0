"""The identity of a generator in a run folder: its class, its settings and the files that they name."""

from __future__ import annotations

import dataclasses
import hashlib
import json
from pathlib import Path
from typing import Any

from gbnbench.core.errors import InputError
from gbnbench.generators.protocol import Generator
from gbnbench.generators.registry import GENERATORS
from gbnbench.generators.third_parties.discovery import provenance


def generator_identity(generator: Generator) -> dict[str, Any]:
    """Return what decides the points of a generator: of equal identity they are equal.

    Parameters
    ----------
    generator : Generator
        Of gbnbench or from elsewhere.

    Returns
    -------
    dict
        ``settings``; of one from elsewhere what ``provenance`` says; under ``sha256`` a checksum of each file
        that a setting names, by its path.

    Raises
    ------
    InputError
        If a setting is a function or the like, of which nothing can be kept that tells it from another.
    """
    kind = type(generator)
    own = {} if GENERATORS.get(kind.name) is kind else provenance(kind)
    told = dataclasses.asdict(generator)  # type: ignore[call-overload]
    settings, sums = {}, {}
    for field in dataclasses.fields(generator):  # type: ignore[arg-type]
        value = told[field.name]
        try:
            settings[field.name] = json.loads(
                json.dumps(value)
            )  # as it is read again: tuples are lists there
        except (TypeError, ValueError):
            raise InputError(
                f"{field.name} of {kind.name} is a {type(value).__name__}, of which a run folder cannot keep "
                "what it does; give a number, a text, a table or a file, or save sets of it and compare those"
            ) from None
        if field.metadata.get("file") and isinstance(value, str) and Path(value).is_file():
            sums[value] = hashlib.sha256(Path(value).read_bytes()).hexdigest()
    return {**own, "settings": settings, **({"sha256": sums} if sums else {})}
