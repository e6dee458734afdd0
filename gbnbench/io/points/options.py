"""Options of reading: columns, layout, array and box of points whose file does not tell them itself."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from gbnbench.core.errors import InputError

_RAW = re.compile(r"([<>]?)([a-z]+[0-9]+)\s*,\s*([1-9][0-9]{0,5})")


@dataclass(frozen=True)
class ReadingOptions:
    """What the user says of files that do not say it themselves; without any, points of the unit torus.

    Attributes
    ----------
    columns : tuple of str or None
        Names of the columns that are coordinates, in their order, or their numbers counted from 1 where the
        file has no names.
    raw : str or None
        Layout of binary files without a header: the type of the numbers and how many a point has, such as
        ``float32,3``; ``>float32,2`` where the first byte is the highest.
    array : str or None
        Name of the array of an .npz, or of the key of a JSON file.
    period : tuple of float or None
        Sides of the torus in the unit of the file, from 0; one number is meant for all axes.
    bounds : tuple of float or None
        Lower and upper end of each axis, in turn.
    wrap : bool
        Bring points outside into the box by whole sides.
    window : bool
        Whether ``gbnbench analyze --window`` tells the box, so that errors speak of it.
    shape_told : bool
        Whether the writer was told n and d, as programs are: few rows of many columns are points then.

    Examples
    --------
    >>> ReadingOptions(period=(512.0, 256.0)).record()
    {'period': [512.0, 256.0]}
    """

    columns: tuple[str, ...] | None = None
    raw: str | None = None
    array: str | None = None
    period: tuple[float, ...] | None = None
    bounds: tuple[float, ...] | None = None
    wrap: bool = False
    window: bool = False
    shape_told: bool = False

    def __post_init__(self) -> None:
        if self.period is not None and self.bounds is not None:
            raise InputError("period and bounds both tell the box; give one of them")
        if self.columns is not None and (
            not self.columns or not all(self.columns) or len({*self.columns}) < len(self.columns)
        ):
            raise InputError(
                f"columns must name each column once, such as x,y; got {','.join(self.columns)!r}"
            )
        if self.period is not None and not all(0 < side < math.inf for side in self.period):
            raise InputError(f"period must be the box's sides, each above 0; got {listed(self.period)}")
        if self.bounds is not None:
            self._check_bounds(self.bounds)
        if self.raw is not None:
            self.layout()

    @staticmethod
    def _check_bounds(bounds: tuple[float, ...]) -> None:
        if len(bounds) % 2 or not bounds or not all(map(math.isfinite, bounds)):
            raise InputError(
                f"bounds must be the lower and upper end of each axis, such as 0,512,0,512; "
                f"got {listed(bounds)}"
            )
        for axis, (low, high) in enumerate(zip(bounds[::2], bounds[1::2], strict=True)):
            if not (low < high and high - low < math.inf):
                raise InputError(
                    f"bounds must have low < high on each axis; axis {axis} has {low:g}, {high:g}"
                )

    def layout(self) -> tuple[np.dtype[Any], int]:
        """Return the type and the numbers a point of ``raw``.

        Raises
        ------
        InputError
            If the text is no such layout, or none was given.
        """
        match = _RAW.fullmatch((self.raw or "").strip().lower())
        try:
            if match is None:
                raise TypeError
            dtype = np.dtype(match[2])
            if dtype.kind not in "fiu" or dtype.itemsize > 8:
                raise TypeError
        except TypeError:
            raise InputError(
                f"raw must be a type of numbers and how many a point has, such as float32,3; got {self.raw!r}"
            ) from None
        # files do not change with the machine that reads them
        dtype = dtype.newbyteorder(">") if match[1] == ">" else dtype.newbyteorder("<")
        return dtype, int(match[3])

    def record(self) -> dict[str, Any]:
        """Return what was given, JSON-ready; empty where nothing was."""
        return {
            name: list(value) if isinstance(value, tuple) else value
            for name, value in asdict(self).items()
            if value is not None and value is not False
        }


def reading_options(
    columns: str | Sequence[str] | Sequence[int] | None = None,
    raw: str | None = None,
    array: str | None = None,
    period: float | str | Sequence[float] | None = None,
    bounds: str | Sequence[float] | Sequence[Sequence[float]] | None = None,
    wrap: bool = False,
) -> ReadingOptions:
    """Make reading options of what a user types or writes in Python.

    Parameters
    ----------
    columns : str, or sequence of str or int, optional
        ``"x,y"`` or ``["x", "y"]``.
    raw, array : str, optional
        As in ``ReadingOptions``.
    period : float, str or sequence of float, optional
        ``512``, ``"512,256"`` or ``(512, 256)``.
    bounds : str or sequence, optional
        ``"0,512,0,256"``, ``(0, 512, 0, 256)`` or ``((0, 512), (0, 256))``.
    wrap : bool
        As in ``ReadingOptions``.

    Returns
    -------
    ReadingOptions

    Raises
    ------
    InputError
        If one of them cannot be meant so.

    Examples
    --------
    >>> reading_options(columns="x, y", period="512,256").period
    (512.0, 256.0)
    """
    if columns is not None and not isinstance(columns, Iterable):
        raise InputError(f"columns must be names or numbers, such as 'x,y' or ('1', '2'); got {columns!r}")
    if isinstance(columns, str):
        columns = [name.strip() for name in columns.split(",")]
    named = None if columns is None else tuple(str(name) for name in columns)
    return ReadingOptions(
        named,
        raw,
        array,
        _numbers("period", period, "512,512"),
        _numbers("bounds", bounds, "0,512,0,512"),
        bool(wrap),
    )  # fmt: skip


def _numbers(name: str, given: Any, example: str) -> tuple[float, ...] | None:
    if given is None:
        return None
    try:
        words = given.split(",") if isinstance(given, str) else np.ravel(given).tolist()
        numbers = tuple(float(word) for word in words)
    except (TypeError, ValueError):
        numbers = ()
    if not numbers:
        raise InputError(f"{name} must be numbers parted by commas, such as {example}; got {given!r}")
    return numbers


def listed(numbers: Sequence[float]) -> str:
    """Write numbers as an option takes them, such as 512,256."""
    return ",".join(f"{number:.17g}" for number in numbers)
