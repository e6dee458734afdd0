"""Work of ``gbnbench spectrum``: reads the sets, plans the spectra, computes them, writes or prints them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import click
import numpy as np

from gbnbench.analysis.spectrum.evaluators.kept_memory import KEPT_BYTES
from gbnbench.analysis.spectrum.settings import SpectrumSettings
from gbnbench.analysis.spectrum.spectrum_plan import SpectrumPlan
from gbnbench.cli.json_text import json_text
from gbnbench.cli.point_files import naming, read_torus
from gbnbench.cli.share_progress import share_bar
from gbnbench.cli.spectrum_output import check_format, places, write
from gbnbench.cli.spectrum_text import as_record, as_text
from gbnbench.core.errors import InputError
from gbnbench.core.memory import PROCESS_BYTES
from gbnbench.core.number_text import duration
from gbnbench.core.sides import Sides, as_sides
from gbnbench.core.torus import FloatArray
from gbnbench.io.lists import read_weights
from gbnbench.io.points import ReadingOptions

SLOW = 3.0  # expected seconds that are said beforehand
LARGE = 1 << 20  # points of a set whose memory is said beforehand


@dataclass(frozen=True)
class LabelledSets:
    """Point sets that give one spectrum.

    Attributes
    ----------
    label : str
        For the user.
    sources : tuple of str
        The files, and which of their sets.
    x : (realizations, n, d) float64
        Points.
    sides : tuple of d floats or None
        Sides of their torus, of volume 1; None for a cube.
    """

    label: str
    sources: tuple[str, ...]
    x: FloatArray
    sides: Sides | None = None


def read_sets(files: Sequence[Path], reading: ReadingOptions, *, each: bool) -> list[LabelledSets]:
    """Read every set of the files: one entry a set, or one of all, which then agree in n and d.

    Parameters
    ----------
    files : sequence of Path
        Point-set files.
    reading : ReadingOptions
        How they are read.
    each : bool
        Whether every set has a spectrum of its own.

    Returns
    -------
    list of LabelledSets

    Raises
    ------
    FormatError
        If a file cannot be read.
    InputError
        If sets that are to be averaged differ in n, d or the sides of their torus.
    """
    names: list[str] = []
    sets: list[FloatArray] = []
    boxes: list[Sides | None] = []
    for path in files:
        read = read_torus(path, reading)
        found = read.sets
        names += [f"{path}, set {k}" if len(found) > 1 else str(path) for k in range(len(found))]
        sets += found
        boxes += [as_sides(read.sides, x.shape[1]) for x in found]
    if each or not sets:
        return [
            LabelledSets(name, (name,), x[None], box) for name, x, box in zip(names, sets, boxes, strict=True)
        ]
    for name, x, box in zip(names, sets, boxes, strict=True):
        if box != boxes[0]:
            raise InputError(
                f"only sets of one torus are averaged: the box of {name} has other sides than that of "
                f"{names[0]}; --each gives a spectrum of each"
            )
        if x.shape != sets[0].shape:
            raise InputError(
                f"only sets of one size are averaged: {names[0]} has n={len(sets[0])}, d={sets[0].shape[1]}, "
                f"{name} has n={len(x)}, d={x.shape[1]}; --each gives a spectrum of each"
            )
    more = f" and {len(files) - 1} more" if len(files) > 1 else ""
    stacked = np.stack(sets) if len(sets) > 1 else sets[0][None]  # a single set may be mapped from its file
    return [LabelledSets(f"{files[0]}{more}", tuple(names), stacked, boxes[0])]


def explain(settings: SpectrumSettings, sets: Sequence[LabelledSets], weights: Path | None) -> None:
    """Print the plan of each size of sets, having checked the weights.

    Parameters
    ----------
    settings : SpectrumSettings
        Which frequencies, how exact.
    sets : sequence of LabelledSets
        One for each spectrum.
    weights : Path, optional
        File of the points' weights.

    Raises
    ------
    GbnbenchError
        If the weights do not fit, or no evaluator can do it.
    """
    _weights(weights, sets)
    alike: dict[tuple[tuple[int, ...], Sides | None], list[LabelledSets]] = {}
    for one in sets:
        alike.setdefault((one.x.shape, one.sides), []).append(one)
    for ((realizations, n, d), sides), same in alike.items():
        more = f" and {len(same) - 1} more, each" if len(same) > 1 else ""
        click.echo(f"{same[0].label}{more}:")
        plans = settings.plans(n, d, realizations, sides)
        for plan in plans:
            click.echo(plan)
        if n > LARGE:
            click.echo(f"  the process takes {_peak(same[:1], plans)}")


def compute(
    settings: SpectrumSettings,
    sets: Sequence[LabelledSets],
    weights: Path | None,
    out: Path | None,
    *,
    each: bool,
    as_json: bool,
    quiet: bool,
) -> None:
    """Compute the spectra, and write or print them.

    Parameters
    ----------
    settings : SpectrumSettings
        Which frequencies, how exact.
    sets : sequence of LabelledSets
        One for each spectrum.
    weights : Path, optional
        File of the points' weights.
    out : Path, optional
        File to write; without it the spectra are printed.
    each : bool
        Whether every set has a file of its own.
    as_json : bool
        Whether what is printed is JSON.
    quiet : bool
        Whether to leave out progress and the time expected.

    Raises
    ------
    GbnbenchError
        If something is wrong with any of it, before the first is found where that can be told.
    """
    plans = [settings.plans(one.x.shape[1], one.x.shape[2], len(one.x), one.sides) for one in sets]
    every = [plan for of_set in plans for plan in of_set]
    if out is not None:
        for plan in every:
            check_format(out, plan, shells=settings.shells)
    weighing = _weights(weights, sets)
    seconds = sum(plan.seconds for plan in every)
    if (seconds > SLOW or any(one.x.shape[1] > LARGE for one in sets)) and not quiet:
        label = every[0].chosen.evaluator.label
        click.echo(f"gbnbench: about {duration(seconds)}, {_peak(sets, every)}: {label}", err=True)
    paths = [] if out is None else places(out, len(sets), each=each)
    written, printed = 0, []
    try:
        for k, (one, of_set, w) in enumerate(zip(sets, plans, weighing, strict=True)):
            if weights is not None:
                one = replace(one, label=f"{one.label} weighted by {weights}")
            if settings.sigma is not None:
                one = replace(one, label=f"{one.label} filtered by a Gaussian of {settings.sigma:g} spacings")
            with (
                naming(Path(one.label)),
                share_bar(sum(plan.request.frequencies for plan in of_set), "frequencies", quiet) as tell,
            ):
                result = settings.evaluate(one.x, w, tell, one.sides)
            if paths:
                try:
                    write(paths[k], result, one.label, one.sources)
                except Exception:
                    click.echo(as_text(result, one.label))  # what was found is shown, if it cannot be kept
                    raise
                written += 1
            elif as_json:
                printed.append(as_record(result, one.label))
            else:
                click.echo(("\n" if k else "") + as_text(result, one.label))
        if as_json:
            click.echo(json_text(printed))
    except KeyboardInterrupt:
        if not paths:
            raise
        are = "is" if written == 1 else "are"
        raise KeyboardInterrupt(
            f"{written} of {len(paths)} {'file' if len(paths) == 1 else 'files'} {are} written and kept"
        ) from None


def _peak(sets: Sequence[LabelledSets], plans: Sequence[SpectrumPlan]) -> str:
    """Say how much memory the process takes at most.

    It is that of all points, of the plan that takes most, and of the others as far as their memory is kept.
    """
    points = sum(one.x.nbytes for one in sets)
    *others, largest = sorted({plan.request: plan.bytes for plan in plans}.values())
    most = PROCESS_BYTES + points + largest + min(sum(others), KEPT_BYTES)
    return f"{most / 1e9:.2g} GB of memory at most"


def _weights(path: Path | None, sets: Sequence[LabelledSets]) -> list[FloatArray | None]:
    """Weights of each entry, read once; several entries of one n may have weights of their own."""
    if path is None:
        return [None] * len(sets)
    if len(sets) == 1:
        realizations, n, _ = sets[0].x.shape
        return [read_weights(path, n, realizations)]
    sizes = {one.x.shape[1] for one in sets}
    if len(sizes) > 1:
        raise InputError(f"weights are for sets of one size; these have n = {sorted(sizes)}")
    found = read_weights(path, sizes.pop(), len(sets))
    return list(found) if found.ndim == 2 else [found] * len(sets)
