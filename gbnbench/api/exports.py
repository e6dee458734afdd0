"""Results of exports: the files, the numbers in them, and what was measured of them."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.radial.pattern_power import PatternPower
from gbnbench.analysis.radial.projection_quality import ProjectionQuality
from gbnbench.core.torus import FloatArray
from gbnbench.core.torus_isometry import TorusIsometry
from gbnbench.io.exports.number_types import NumberType

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True)
class SetCopy:
    """What one exported set is.

    Attributes
    ----------
    of : int
        Number of the source's set, from 0.
    done : tuple of TorusIsometry
        What was done to it, one after the other: what was asked for, then the copy's own.
    """

    of: int
    done: tuple[TorusIsometry, ...]

    def words(self) -> str:
        """Say it, such as ``set 0; flipped on 0; shifted by 0.5,0.25``."""
        said = [one.words() for one in self.done if not one.is_identity()]
        return "; ".join([f"set {self.of} of the source", *(said or ["as it is"])])


@dataclass(frozen=True)
class ExportedSets:
    """Point sets that were exported: ``made = export_sets("sets.h", "gbn")``.

    Attributes
    ----------
    files : tuple of Path
        The file, and the description beside binary numbers.
    points : (sets, n, d) float64
        As they were written, rounded to the type: fractions of the box.
    number_type : {"float32", "float64", "uint32"}
        Of the numbers in the file.
    source : str
        Generator or file, for the reader.
    copies : tuple of SetCopy
        What each set is.
    repeat : tuple of int
        Tiles along each axis.
    sides : tuple of float or None
        Of the box of which points are fractions, in any unit; None for a cube.
    measured : int
        Sets, from the first, of which quality was measured.
    unrounded, quality : ProjectionQuality
        Of whole sets, before they were rounded to the type and as they were written.
    projections : tuple of ProjectionQuality
        As they were written, of every axis and pair of axes; none for d <= 2.
    remarks : tuple of str
        What the user should know before the sets are used.

    Examples
    --------
    >>> import tempfile, gbnbench
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     made = gbnbench.export_sets(f"{folder}/sets.h", "jittered", n=16, d=2)
    >>> made.points.shape, made.to_frame().columns.tolist()
    ((1, 16, 2), ['axes', 'noise_floor', 'power_at_1', 'min_distance', 'over_random'])
    """

    files: tuple[Path, ...]
    points: FloatArray
    number_type: NumberType
    source: str
    copies: tuple[SetCopy, ...]
    repeat: tuple[int, ...]
    sides: tuple[float, ...] | None
    measured: int
    unrounded: ProjectionQuality
    quality: ProjectionQuality
    projections: tuple[ProjectionQuality, ...]
    remarks: tuple[str, ...]

    def to_frame(self) -> pd.DataFrame:
        """Table of a row for the whole sets and one for each projection, with columns ``QUALITY_COLUMNS``."""
        import pandas as pd

        rows = [quality_row(one) for one in (self.quality, *self.projections)]
        return pd.DataFrame(rows, columns=list(QUALITY_COLUMNS))


QUALITY_COLUMNS = ("axes", "noise_floor", "power_at_1", "min_distance", "over_random")


def quality_row(one: ProjectionQuality) -> tuple[str | float, ...]:
    """Return the numbers of a projection in the order of ``QUALITY_COLUMNS``, axes as 0+1."""
    return (
        "+".join(map(str, one.axes)), one.noise_floor, one.power_at_1, one.min_distance, one.over_random
    )  # fmt: skip


@dataclass(frozen=True)
class ExportedMask:
    """A dither mask that was exported: ``made = export_mask("mask.png", 64)``.

    Attributes
    ----------
    files : tuple of Path
        The file, the description beside binary numbers, and the picture.
    ranks : (rows, columns) or (frames, rows, columns) int64
        Each of 0 to pixels - 1 once.
    bits : int
        Of a number in the file.
    levels : tuple of PatternPower
        The power of the patterns that it makes, at some grey levels.
    remarks : tuple of str
        What the user should know before it is used.

    Examples
    --------
    >>> import tempfile, gbnbench
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     made = gbnbench.export_mask(f"{folder}/mask.png", 32)
    >>> made.ranks.shape, made.to_frame().columns.tolist()
    ((32, 32), ['level', 'ones', 'low', 'lowest'])
    """

    files: tuple[Path, ...]
    ranks: NDArray[np.int64]
    bits: int
    levels: tuple[PatternPower, ...]
    remarks: tuple[str, ...]

    def to_frame(self) -> pd.DataFrame:
        """Table of one row a grey level, with columns level, ones, low, lowest."""
        import pandas as pd

        return pd.DataFrame(
            [(one.level, one.ones, one.low, one.lowest) for one in self.levels],
            columns=["level", "ones", "low", "lowest"],
        )
