"""Errors met in the hard cases beside those stated, as a table.

python -m gbnbench.benchmarks.spectra.hard_table docs/hard_cases.md
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from gbnbench.analysis.precision import PrecisionName
from gbnbench.analysis.spectrum.error_model import Errors
from gbnbench.analysis.spectrum.evaluators.gridded.product import griddable
from gbnbench.analysis.spectrum.evaluators.gridded_fft.grid import AXES
from gbnbench.analysis.spectrum.evaluators.nufft.evaluator import NonuniformFFT
from gbnbench.analysis.spectrum.evaluators.nufft.transform import installed
from gbnbench.analysis.spectrum.evaluators.nufft.transform_library import DIMENSIONS
from gbnbench.analysis.spectrum.evaluators.registry import Method, title_of
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.benchmarks.spectra.hard_case import Frequencies, HardCase
from gbnbench.benchmarks.spectra.hard_cases import hard_cases
from gbnbench.benchmarks.timing.machine import Row
from gbnbench.core.atomic_write import write_whole
from gbnbench.core.results.resolution import resolvable_power
from gbnbench.core.results.spectrum import Spectrum
from gbnbench.core.torus import FloatArray
from gbnbench.opencl import runtime

PRECISIONS: tuple[PrecisionName, ...] = ("double", "float")
SLACK = 100  # a bound may exceed the largest error met at its n by so much
TYPICAL = 10  # the stated rms may be off by so much on scattered points
IDLE = 1e4  # a ratio from which on only its magnitude is told
NEAR = 1024  # |f_a| up to which float's coordinates hardly count; beyond, errors are compared apart
LISTED = {"numpy": "numpy direct sum"}  # what an evaluation is called where frequencies are listed
HEAD = """# Hard cases

This page lists point sets that bring out the errors of a periodogram, and the errors of every evaluation on
`{device}`.

Errors are those of the square root of power, |F| / sqrt(n). The reference values are closed forms, or come
from exact integer phases, long double cosines and exact sums (`benchmarks/spectra/reference.py`). A power P
is off by at most 2 sqrt(P) *bound* + *bound*^2.

- *largest*, *rms*: largest and root-mean-square error that occurred.
- *stated rms*: the error that the spectrum states as typical of scattered points.
- *bound*: the error that the spectrum states as the worst case.
- *over*: bound divided by the largest error of the row; at least 1 where the bound holds.
- *slack*: bound divided by the largest error of the method at that n, in any row of its table (rows up to
  |f_a| = {near} and rows beyond are treated separately); at most {slack} where the
  bound is not far too large.
- the last column: *ok*; *loose* where the bound holds but the bound or the stated rms is too far from the
  errors that occurred; *fails* otherwise.

Remake it with `python -m gbnbench.benchmarks.spectra.hard_table docs/hard_cases.md`. The tests check
every row. The bounds of the non-uniform FFTs are empirical."""


def evaluate(case: HardCase) -> Iterator[Row]:
    """Take one case by every evaluation and precision that this device has.

    Yields
    ------
    dict
        case, n, d, reach, method, precision; largest and rms error of the square root of power, error_bound
        and error_rms as stated; ``held`` (error within the bound, and the power under its closed ceiling).
    """
    x, f = case.build(), case.frequencies()
    truth = case.truth(x, f)
    for precision in PRECISIONS:
        for method, stated, roots in _evaluations(case, x, f, precision):
            error = np.abs(roots - truth).astype(float)
            largest = float(error.max())
            held = largest <= stated.bound
            if case.ceiling is not None:
                held = held and bool((roots <= case.ceiling(f) + stated.bound).all())
            yield {
                "case": case.name,
                "n": case.n,
                "d": case.d,
                "reach": case.reach,
                "method": method,
                "precision": precision,
                "largest": largest,
                "rms": float(np.sqrt(np.mean(error**2))),
                "error_bound": stated.bound,
                "error_rms": stated.rms,
                "scattered": case.scattered,
                "held": held,
            }


def _evaluations(
    case: HardCase, x: FloatArray, f: Frequencies, precision: PrecisionName
) -> Iterator[tuple[str, Errors, Any]]:
    """Every evaluation's name, stated errors, and square roots of power at f."""
    has = precision == "float" or runtime().device.has_double
    listing: list[Method] = ["direct", "numpy"] if has else ["numpy"]
    for method in listing:
        listed = periodogram(x, precision=precision, frequencies=f, method=method)
        yield LISTED.get(method, title_of(method)), _stated(listed), np.sqrt(_long(listed.power))
    if not case.cube:
        return
    methods: list[Method] = ["product"] if has else []
    if has and griddable(case.d, case.reach, precision):
        methods.append("gridded")
    if has and case.d <= AXES and runtime().device.is_cpu:
        methods.append("fft")
    methods.append("numpy")
    within = tuple((f + case.reach).T)
    for way in methods:
        cube = periodogram(x, case.reach, precision, method=way)
        yield title_of(way), _stated(cube), np.sqrt(_long(cube.power[within]))
    for library in installed() if precision == "double" and case.d <= DIMENSIONS else ():
        transform = NonuniformFFT("double", library.tightest[case.d - 1], library)
        power, errors = transform.cube(x[None], case.reach, None, half=False, mean=True)
        yield f"{transform.title} by {library.name}", errors, np.sqrt(_long(power[within]))


def _stated(spectrum: Spectrum) -> Errors:
    return Errors(spectrum.error_rms, spectrum.error_bound)


def _long(power: FloatArray) -> NDArray[np.longdouble]:
    return power.astype(np.longdouble)


def judged(rows: list[Row]) -> pd.DataFrame:
    """Rows of all cases with verdicts that need the others.

    Returns
    -------
    DataFrame
        Further columns: ``ratio`` = error_bound / largest; ``slack`` = error_bound over the largest error met
        at that n by that method and precision in any case (near and far |f| apart); ``passed``: held, slack
        at most 100, and the stated rms within 10 times of the measured one where points are scattered.
    """
    frame = pd.DataFrame(rows)
    with np.errstate(divide="ignore"):
        frame["ratio"] = frame.error_bound / frame.largest
        alike = [frame.n, frame.method, frame.precision, frame.reach > NEAR]
        frame["slack"] = frame.error_bound / frame.groupby(alike).largest.transform("max")
        typical = frame.error_rms / frame.rms
    fits = ~frame.scattered | typical.between(1 / TYPICAL, TYPICAL)
    frame["passed"] = frame.held & (frame.slack <= SLACK) & fits
    return frame


def resolvable(frame: pd.DataFrame) -> pd.DataFrame:
    """Smallest power known to 1%, by the largest rms met on scattered points, |f_a| up to 1024.

    Returns
    -------
    DataFrame
        method, precision, n, rms, power.
    """
    near = frame[frame.scattered & (frame.reach <= NEAR)]
    found = near.groupby(["method", "precision", "n"], sort=False)[["rms"]].max().reset_index()
    found["power"] = [resolvable_power(rms) for rms in found.rms]
    return found


def markdown(frame: pd.DataFrame) -> str:
    """Write docs/hard_cases.md: what the columns mean, the table, what each method resolves."""
    lines = [HEAD.format(device=runtime().device.label, slack=SLACK, near=NEAR)]
    for (method, precision), part in frame.groupby(["method", "precision"], sort=False):
        lines += ["", f"## {str(method)[0].upper()}{str(method)[1:]}, {precision}", "", *_table(part)]
    lines += ["", "## Smallest power known to 1%", "", "(200 rms)^2, the rms over scattered points.", ""]
    lines += ["| method | precision | n | rms error | power |", "| :-- | :-- | --: | --: | --: |"]
    lines += [
        f"| {row.method} | {row.precision} | {row.n:,} | {row.rms:.1e} | {row.power:.1e} |"
        for row in resolvable(frame).itertuples()
    ]
    return "\n".join(lines) + "\n"


def _table(part: pd.DataFrame) -> Iterator[str]:
    yield "| case | n | d | \\|f_a\\| to | largest | rms | stated rms | bound | over | slack | |"
    yield "| :-- | --: | --: | --: | --: | --: | --: | --: | --: | --: | :-- |"
    for row in part.to_dict("records"):
        name = row["case"].replace("|", "\\|").replace("^", "\\^")
        errors = " | ".join(f"{row[key]:.1e}" for key in ("largest", "rms", "error_rms", "error_bound"))
        ratio = f"{row['ratio']:.1f}" if row["ratio"] < IDLE else f"{row['ratio']:.0e}"
        ratio = ratio if math.isfinite(row["ratio"]) else "∞"
        size = f"{row['n']:,} | {row['d']} | {row['reach']:,}"
        yield f"| {name} | {size} | {errors} | {ratio} | {row['slack']:.1f} | {_verdict(row)} |"


def _verdict(row: Mapping[Any, Any]) -> str:
    if row["passed"]:
        return "ok"
    return "**loose**" if row["held"] else "**fails**"


def main() -> None:
    """Write the table to the file named, else print it."""
    parser = argparse.ArgumentParser(description="Try the hard cases, and write the table of them.")
    parser.add_argument("page", type=Path, nargs="?", help="file to write; printed where none is given")
    page = parser.parse_args().page
    text = markdown(judged([row for case in hard_cases() for row in evaluate(case)]))
    if page is not None:
        write_whole(page, text.encode())
    else:
        print(text, end="")


if __name__ == "__main__":
    main()
