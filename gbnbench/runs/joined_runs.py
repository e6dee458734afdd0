"""Several finished comparisons as one: their sources side by side, judged against the first run."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from gbnbench.core.errors import InputError
from gbnbench.runs.baseline import judge
from gbnbench.runs.comparison_folder import read_run
from gbnbench.runs.comparison_result import Run, SourceResult

SETTINGS = ("version", "seed", "device")  # told once where all runs share them, else each with its run


@dataclass(frozen=True)
class JoinedRuns:
    """Finished comparisons of the same sizes and dimensions.

    Attributes
    ----------
    names : tuple of str
        The shortest ends of their paths that tell them apart.
    runs : tuple of Run
        As they were read; the first is the baseline of the others.
    run : Run
        All sources together, those of one label one after another, with verdicts against the first run.
    notes : tuple of str
        What stands in the way of a comparison: sources that one of two runs lacks, single realizations,
        other versions, devices or largest frequencies.
    """

    names: tuple[str, ...]
    runs: tuple[Run, ...]
    run: Run
    notes: tuple[str, ...]

    def source(self, label: str, n: int, d: int, number: int) -> SourceResult | None:
        """Return a source as it stands in the joined run.

        Parameters
        ----------
        label : str
            Its label in its own run.
        n, d : int
            Its size and dimension.
        number : int
            Which run.

        Returns
        -------
        SourceResult or None
            None where that run lacks it.
        """
        for source in self.run.sources:
            of, run = self.run.series[source.key]
            if (of, source.n, source.d, run) == (label, n, d, number):
                return source
        return None


def join_runs(folders: Sequence[str | Path]) -> JoinedRuns:
    """Read finished comparisons and put their sources side by side.

    Parameters
    ----------
    folders : sequence of path
        Two or more run folders.

    Returns
    -------
    JoinedRuns

    Raises
    ------
    InputError
        If one is no finished comparison, is given twice, or is of other sizes or dimensions than the first.
    FormatError
        If a file in one is missing or was changed.
    """
    paths = [Path(folder) for folder in folders]
    places = [path.resolve() for path in paths]
    for k, place in enumerate(places):
        if place in places[:k]:
            raise InputError(f"{paths[k]} is given twice; a report sets different runs side by side")
    if len(paths) < 2:
        raise InputError(f"runs are compared from two on; got {len(paths)}")
    runs = tuple(read_run(path) for path in paths)
    for path, run in zip(paths, runs, strict=True):
        if _sizes(run) != _sizes(runs[0]):
            raise InputError(
                f"runs side by side need the same n and d; {paths[0]} has {_say(runs[0])}, "
                f"{path} has {_say(run)}"
            )
    return joined(_names(places), runs)


def joined(names: Sequence[str], runs: Sequence[Run]) -> JoinedRuns:
    """Put the sources of runs side by side.

    Parameters
    ----------
    names : sequence of str
        What the runs are called.
    runs : sequence of Run
        With the same sizes and dimensions; the first is the baseline of the others.

    Returns
    -------
    JoinedRuns
    """
    sources: list[tuple[int, SourceResult]] = [
        (k, source) for k, one in enumerate(runs) for source in one.sources
    ]
    order = list(dict.fromkeys((s.n, s.d, s.label) for _, s in sources))
    sources.sort(key=lambda one: order.index((one[1].n, one[1].d, one[1].label)))
    verdicts: dict[tuple[str, str], str] = {}
    notes: list[str] = []
    for k, later in enumerate(runs[1:], 1):
        changes, told = judge(later, runs[0])
        verdicts |= {(_key(k, change.key), change.measure): change.verdict for change in changes}
        notes += [f"{names[k]}: {note.replace('the baseline', names[0])}" for note in told]
    run = Run(
        _manifest(names, runs),
        tuple(replace(s, key=_key(k, s.key), label=f"{s.label} · {names[k]}") for k, s in sources),
        verdicts,
        {_key(k, s.key): (s.label, k) for k, s in sources},
    )
    return JoinedRuns(tuple(names), tuple(runs), run, (*notes, *_differences(names, runs)))


def _key(number: int, key: str) -> str:
    return f"{number}/{key}"


def _sizes(run: Run) -> set[tuple[int, int]]:
    return {(source.n, source.d) for source in run.sources}


def _say(run: Run) -> str:
    return ", ".join(f"n={n} d={d}" for n, d in sorted(_sizes(run)))


def _names(places: Sequence[Path]) -> tuple[str, ...]:
    """Shorten paths to the fewest last parts that tell all of them apart."""
    for count in range(1, max(len(place.parts) for place in places) + 1):
        names = tuple("/".join(place.parts[-count:]) for place in places)
        if len(set(names)) == len(names):
            return names
    raise InputError("runs cannot be told apart by their paths")


def _manifest(names: Sequence[str], runs: Sequence[Run]) -> dict[str, Any]:
    """Return what all runs share by its name, and every manifest under ``runs``."""
    first = runs[0].manifest
    shared = {
        name: first[name]
        for name in SETTINGS
        if name in first and all(run.manifest.get(name) == first[name] for run in runs)
    }
    skipped = list(dict.fromkeys(line for run in runs for line in run.manifest.get("skipped") or ()))
    return {
        **shared,
        "skipped": skipped,
        "runs": {name: run.manifest for name, run in zip(names, runs, strict=True)},
    }


def _differences(names: Sequence[str], runs: Sequence[Run]) -> list[str]:
    """Say where runs differ in what decides numbers: version, device, largest frequency."""
    told = []
    for setting, word in (("version", "of gbnbench "), ("device", "")):
        values = {name: str(run.manifest.get(setting)) for name, run in zip(names, runs, strict=True)}
        if len(set(values.values())) > 1:
            each = "; ".join(f"{name}: {word}{value}" for name, value in values.items())
            told.append(f"the runs differ in their {setting} ({each})")
    reach: dict[tuple[str, int, int], set[int]] = {}
    for run in runs:
        for source in run.sources:
            reach.setdefault((source.label, source.n, source.d), set()).add(source.spectrum.fmax)
    for (label, n, d), found in reach.items():
        if len(found) > 1:
            told.append(f"{label} (n={n}, d={d}): spectra up to F = {', '.join(map(str, sorted(found)))}")
    return told
