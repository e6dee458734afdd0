"""Sound files of every format, from which damaged ones are made, each with its strict reading."""

from __future__ import annotations

import io
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np

from gbnbench.benchmarks.reliability.strict_arrays import strict_npy, strict_npz, strict_rps
from gbnbench.benchmarks.reliability.strict_formats import (
    strict_edat,
    strict_eps,
    strict_json,
    strict_lammps,
    strict_ply,
    strict_xyz,
)
from gbnbench.benchmarks.reliability.strict_packed import PACKERS, unpacking
from gbnbench.benchmarks.reliability.strict_text import strict_text
from gbnbench.benchmarks.reliability.strict_words import Sets
from gbnbench.io.points import PointSets
from gbnbench.io.points.writer import WRITTEN


@dataclass(frozen=True)
class SeedFile:
    """A sound file.

    Attributes
    ----------
    suffix : str
        Of its name.
    data : bytes
        Its content.
    strict : callable
        Reads a file of the format, or refuses it.
    """

    suffix: str
    data: bytes
    strict: Callable[[bytes], Sets]


_PLANE = np.random.default_rng(7).random((3, 5, 2)).round(4)
_SPACE = np.arange(90).reshape(2, 15, 3) * 11 % 64 / 64
_LINE = _PLANE[0, :, :1]
_HIGH = np.random.default_rng(8).random((6, 5))
_SIDES, _LOW = (2.0, 0.5, 4.0), (-1.0, 0.25, 3.0)


def _boxed(x: np.ndarray, toroidal: bool | None) -> PointSets:
    d = x.shape[-1]
    return PointSets(list(x), _SIDES[:d], _LOW[:d], toroidal)


def _written(
    suffix: str, strict: Callable[[bytes], Sets], *contents: np.ndarray | PointSets
) -> list[SeedFile]:
    sets = [x if isinstance(x, PointSets) else PointSets(list(x)) for x in contents]
    return [SeedFile(suffix, WRITTEN[suffix].write[suffix](one), strict) for one in sets]


_TEXTS: tuple[tuple[str, bytes], ...] = (
    (".txt", b"0.5 0.25\n0 1\n1.0 0.125"),
    (".txt", b"0.5\n0.25\n0.75\n"),
    (".txt", b"3\n0.25\n1\n0\n2\n.5\n1e-1\n"),
    (".txt", b"2 3\n0.25 0.5 0.125\n1 0 0.5\n1 3\n.5 1e-1 0\n"),
    (".txt", b'"x" "y"\n"1" 0.5 0.25\n"2" 0.125 1.0\n'),
    (".txt", b"x\ty\n0,5\t0,25\n0,125\t,75\n"),
    (".dat", b"# made by hand\r\n0 0\r\n0.5 .5\r\n#\r\n\r\n#\r\n0.5 1e-2\r\n"),
    (".csv", b"0.5,0.25\n0.125, 1.0\n"),
    (".csv", b"\xef\xbb\xbfx;y\r\n0,5;0,25\r\n0,125;,75\r\n"),
    (".csv", b'"x","y"\n"0.5","0.25"\n"0.125","1.0"\n'),
    (".csv", b",x,y\n0,0.5,0.25\n1,0.125,1.0\n2,0,1\n"),
    (".csv", b"set,x,y\n0,0.5,0.25\n0,0.125,1.0\n1,0,1\n"),
)
_EPS = (
    b"%!PS-Adobe-3.1 EPSF-3.0\n%%HiResBoundingBox: -3 -3 515 515\n/radius { 0.00585938 } def\n"
    b"/p { radius 0 360 arc closepath fill stroke } def\ngsave 512 512 scale\n0 setgray\n"
    b"0.600459 0.549315 p\n4.62451e-06 1 p\n0.5 0.25 p\ngrestore\n"
)


def _text() -> list[SeedFile]:
    return [
        *_written(".txt", strict_text, _PLANE[:1], _PLANE, _SPACE, _LINE[None], _HIGH[None]),
        *_written(".dat", strict_text, _PLANE[:1], _SPACE),
        *_written(".csv", strict_text, _PLANE[:1], _PLANE, _LINE[None]),
        *_written(".tsv", strict_text, _PLANE),
        *(SeedFile(suffix, data, strict_text) for suffix, data in _TEXTS),
    ]


def _npy() -> list[SeedFile]:
    seeds = []
    for x in (
        _PLANE,
        _PLANE[0],
        _PLANE.astype(np.float32),
        _PLANE[0].astype(">f8"),
        _HIGH.astype(np.float16),
    ):
        file = io.BytesIO()
        np.save(file, x)
        seeds.append(SeedFile(".npy", file.getvalue(), strict_npy))
    wide = io.BytesIO()
    np.lib.format.write_array(wide, _SPACE, version=(3, 0))
    return [*seeds, SeedFile(".npy", wide.getvalue(), strict_npy)]


def _npz() -> list[SeedFile]:
    packed = io.BytesIO()
    np.savez_compressed(packed, points=_PLANE[0], other=np.eye(3))
    ragged = PointSets([_PLANE[0], _PLANE[1][:2], _PLANE[2][:1]])
    return [
        *_written(".npz", strict_npz, _PLANE[:1], _SPACE, ragged),
        SeedFile(".npz", packed.getvalue(), strict_npz),
    ]


def _ply() -> list[SeedFile]:
    seeds = _written(".ply", strict_ply, _PLANE[:1], _SPACE[:1])
    for order, form in (("little", "<f4"), ("big", ">f8")):
        kind = "float" if form[-1] == "4" else "double"
        head = f"ply\nformat binary_{order}_endian 1.0\nelement vertex 4\n" + "".join(
            f"property {kind} {axis}\n" for axis in "xyz"
        )
        seeds.append(
            SeedFile(
                ".ply", f"{head}end_header\n".encode() + _SPACE[0, :4].astype(form).tobytes(), strict_ply
            )
        )
    return seeds


def _packed() -> list[SeedFile]:
    inner = (*_text(), *_json(), *_npy()[:2])
    return [
        SeedFile(seed.suffix + packing, pack(seed.data), unpacking(packing, seed.strict))
        for packing, pack in PACKERS.items()
        for seed in inner
    ]


def _json() -> list[SeedFile]:
    return _written(
        ".json",
        strict_json,
        _PLANE[:1],
        _PLANE,
        _boxed(_SPACE, True),
        _boxed(_PLANE, False),
        _boxed(_SPACE, None),
    )


@cache
def seed_files(format_name: str) -> tuple[SeedFile, ...]:
    """Return the sound files of a format.

    Parameters
    ----------
    format_name : str
        One of ``FORMATS``.
    """
    return tuple(_SEEDS[format_name]())


_SEEDS: dict[str, Callable[[], list[SeedFile]]] = {
    "text": _text,
    "npy": _npy,
    "npz": _npz,
    "eps": lambda: [SeedFile(".eps", _EPS, strict_eps)],
    "rps": lambda: [
        SeedFile(".rps", np.random.default_rng(n).random((n, 2)).astype("<f4").tobytes(), strict_rps)
        for n in (1, 3, 40)
    ],
    "ply": _ply,
    "lammps": lambda: _written(
        ".lammpstrj", strict_lammps, _PLANE, _SPACE, _boxed(_SPACE, True), _boxed(_PLANE, False)
    ),
    "edat": lambda: _written(
        ".edat", strict_edat, _PLANE, _LINE[None], _boxed(_SPACE, True), _boxed(_PLANE, False)
    ),
    "json": _json,
    "xyz": lambda: [
        *_written(".xyz", strict_xyz, _SPACE),
        *_written(".extxyz", strict_xyz, _boxed(_SPACE, True), _boxed(_SPACE[:1], False)),
    ],
    "packed": _packed,
}
FORMATS = tuple(_SEEDS)
