"""Point sets as text that keeps every bit: PSA's counts and rows, UTK's .dat, and .csv with names."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from gbnbench.core.torus import FloatArray
from gbnbench.io.points.point_sets import PointSets, seems_transposed


def _rows(points: FloatArray, separator: str, prefix: str = "") -> str:
    """Lines of the shortest literals that read back to the same bits."""
    return "".join(f"{prefix}{separator.join(map(repr, row))}\n" for row in points.tolist())


def _txt(x: PointSets) -> bytes:
    """PSA's count and rows; where d is not 2, the count and the dimension as the GBN authors' programs do."""
    heads = [f"{len(s)}\n" if s.shape[1] == 2 else f"{len(s)} {s.shape[1]}\n" for s in x.sets]
    return "".join(head + _rows(s, " ") for head, s in zip(heads, x.sets, strict=True)).encode()


def _dat(x: PointSets) -> bytes:
    """UTK's rows, sets parted by a line #; of few points of many dimensions it names the columns."""
    rows = [_rows(s, "\t") for s in x.sets]
    if not any(map(seems_transposed, x.sets)):
        return "#\n".join(rows).encode()
    names = "# " + "\t".join(f"x{a}" for a in range(x.sets[0].shape[1])) + "\n"
    return "".join(names + part for part in rows).encode()


def _separated(separator: str) -> Callable[[PointSets], bytes]:
    """Columns x0, x1, ..., and before them the set's number where there are several."""

    def write(x: PointSets) -> bytes:
        names = separator.join(f"x{a}" for a in range(x.sets[0].shape[1]))
        if len(x.sets) == 1:
            return f"{names}\n{_rows(x.sets[0], separator)}".encode()
        parts = [_rows(s, separator, f"{k}{separator}") for k, s in enumerate(x.sets)]
        return (f"set{separator}{names}\n" + "".join(parts)).encode()

    return write


WRITERS: Mapping[str, Callable[[PointSets], bytes]] = {
    ".txt": _txt,
    ".dat": _dat,
    ".csv": _separated(","),
    ".tsv": _separated("\t"),
}
