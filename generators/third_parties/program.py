"""A generator that is an external program: a command that writes n points, told n, d and a seed."""

from __future__ import annotations

import dataclasses
import hashlib
import re
import shutil
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from gbnbench.core.torus import FloatArray
from gbnbench.generators.protocol import Family
from gbnbench.generators.ranges import raise_refusal
from gbnbench.generators.third_parties.program_run import run_program
from gbnbench.generators.third_parties.size_rule import SizeRule, size_refusal

SEEDS = 2**31  # so that every language's integer holds a seed
PLACEHOLDER = re.compile(r"\{(\w+)\}")
Value = bool | int | float | str


@dataclass(frozen=True)
class ProgramSetting:
    """A setting of a program, which stands in its command as ``{name}``."""

    name: str
    default: Value
    meaning: str


@dataclass(frozen=True)
class ProgramDefinition:
    """What a file of programs says of one.

    Attributes
    ----------
    name, summary, family, reference : str
        As of every generator.
    command : tuple of str
        The words of the command, with placeholders.
    dimensions : (int, int or None)
        Least and largest d that it serves.
    sizes : str or tuple of int
        Numbers of points that it serves.
    toroidal : bool
        Whether opposite sides of the unit cube meet by its design.
    format : str
        Suffix of the file that it writes, without a dot.
    timeout : float
        Seconds after which it is ended.
    settings : tuple of ProgramSetting
        Its own settings.
    """

    name: str
    command: tuple[str, ...]
    summary: str
    family: Family | None
    reference: str
    dimensions: tuple[int, int | None]
    sizes: SizeRule
    toroidal: bool
    format: str
    timeout: float
    settings: tuple[ProgramSetting, ...] = ()

    def provenance(self) -> dict[str, Any]:
        """Return what decides its points, JSON-ready: the command, and checksums of the files it names."""
        files = [Path(word) for word in (self.program or "", *self.command[1:])]
        sums = {str(path): hashlib.sha256(path.read_bytes()).hexdigest() for path in files if path.is_file()}
        return {"command": list(self.command), "format": self.format, "sha256": sums}

    @property
    def program(self) -> str | None:
        """Path of the program; None where there is none that may be run."""
        return shutil.which(self.command[0])


@dataclass(frozen=True)
class ExternalProgram:
    """The base of generators that are external programs; ``program_kind`` makes the class of each."""

    name: ClassVar[str]
    summary: ClassVar[str]
    family: ClassVar[Family | None]
    dimensions: ClassVar[tuple[int, int | None]]
    toroidal: ClassVar[bool]
    reference: ClassVar[str]
    definition: ClassVar[ProgramDefinition]

    def refusal(self, n: int, d: int) -> str | None:
        """Say why the program cannot be run for n points in d dimensions.

        Parameters
        ----------
        n, d : int
            Points and dimension.

        Returns
        -------
        str or None
            The reason; None where it can be tried.
        """
        least, most = self.dimensions
        if d < least or (most is not None and d > most):
            fits = (
                f"{least} or more" if most is None else str(least) if most == least else f"{least} to {most}"
            )
            return f"d must be {fits} for {self.name}; got d={d}, nearest is {max(least, min(d, most or d))}"
        if self.definition.program is None:
            return f"{self.name}: its program {self.definition.command[0]} is not there, or may not be run"
        return size_refusal(self.definition.sizes, self.name, n, d)

    def __call__(self, n: int, d: int, rng: np.random.Generator) -> FloatArray:
        """Draw one realization, (n, d) float64, by running the program once in a folder of its own.

        Parameters
        ----------
        n, d : int
            Points and dimension.
        rng : numpy.random.Generator
            Draws the seed that the program is told.

        Returns
        -------
        (n, d) float64

        Raises
        ------
        RefusalError
            If ``refusal`` has a reason.
        GbnbenchError
            If the program fails, takes too long, or writes anything but n points of the torus.
        """
        raise_refusal(self.refusal(n, d))
        values = {"n": n, "d": d, "seed": int(rng.integers(SEEDS)), **dataclasses.asdict(self)}
        text = {
            name: str(value).lower() if isinstance(value, bool) else str(value)
            for name, value in values.items()
        }
        own = self.definition
        return run_program(own.name, own.command, text, n, d, suffix=own.format, timeout=own.timeout)

    def __reduce__(self) -> tuple[Any, ...]:
        """Travel to another process as the definition: the class is made there again."""
        return _restored, (self.definition, dataclasses.asdict(self))


@cache
def program_kind(definition: ProgramDefinition) -> type[ExternalProgram]:
    """Make the class of a program, a frozen dataclass of its settings; the same for the same definition."""
    described = [f"{s.name} : {type(s.default).__name__}\n    {s.meaning}" for s in definition.settings]
    parameters = "\n".join(["Parameters", "----------", *described, ""]) if described else ""
    members = {name: getattr(definition, name) for name in
               ("name", "summary", "family", "dimensions", "toroidal", "reference")}  # fmt: skip
    notes = f"The program: {' '.join(definition.command)}"
    if definition.sizes == "any":
        notes += "\n\nAny n is tried; where the program cannot make it, it says so when it runs."
    return dataclasses.make_dataclass(
        "ExternalProgram_" + re.sub(r"\W", "_", definition.name),
        [(s.name, type(s.default), dataclasses.field(default=s.default)) for s in definition.settings],
        bases=(ExternalProgram,),
        namespace={
            **members,
            "definition": definition,
            "__doc__": f"{definition.summary}\n\n{parameters}\nNotes\n-----\n{notes}\n",
            "__module__": __name__,
        },
        frozen=True,
    )


def _restored(definition: ProgramDefinition, settings: dict[str, Value]) -> ExternalProgram:
    return program_kind(definition)(**settings)
