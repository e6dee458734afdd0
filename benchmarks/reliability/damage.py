"""Damage to files: bits, bytes, lines, numbers, counts and headers, each kind a small function."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from functools import cache

import numpy as np

from gbnbench.benchmarks.reliability.strict_packed import PACKERS

Damage = Callable[[bytes, np.random.Generator], bytes]

_NUMBER = re.compile(rb"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")
_WHOLE = re.compile(rb"(?<![0-9.eE+-])[0-9]+(?![0-9.eE])")
_WORD = re.compile(rb"[^\s,;\"]+")
_NUMBERS = (
    b"nan", b"NaN", b"inf", b"-inf", b"Infinity", b"1e999", b"-1e999", b"1e-999", b"1e308", b"-1",
    b"1.0000001", b"0.99999999999999999999", b"-0.0", b"-1e-9", b"0x1p-1", b"1_0", b"0,5", b"0..5", b"5e",
    b"", b"NA", b"null", b"true", b"99999999999999999999999", b"4294967296", b"-2147483649", b"0.5f",
    b"1/2", b"\xd9\xa1", b"0.5\x00",
)  # fmt: skip
_COUNTS = (
    b"0", b"1", b"2", b"3", b"-1", b"7", b"999999999", b"2147483648", b"9223372036854775808",
    b"1" + b"0" * 30, b"1e3", b"2.0", b"+3", b"",
)  # fmt: skip
_PIECES = (
    b"\n", b"\r\n", b"\r", b"\n\n", b"\n#\n", b"#", b"%", b",", b";", b"\t", b" ", b"\0", b"\xff", b'"',
    b"'", b"[", b"]", b"{", b"}", b"\xef\xbb\xbf", b"\xc2\xa0", b"x", b"p\n", b"set", b"nan", b"1", b"0.5",
    b"0.5 0.5\n", b"end_header\n", b"ITEM: ATOMS", b"\x93NUMPY", b"PK\x03\x04", b"\x1f\x8b",
)  # fmt: skip


def _at(data: bytes, rng: np.random.Generator) -> int:
    return int(rng.integers(len(data) + 1))


def _flip_bits(data: bytes, rng: np.random.Generator) -> bytes:
    spoilt = bytearray(data)
    for at in rng.integers(len(data), size=rng.integers(1, 5)) if data else ():
        spoilt[at] ^= 1 << int(rng.integers(8))
    return bytes(spoilt)


def _truncate(data: bytes, rng: np.random.Generator) -> bytes:
    return data[: _at(data, rng)]


def _behead(data: bytes, rng: np.random.Generator) -> bytes:
    return data[_at(data, rng) :]


def _insert_bytes(data: bytes, rng: np.random.Generator) -> bytes:
    at = _at(data, rng)
    return data[:at] + _PIECES[rng.integers(len(_PIECES))] + data[at:]


def _overwrite_bytes(data: bytes, rng: np.random.Generator) -> bytes:
    at, piece = _at(data, rng), _PIECES[rng.integers(len(_PIECES))]
    return data[:at] + piece + data[at + len(piece) :]


def _delete_bytes(data: bytes, rng: np.random.Generator) -> bytes:
    at = _at(data, rng)
    return data[:at] + data[at + int(rng.integers(1, 20)) :]


def _double_bytes(data: bytes, rng: np.random.Generator) -> bytes:
    at = _at(data, rng)
    return data[: at + int(rng.integers(1, 40))] + data[at:]


def _zero_stretch(data: bytes, rng: np.random.Generator) -> bytes:
    """Zeros, as a file has them where the disk lost a block."""
    at, length = _at(data, rng), int(rng.integers(1, 64))
    return data[:at] + bytes(min(length, len(data) - at)) + data[at + length :]


def _edit_lines(edit: Callable[[list[bytes], int, int], None]) -> Damage:
    def damage(data: bytes, rng: np.random.Generator) -> bytes:
        lines = data.splitlines(keepends=True) or [b""]
        one, other = (int(k) for k in rng.integers(len(lines), size=2))
        edit(lines, one, other)
        return b"".join(lines)

    return damage


def _delete_line(lines: list[bytes], one: int, _: int) -> None:
    del lines[one]


def _double_line(lines: list[bytes], one: int, other: int) -> None:
    lines.insert(other, lines[one])


def _swap_lines(lines: list[bytes], one: int, other: int) -> None:
    lines[one], lines[other] = lines[other], lines[one]


def _replace(pattern: re.Pattern[bytes], instead: Sequence[bytes]) -> Damage:
    def damage(data: bytes, rng: np.random.Generator) -> bytes:
        found = list(pattern.finditer(data))
        if not found:
            return _overwrite_bytes(data, rng)
        match = found[rng.integers(len(found))]
        return data[: match.start()] + instead[int(rng.integers(len(instead)))] + data[match.end() :]

    return damage


def _swap_numbers(data: bytes, rng: np.random.Generator) -> bytes:
    found = list(_NUMBER.finditer(data))
    if len(found) < 2:
        return _flip_bits(data, rng)
    a, b = sorted(int(k) for k in rng.choice(len(found), 2, replace=False))
    one, other = found[a], found[b]
    return data[: one.start()] + other[0] + data[one.end() : other.start()] + one[0] + data[other.end() :]


def _change_header(data: bytes, rng: np.random.Generator) -> bytes:
    """Another word among the first few."""
    found = list(_WORD.finditer(data[:200]))[:12]
    if not found:
        return _flip_bits(data, rng)
    match, words = found[rng.integers(len(found))], (*_PIECES, *_COUNTS, *(m[0] for m in found))
    return data[: match.start()] + words[rng.integers(len(words))] + data[match.end() :]


def _other_line_ends(data: bytes, rng: np.random.Generator) -> bytes:
    return data.replace(b"\n", (b"\r\n", b"\r", b"\n\r", b"\x0c", b"\n\n")[rng.integers(5)])


def _twice(data: bytes, _: np.random.Generator) -> bytes:
    return data + data


DAMAGES: dict[str, Damage] = {
    "bits flipped": _flip_bits,
    "end cut off": _truncate,
    "beginning cut off": _behead,
    "bytes inserted": _insert_bytes,
    "bytes overwritten": _overwrite_bytes,
    "bytes deleted": _delete_bytes,
    "bytes doubled": _double_bytes,
    "stretch of zeros": _zero_stretch,
    "line deleted": _edit_lines(_delete_line),
    "line doubled": _edit_lines(_double_line),
    "lines swapped": _edit_lines(_swap_lines),
    "number replaced": _replace(_NUMBER, _NUMBERS),
    "numbers swapped": _swap_numbers,
    "count changed": _replace(_WHOLE, _COUNTS),
    "header changed": _change_header,
    "other line ends": _other_line_ends,
    "file twice": _twice,
}

_BOMB = 1 << 28  # bytes that a bomb unpacks to, more than a trial's limit


@cache
def bomb(packing: str) -> bytes:
    """Return a small packed file that unpacks to 256 MB of points, one packed stream after the other.

    Parameters
    ----------
    packing : str
        One of ``PACKERS``.

    Returns
    -------
    bytes
    """
    piece = b"0.5 0.25\n" * (1 << 18)
    return PACKERS[packing](piece) * (_BOMB // len(piece) + 1)
