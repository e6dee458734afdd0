"""The words of ``gbnbench export`` on the files that it wrote, in lines and as JSON."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from gbnbench.api.exports import QUALITY_COLUMNS, ExportedMask, ExportedSets, quality_row
from gbnbench.core.number_text import number
from gbnbench.core.readable_text import counted
from gbnbench.core.text_table import aligned

FEW = 16  # copies that are told one by one


def set_lines(made: ExportedSets, *, replaced: bool) -> Iterator[str]:
    """Lay out what was written of sets.

    Parameters
    ----------
    made : ExportedSets
        The export.
    replaced : bool
        Whether the file was there before.

    Yields
    ------
    str
        A line each.
    """
    sets, n, d = made.points.shape
    how_many = counted(sets, "set")
    again = ", replacing what was there" if replaced else ""
    yield f"wrote {made.files[0]}: {how_many} of {counted(n, 'point')}, d={d}, {made.number_type}{again}"
    yield from (f"wrote {path}: what the numbers are" for path in made.files[1:])
    if any(count > 1 for count in made.repeat):
        yield f"a tile of {' x '.join(map(str, made.repeat))}, each point scaled to the whole"
    changed = [k for k, one in enumerate(made.copies) if not all(step.is_identity() for step in one.done)]
    yield from (f"set {k}: {made.copies[k].words()}" for k in changed[:FEW])
    if len(changed) > FEW:
        yield f"and {len(changed) - FEW} more copies, as the file tells"
    yield ""
    rows = [
        ("+".join(map(str, one.axes)) if k else "all",
         *map(number, (one.noise_floor, one.power_at_1, one.min_distance, one.over_random)))
        for k, one in enumerate((made.quality, *made.projections))
    ]  # fmt: skip
    yield from aligned(("axes", "noise floor", "P(1)", "nearest points", "over random"), rows)
    of = f"the first {made.measured} sets" if made.measured < sets else how_many
    yield f"noise floor and P(1) are 1 for random points; of {of}, as written"


def sets_record(made: ExportedSets) -> dict[str, Any]:
    """Return the same as plain values for JSON."""
    sets, n, d = made.points.shape
    return {
        "files": [str(path) for path in made.files],
        "sets": sets,
        "n": n,
        "d": d,
        "number_type": made.number_type,
        "noise_floor_before_rounding": made.unrounded.noise_floor,
        "sets_measured": made.measured,
        "quality": [
            dict(zip(QUALITY_COLUMNS, quality_row(one), strict=True))
            for one in (made.quality, *made.projections)
        ],
        "copies": [one.words() for one in made.copies],
        "remarks": made.remarks,
    }


def mask_lines(made: ExportedMask, *, replaced: bool) -> Iterator[str]:
    """Lay out what was written of a mask.

    Parameters
    ----------
    made : ExportedMask
        The export.
    replaced : bool
        Whether the file was there before.

    Yields
    ------
    str
        A line each.
    """
    *frames, rows, columns = made.ranks.shape
    size = f"{columns} x {rows} pixels" + (f" in {frames[0]} frames" if frames else "")
    again = ", replacing what was there" if replaced else ""
    yield f"wrote {made.files[0]}: mask of {size}, {made.bits} bits a pixel{again}"
    yield from (f"wrote {path}" for path in made.files[1:])
    yield ""
    rows_of = [(f"{one.level:g}", one.ones, number(one.low), number(one.lowest)) for one in made.levels]
    yield from aligned(("level", "ones", "below f/2", "below f/4"), rows_of)
    of = "of the first frame" if frames else "of the patterns"
    yield f"power {of} below parts of the principal frequency f, where random pixels have 1"


def mask_record(made: ExportedMask) -> dict[str, Any]:
    """Return the same as plain values for JSON."""
    return {
        "files": [str(path) for path in made.files],
        "shape": made.ranks.shape,
        "bits": made.bits,
        "levels": [vars(one) for one in made.levels],
        "remarks": made.remarks,
    }
