"""``gbnbench spectrum``: power of the point sets in files at the frequencies asked for."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from gbnbench.cli import options

if TYPE_CHECKING:
    from gbnbench.analysis.precision import PrecisionName
    from gbnbench.io.points import ReadingOptions

EPILOG = """\b
Examples:
  gbnbench spectrum mine.txt                        what it is like: floor, peak, lowest shells
  gbnbench spectrum mine.txt -o mine.png            its picture; .csv .npz .npy hold the numbers
  gbnbench spectrum sets/*.txt --shells -o radial.csv
  gbnbench spectrum mine.txt --band 0,8 --floor 1e-6
  gbnbench spectrum large.npy --band 1,64 --band 3000,3010 -o shells.csv
  gbnbench spectrum mine.txt --at frequencies.txt --weights weights.txt
  gbnbench spectrum --explain --shells -n 4096 -d 10 --fmax 3
"""


class Band(click.ParamType):  # type: ignore[type-arg]  # takes no argument before click 8.4
    """The least and largest |f| of a band, separated by a comma."""

    name = "low,high"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[float, float]:
        """Read the text.

        Parameters
        ----------
        value : str or tuple of float
            What the user typed; click may hand back what is read already.
        param, ctx : click.Parameter and click.Context, optional
            For the message.

        Returns
        -------
        tuple of float
            Least and largest |f|.

        Raises
        ------
        click.BadParameter
            If the text is anything else, or no integer frequency lies between.
        """
        if isinstance(value, tuple):
            return value
        try:
            low, high = (float(word) for word in str(value).split(","))
        except ValueError:
            self.fail(f"must be the least and the largest |f|, such as 2,8; got {value!r}", param, ctx)
        if not 0 <= low <= high < math.inf:
            self.fail(f"must be 0 <= LOW <= HIGH, cycles per unit length; got {value!r}", param, ctx)
        if high < 1:
            self.fail(f"no integer frequency has |f| in {value} (DC is left out)", param, ctx)
        return low, high


@click.command(cls=options.Command, epilog=EPILOG)
@click.argument("files", nargs=-1, type=click.Path(path_type=Path), metavar="FILE...")
@click.option(
    "--fmax", type=click.IntRange(1),
    help="Largest harmonic on each axis.  [default: just beyond nu = 2, or as affordable]",
)  # fmt: skip
@click.option("--half", is_flag=True, help="Half of the cube, f0 >= 0; the other half is its mirror image.")
@click.option("--shells", is_flag=True, help="Radial power and anisotropy, without the cube.")
@click.option("--band", "bands", type=Band(), metavar="LOW,HIGH", multiple=True, help="Only shells with "
              "LOW <= |f| <= HIGH; rings at the ends are cut there. May be given several times.")  # fmt: skip
@click.option("--corners", is_flag=True, help="Shells beyond fmax too, as far as the cube holds them.")
@click.option("--at", type=click.Path(path_type=Path), metavar="LIST", help="Only the frequencies in this "
              "file, one per row.")  # fmt: skip
@click.option("--weights", type=click.Path(path_type=Path), metavar="LIST", help="Weights of the points, one "
              "per line.")  # fmt: skip
@click.option("--filter", "sigma", type=click.FloatRange(0), metavar="SIGMA", help="Convolve the points "
              "with a Gaussian of this width, in spacings.")  # fmt: skip
@click.option("--precision", type=click.Choice(["double", "float"]), default="double", show_default=True)
@click.option("--floor", type=float, metavar="P", help="Smallest power that must be known to 1%; the "
              "cheapest evaluation that does so is chosen.")  # fmt: skip
@click.option("--each", is_flag=True, help="Give a spectrum of each set, not their mean, in numbered files.")
@click.option("--explain", is_flag=True, help="Only say what would be computed, why so, and at what cost and "
              "error.")  # fmt: skip
@click.option("-n", "n", type=click.IntRange(1), help="Points in a set, with --explain and no FILE.  "
              "[default: 1024]")  # fmt: skip
@click.option("-d", "d", type=click.IntRange(1), help="Dimension, with --explain and no FILE.  [default: 2]")
@click.option(
    "--realizations", type=click.IntRange(1), help="Sets, with --explain and no FILE.  [default: 1]"
)
@options.reading
@options.json
@options.quiet
@options.out_file("File to write; one that exists is replaced. Formats: .npz .npy .csv .png .pdf.")
@options.device
def spectrum(
    files: tuple[Path, ...],
    fmax: int | None,
    half: bool,
    shells: bool,
    bands: tuple[tuple[float, float], ...],
    corners: bool,
    at: Path | None,
    weights: Path | None,
    sigma: float | None,
    precision: PrecisionName,
    floor: float | None,
    each: bool,
    explain: bool,
    n: int | None,
    d: int | None,
    realizations: int | None,
    out: Path | None,
    as_json: bool,
    quiet: bool,
    reading: ReadingOptions,
) -> None:
    """Exact power of the point sets in files.

    The power is the mean over the sets of all FILEs. Without options it is given on the whole cube of
    frequencies; --half, --shells (or --band, --corners) and --at ask for less, and only what is asked for
    is computed. --json prints what a file would hold, and shells in place of a cube.
    """
    band = bands[0] if len(bands) == 1 else bands or None
    asked_for = {"--fmax": fmax, "--half": half, "--shells": shells, "--band": band, "--corners": corners}
    _refuse_both("--at", at, **asked_for)
    _refuse_both("--half", half, **{"--shells": shells, "--band": band, "--corners": corners})
    sizes = {"-n": n, "-d": d, "--realizations": realizations}
    if as_json:
        _refuse_both("--json", as_json, **{"--out": out, "--explain": explain})
    if files:
        _refuse_both("FILE", files, **sizes)
    elif not explain:
        raise click.UsageError("name a FILE of points; or plan without one: --explain -n 1024 -d 2")
    from gbnbench.analysis.spectrum.settings import SpectrumSettings
    from gbnbench.cli import spectrum_output as output
    from gbnbench.cli import spectrum_run as work
    from gbnbench.io.lists import read_frequencies, read_weights

    if out is not None and not explain:
        output.check_place(out)
    sets = work.read_sets(files, reading, each=each)
    if out is not None and not explain:
        inputs = [*files, *filter(None, (at, weights))]
        output.check_outs(output.places(out, len(sets), each=each), inputs, each=each)
    columns = sets[0].x.shape[2] if sets else d
    listed = None if at is None else read_frequencies(at, columns)
    settings = SpectrumSettings(
        fmax, half, shells or corners or band is not None, band, corners, listed, precision, floor, sigma
    )
    shapes = [(one.x.shape[1], one.x.shape[2], one.sides) for one in sets] or [(n or 1024, d or 2, None)]
    largest = sorted(shapes, key=lambda shape: shape[1])[-1]
    affordable = settings.affordable(*largest)
    if affordable != settings and not quiet:
        click.echo(
            f"gbnbench: a cube of frequencies in d={largest[1]} does not fit in memory: shells are computed",
            err=True,
        )
    settings = affordable
    if not explain:
        work.compute(settings, sets, weights, out, each=each, as_json=as_json, quiet=quiet)
    elif sets:
        work.explain(settings, sets, weights)
    else:
        d = (d or 2) if listed is None else listed.shape[1]
        if weights is not None:
            read_weights(weights, n or 1024, realizations or 1)
        for plan in settings.plans(n or 1024, d or 2, realizations or 1):
            click.echo(plan)


def _refuse_both(name: str, given: object, **others: object) -> None:
    """Refuse options that ask for different things."""
    clash = [other for other, value in others.items() if value not in (None, False)]
    if given not in (None, False) and clash:
        raise click.UsageError(f"{name} and {clash[0]} do not go together: leave one out")
