"""Damaged point files: each gives the points that a strict reading finds, or is refused in words."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from pathlib import Path

import numpy as np

from gbnbench.benchmarks.reliability.damage import DAMAGES, bomb
from gbnbench.benchmarks.reliability.seed_files import FORMATS, SeedFile, seed_files
from gbnbench.benchmarks.reliability.strict_arrays import strict_rps
from gbnbench.benchmarks.reliability.strict_packed import PACKERS, unpacking
from gbnbench.benchmarks.reliability.strict_text import strict_text
from gbnbench.benchmarks.reliability.strict_words import NoPointsError, Sets, UndecidedError
from gbnbench.benchmarks.reliability.trial import FAULT, Trials, shortened, summed
from gbnbench.benchmarks.reliability.watched_reading import Reading, watched_reading
from gbnbench.core.atomic_write import write_whole
from gbnbench.io.points import ReadingOptions
from gbnbench.io.points.formats.registry import SUFFIXES

MEGABYTES = 256.0  # that a reading may hold beyond the file, which has at most 64 MB
REFUSED, REFUSED_ALONE = "refused, by the strict reading too", "refused in words"
READ, READ_ALONE = "read as the strict reading reads it", "read, points in [0, 1)"
STRICTER = "refused in words, where the strict reading finds points"

_DAMAGED, _JOINED, _PACKED, _CALLED = "damaged", "joined to another file", "packed", "under another suffix"
_OPTIONS, _BOMB = "with reading options", "a bomb of 256 MB"
_READING = (
    ReadingOptions(columns=("x", "y")),
    ReadingOptions(columns=("2", "1")),
    ReadingOptions(period=(2.0,)),
    ReadingOptions(period=(2.0, 3.0)),
    ReadingOptions(bounds=(-1.0, 2.0), wrap=True),
    ReadingOptions(bounds=(0.0, 1e-300)),
    ReadingOptions(array="points"),
    ReadingOptions(raw="float32,3"),
    ReadingOptions(raw=">float64,2"),
    ReadingOptions(raw="uint8,2", period=(256.0,)),
    ReadingOptions(wrap=True),
)
# how a file begins that another format claims
_BEGINNINGS = (
    b"[", b"{", b"ITEM:", b"ply\n", b"ply\r", b"\x93NUMPY", b"PK", b"%!PS", b"\x1f\x8b", b"BZh", b"\xfd7zXZ",
    b"\x80",
)  # fmt: skip

_NUMERALS = {*b"0123456789+-.eE \t\r\n,#"}  # floats that are these bytes alone are text

Strict = Callable[[bytes], Sets]


def damaged_files(format_name: str, piece: int, count: int, faults: Path | None = None) -> list[Trials]:
    """Damage files of one format in many ways, and read each.

    Parameters
    ----------
    format_name : str
        One of ``FORMATS``.
    piece : int
        Names the stream of random numbers.
    count : int
        Files.
    faults : Path, optional
        Folder that keeps files with which something went wrong.

    Returns
    -------
    list of Trials
        By what was done and what came of it.
    """
    rng = np.random.default_rng(np.random.SeedSequence(12, spawn_key=(FORMATS.index(format_name), piece)))
    found: list[Trials] = []
    with tempfile.TemporaryDirectory() as folder:
        for number in range(count):
            tried, suffix, data, strict, options = _draw(format_name, rng)
            path = Path(folder) / f"damaged{suffix}"
            path.write_bytes(data)
            one = _judged(format_name, tried, path, data, strict, options)
            path.unlink()
            if (
                faults is not None
                and one.verdict == FAULT
                and not any(f.outcome == one.outcome for f in found)
            ):
                write_whole(faults / f"{format_name}-{piece}-{number}{suffix}", data)
            found.append(one)
    return summed(found)


def _draw(
    format_name: str, rng: np.random.Generator
) -> tuple[str, str, bytes, Strict | None, ReadingOptions]:
    """Draw what is done to which file: its kind in words, suffix, bytes, strict reading, reading options."""
    seeds = seed_files(format_name)
    seed = seeds[rng.integers(len(seeds))]
    if rng.random() < 0.001:
        packing = sorted(PACKERS)[rng.integers(len(PACKERS))]
        return _BOMB, seed.suffix + packing, bomb(packing), None, ReadingOptions()
    data, tried = seed.data, _DAMAGED
    strict: Strict | None = seed.strict
    if rng.random() < 0.08:
        tried, data = _JOINED, data + _another(seeds, rng).data
    for _ in range(1 + min(3, rng.geometric(0.6) - 1)):
        data = list(DAMAGES.values())[rng.integers(len(DAMAGES))](data, rng)
    suffix = seed.suffix
    kind = rng.random()
    if kind < 0.06 and format_name != "packed":
        packing = sorted(PACKERS)[rng.integers(len(PACKERS))]
        return _PACKED, suffix + packing, PACKERS[packing](data), unpacking(packing, _guarded(seed)), _NONE
    if kind < 0.12:
        other = (*SUFFIXES, "", ".log", ".TXT", ".gz", ".json")[rng.integers(len(SUFFIXES) + 5)]
        return _CALLED, other, data, None, _NONE
    if kind < 0.22:
        return _OPTIONS, suffix, data, None, _READING[rng.integers(len(_READING))]
    if strict is not None:
        strict = _guarded(seed)
    return tried, suffix, data, strict, _NONE


_NONE = ReadingOptions()


def _another(seeds: tuple[SeedFile, ...], rng: np.random.Generator) -> SeedFile:
    """Another file, mostly of the same format."""
    if rng.random() < 0.3:
        seeds = seed_files(FORMATS[rng.integers(len(FORMATS))])
    return seeds[rng.integers(len(seeds))]


def _guarded(seed: SeedFile) -> Strict:
    """Make the strict reading of a file leave what became another format undecided."""

    def read(data: bytes) -> Sets:
        begins = data.removeprefix(b"\xef\xbb\xbf").lstrip()
        now = next((b for b in _BEGINNINGS if begins.startswith(b)), b"")
        was = next((b for b in _BEGINNINGS if seed.data.startswith(b)), b"")
        numerals = seed.strict is strict_rps and {*data} <= _NUMERALS
        if now != was or numerals or (seed.strict is strict_text and _names_elements(data)):
            raise UndecidedError
        return seed.strict(data)

    return read


def _names_elements(data: bytes) -> bool:
    """Whether text may pass for XYZ: its third line begins with a letter, or its second tells a cell."""
    lines = data.removeprefix(b"\xef\xbb\xbf").splitlines()
    return len(lines) > 2 and (lines[2].lstrip()[:1].isalpha() or b"=" in lines[1])


def _judged(
    format_name: str, tried: str, path: Path, data: bytes, strict: Strict | None, options: ReadingOptions
) -> Trials:
    """Read a file and judge what came of it."""
    reading = watched_reading(path, options)
    outcome, note = _fault(reading, path), ""
    if not outcome:
        outcome = _compared(reading, data, strict)
    verdict = FAULT if outcome not in _WELL else Trials.verdict
    if verdict == FAULT:
        note = shortened(f"{reading.crash or reading.refusal} {data[:200]!r}")
    return Trials(format_name, tried, outcome, verdict, 1, note, reading.seconds, reading.megabytes)


def _fault(reading: Reading, path: Path) -> str:
    """Say what is wrong with a reading, whatever the file holds; empty where nothing is."""
    if reading.crash:
        return "no refusal but a crash"
    if reading.megabytes > MEGABYTES:
        return f"more than {MEGABYTES:g} MB of memory"
    if reading.sets is None:
        named = reading.refusal.startswith(str(path)) and "\n" not in reading.refusal
        return "" if named else "refused without the file's name, or in several lines"
    sound = all(
        x.dtype == np.float64 and x.ndim == 2 and x.size and (x >= 0).all() and (x < 1).all()
        for x in reading.sets.sets
    )
    return "" if sound and reading.sets.sets else "read, but points are not finite or not in [0, 1)"


def _compared(reading: Reading, data: bytes, strict: Strict | None) -> str:
    """Compare with the strict reading, where there is one and it can decide."""
    expected: Sets | None = None
    undecided = strict is None
    if strict is not None:
        try:
            expected = strict(data)
        except NoPointsError:
            pass
        except UndecidedError:
            undecided = True
    if undecided:
        return REFUSED_ALONE if reading.sets is None else READ_ALONE
    if reading.sets is None:
        return REFUSED if expected is None else STRICTER
    if expected is None:
        return "read, where the strict reading refuses"
    found = [[tuple(row) for row in x.tolist()] for x in reading.sets.sets]
    return READ if found == expected else "read, but other points than the strict reading finds"


_WELL = frozenset((REFUSED, REFUSED_ALONE, READ, READ_ALONE, STRICTER))
