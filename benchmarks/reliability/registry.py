"""The parts of the trials: what each tries, in how many pieces, and what the page says of it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from gbnbench.benchmarks.reliability.commands import COMMANDS
from gbnbench.benchmarks.reliability.files import damaged_files
from gbnbench.benchmarks.reliability.full_disk import full_disk, full_output, quota
from gbnbench.benchmarks.reliability.kills import kill_chain
from gbnbench.benchmarks.reliability.memory_limits import LIMITS, memory_limit
from gbnbench.benchmarks.reliability.planted_kernels import PLANTS, planted_kernel
from gbnbench.benchmarks.reliability.runtimes import RUNTIMES, runtime_trials
from gbnbench.benchmarks.reliability.seed_files import FORMATS
from gbnbench.benchmarks.reliability.together import crowd
from gbnbench.benchmarks.reliability.trial import Trials

FILES, QUICK_FILES = 4000, 150  # of a piece
FILE_PIECES = 3  # of a format
KILLS, QUICK_KILLS = 5, 2  # of a chain
CHAINS = 10  # of a command
DISKS, CROWDS = 4, 2  # of a command: full disks and quotas, and crowds of each size


@dataclass(frozen=True)
class Piece:
    """A call whose trials are kept together.

    Attributes
    ----------
    key : str
        Unique, such as ``files/npz/0``.
    function : callable
        Gives the trials.
    arguments : tuple
        Its arguments.
    """

    key: str
    function: Callable[..., list[Trials]]
    arguments: tuple[Any, ...]


@dataclass(frozen=True)
class Part:
    """A kind of trials.

    Attributes
    ----------
    name : str
        By which it is asked for.
    title : str
        On the page.
    says : str
        What is tried and what has to come of it.
    pieces : callable
        ``pieces(quick)``: its pieces, in order.
    """

    name: str
    title: str
    says: str
    pieces: Callable[[bool], list[Piece]]


def _files(quick: bool) -> list[Piece]:
    count = QUICK_FILES if quick else FILES
    return [
        Piece(f"files/{name}/{k}/{count}", damaged_files, (name, k, count))
        for k in range(1 if quick else FILE_PIECES)
        for name in FORMATS
    ]


def _kills(quick: bool) -> list[Piece]:
    count = QUICK_KILLS if quick else KILLS
    return [
        Piece(f"kills/{name}/{k}/{count}", kill_chain, (name, k, count))
        for k in range(1 if quick else CHAINS)
        for name in COMMANDS
    ]


def _disk(quick: bool) -> list[Piece]:
    trials = {
        f"{function.__name__}/{name}/{k}": (function, (name, k))
        for k in range(1 if quick else DISKS)
        for function in (full_disk, quota)
        for name in COMMANDS
    } | {f"full_output/{name}": (full_output, (name,)) for name in COMMANDS}
    return [Piece(f"disk/{key}", *called) for key, called in trials.items()]


def _together(quick: bool) -> list[Piece]:
    return [
        Piece(f"together/{name}/{size}/{k}", crowd, (name, size))
        for k in range(1 if quick else CROWDS)
        for size in (2, 4)
        for name in COMMANDS
    ]


def _memory(quick: bool) -> list[Piece]:
    return [
        Piece(f"memory/{name}/{limit / 1e6:.0f}", memory_limit, (name, limit))
        for limit in LIMITS[: 2 if quick else len(LIMITS)]
        for name in COMMANDS
    ]


def _runtimes(_: bool) -> list[Piece]:
    return [Piece(f"runtimes/{name}", runtime_trials, (name,)) for name in RUNTIMES]


def _plants(quick: bool) -> list[Piece]:
    return [
        Piece(f"plants/{name}", planted_kernel, (name,))
        for name in list(PLANTS)[: 2 if quick else len(PLANTS)]
    ]


PARTS = (
    Part(
        "files", "Damaged files",
        "Sound files of every format are damaged in one to four ways: bits flipped, ends cut off, bytes and "
        "lines inserted, deleted, doubled or swapped, numbers, counts and headers changed, two files "
        "joined, compressed, given another suffix, read with options that do not fit, or replaced by "
        "decompression bombs. Each file must either give the points that a strict reader in plain Python "
        "finds, which shares no code with the readers, or be refused in one line that names it. The points "
        "must be finite and in [0, 1), and reading may take at most 256 MB and 10 s.",
        _files,
    ),
    Part(
        "kills", "Kills",
        "A command is killed (SIGKILL) at a random moment, every other time with its workers, and started "
        "again, five times over. Every file that exists then must be complete, and the last run must end "
        "with the same bits as an undisturbed run, except for times of day and CPU times. In one chain of "
        "five no kernel is in the cache.",
        _kills,
    ),
    Part(
        "disk", "Full disks, quotas, full outputs",
        "Three limits are tried: a file system (tmpfs) of a random size up to what the command leaves, a "
        "largest file size (RLIMIT_FSIZE) set at a random moment, and /dev/full as the output. The command "
        "must report the problem with exit code 2; once there is room again, the same command must end with "
        "the same bits.",
        _disk,
    ),
    Part(
        "together", "Several at once",
        "The same command is started two or four times at once on one folder. One must work, the others "
        "must say who holds the folder or do the same work to the end, and the result must have the same "
        "bits as that of a single command.",
        _together,
    ),
    Part(
        "memory", "Little memory",
        "Address spaces (ulimit -v) are limited to 64 MB to 2 GB, most of them near what the libraries need "
        "to start. The command must end as without a limit, or say that it cannot.",
        _memory,
    ),
    Part(
        "runtimes", "OpenCL runtimes",
        "`gbnbench doctor` is run in full, and a spectrum is compared with numpy, with OpenCL runtimes of "
        "several makers.",
        _runtimes,
    ),
    Part(
        "plants", "Wrong kernels",
        "One mistake at a time is planted in the text of a kernel. `gbnbench doctor` must say that the "
        "device is not to be trusted, and name the kernel.",
        _plants,
    ),
)  # fmt: skip
