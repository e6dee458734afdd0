"""Target radial profiles: the exponential one of Gaussian Blue Noise, made steeper, and tables."""

from __future__ import annotations

import csv
import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import cast

import numpy as np
from numpy.typing import ArrayLike

from gbnbench.core.errors import FormatError, InputError
from gbnbench.core.torus import FloatArray


@dataclass(frozen=True)
class Exponential:
    """P(nu) = exp(-c (edge**2 - nu**2)): 1 at its edge (Eq. 19 of Ahmed, Ren & Wonka 2022: c = 4 pi**2).

    Attributes
    ----------
    c : float
        Steepness, > 0.
    edge : float
        In nu, > 0.
    """

    c: float
    edge: float

    def __call__(self, nu: FloatArray) -> FloatArray:
        """Power at nu."""
        power: FloatArray = np.exp(-self.c * (self.edge**2 - nu**2))
        return power


class _RowError(InputError):
    """A row of a table is no nu and power; row counts from 0."""

    def __init__(self, row: int, said: str) -> None:
        super().__init__(f"row {row + 1}: {said}")
        self.row, self.said = row, said


@dataclass(frozen=True)
class Table:
    """Power at rising nu, its logarithm joined by straight lines, constant below the first.

    Attributes
    ----------
    nu : tuple of float
        Rising, >= 0; the last is the edge.
    power : tuple of float
        > 0.

    Raises
    ------
    InputError
        If there are fewer than two rows, nu does not rise, or a power is not positive and finite.

    Examples
    --------
    >>> Table((0.0, 0.5), (1e-20, 1.0))(np.array([0.25]))
    array([1.e-10])
    """

    nu: tuple[float, ...]
    power: tuple[float, ...]

    def __post_init__(self) -> None:
        if len(self.nu) != len(self.power) or len(self.nu) < 2:
            raise InputError(f"a target needs two rows of nu and power or more; got {len(self.nu)}")
        for k, (nu, power) in enumerate(zip(self.nu, self.power, strict=True)):
            if not (math.isfinite(power) and power > 0):
                raise _RowError(
                    k,
                    f"the power of a target must be positive and finite; got {power}: 1e-30 is almost none",
                )
            if not (math.isfinite(nu) and nu >= 0 and (k == 0 or nu > self.nu[k - 1])):
                raise _RowError(k, f"the nu of a target must be >= 0 and rise; got {nu}")

    @property
    def edge(self) -> float:
        """The last nu."""
        return self.nu[-1]

    def __call__(self, nu: FloatArray) -> FloatArray:
        """Power at nu."""
        power: FloatArray = np.exp(np.interp(nu, self.nu, np.log(self.power)))
        return power

    @classmethod
    def of(cls, rows: ArrayLike) -> Table:
        """Make a table of (k, 2) numbers, nu and power.

        Raises
        ------
        InputError
            If rows are not such numbers.
        """
        try:
            array = np.asarray(rows, dtype=np.float64)
        except (TypeError, ValueError):
            array = np.empty((0, 0))
        if array.ndim != 2 or array.shape[1] != 2:
            raise InputError(f"a target must be (k, 2) numbers, nu and power; got shape {array.shape}")
        return cls(tuple(array[:, 0].tolist()), tuple(array[:, 1].tolist()))

    @classmethod
    def read(cls, path: str | Path) -> Table:
        """Read a CSV of nu and power, or one whose head names these columns among others.

        Raises
        ------
        FormatError
            If the file cannot be read, a row is not numbers, or the table is not a target.
        """
        try:
            with Path(path).open(newline="", encoding="utf-8-sig") as file:
                lines = [(number, row) for number, row in enumerate(csv.reader(file), 1) if any(row)]
        except (OSError, UnicodeDecodeError, csv.Error) as error:
            raise FormatError(path, f"a target cannot be read: {error}") from None
        head = [cell.strip().lower() for cell in lines[0][1]] if lines else []
        columns = (0, 1)
        if "nu" in head and "power" in head:
            columns, lines = (head.index("nu"), head.index("power")), lines[1:]
        rows = []
        for number, row in lines:
            try:
                rows.append([float(row[column]) for column in columns])
            except (ValueError, IndexError):
                raise FormatError(
                    path, f"a target needs a number for nu and one for power; got {','.join(row)!r}", number
                ) from None
        try:
            return cls.of(np.reshape(rows, (-1, 2)))
        except _RowError as error:
            raise FormatError(path, error.said, lines[error.row][0]) from None
        except InputError as error:
            raise FormatError(path, str(error)) from None


TargetSetting = str | Table | Callable[[FloatArray], FloatArray] | None


def as_target(value: object) -> TargetSetting:
    """Accept what a setting may give as a target: a name, a callable, a table or (k, 2) numbers.

    Parameters
    ----------
    value : object
        What was given; the text ``none`` is None.

    Returns
    -------
    str, Table, callable or None

    Raises
    ------
    InputError
        If it is none of these.
    """
    if value is None or isinstance(value, str | Table) or callable(value):
        return None if isinstance(value, str) and value.lower() == "none" else cast("TargetSetting", value)
    return Table.of(value)  # type: ignore[arg-type]
