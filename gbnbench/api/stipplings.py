"""``gbnbench.compare_stipplings``: stipplers and stipplings by anybody side by side, for one image."""

from __future__ import annotations

import base64
import html
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from gbnbench.api.comparison import FIGURES, REPORT
from gbnbench.core.errors import InputError
from gbnbench.execution import progress
from gbnbench.generators.adaptive.density import Density
from gbnbench.generators.adaptive.protocol import AdaptiveGenerator
from gbnbench.io.points import ReadingOptions
from gbnbench.opencl import use_device
from gbnbench.runs.sources import DEFAULT_READING
from gbnbench.studies.drawing import make_each
from gbnbench.studies.stippling.darkness import ImageLike, ToneCurve, as_darkness
from gbnbench.studies.stippling_comparison.stippling_folder import read_stippling_run
from gbnbench.studies.stippling_comparison.stippling_results import StipplingRun, wide_table
from gbnbench.studies.stippling_comparison.stippling_sources import StipplingSourceLike, stippling_sources
from gbnbench.studies.stippling_comparison.study import run_stippling_comparison

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

DEFAULT_STIPPLERS = ("gbn", "lbg", "floydsteinberg", "rejection")


@dataclass(frozen=True)
class StipplingComparison:
    """A comparison of stipplings, as ``compare_stipplings`` returns it and as its folder holds it.

    In a notebook it shows its table and its main picture.

    Attributes
    ----------
    run : StipplingRun
        Everything measured: ``run.sources`` has points, spectra, pictures and measures.
    folder : Path
        Where it is kept.
    reused, pieces : int
        Sets found finished in the folder, and all of them.
    seconds : float
        Wall time of the call.
    undrawn : str
        Why pictures that were asked for could not be made; empty where they were.

    Examples
    --------
    >>> import gbnbench
    >>> made = gbnbench.compare_stipplings("camera", out="stipplings")  # doctest: +SKIP
    >>> made.figure("spectra").savefig("spectra.pdf")  # doctest: +SKIP
    >>> gbnbench.StipplingComparison.read("stipplings").table.equals(made.table)  # doctest: +SKIP
    True
    """

    run: StipplingRun
    folder: Path
    reused: int = 0
    pieces: int = 0
    seconds: float = 0.0
    undrawn: str = ""

    @classmethod
    def read(cls, folder: str | Path) -> StipplingComparison:
        """Read a finished comparison from its folder.

        Raises
        ------
        InputError
            If it is none, or an unfinished one.
        FormatError
            If a file in it is missing or was changed.
        """
        return cls(read_stippling_run(folder), Path(folder))

    @property
    def table(self) -> pd.DataFrame:
        """A row a source: columns source, n, realizations, every measure and its ``_error``, cpu_seconds."""
        import pandas as pd

        return pd.DataFrame(wide_table(self.run))

    @property
    def skipped(self) -> tuple[str, ...]:
        """A sentence for each generator that refused the density."""
        return tuple(self.run.manifest.get("skipped") or ())

    @property
    def failures(self) -> tuple[str, ...]:
        """A sentence for each source that failed; the same call tries these again."""
        return self.run.failures

    @property
    def figures(self) -> tuple[str, ...]:
        """Names of all figures."""
        from gbnbench.reports.stippling_comparison import figure_files

        return tuple(figure_files.FIGURES)

    def figure(self, name: str = "gallery") -> Figure:
        """Draw one figure.

        Parameters
        ----------
        name : str
            One of ``figures``.

        Returns
        -------
        matplotlib.figure.Figure
            New at each call, and in no window.

        Raises
        ------
        InputError
            If there is no figure of that name.
        """
        from gbnbench.reports.stippling_comparison import figure_files

        if name not in figure_files.FIGURES:
            raise InputError(f"this comparison has no figure {name!r}; it has {', '.join(self.figures)}")
        return figure_files.FIGURES[name](self.run)

    def report(self) -> Path:
        """Return the path of report.html, which is made, with the figures' files, where it is missing.

        Raises
        ------
        OSError
            If the folder cannot be written.
        """
        path = self.folder / REPORT
        if not path.exists():
            draw(self.run, self.folder)
        return path

    def _repr_html_(self) -> str:
        """Return the table and the gallery, for a notebook."""
        from gbnbench.reports.comparison.figure_files import png

        picture = base64.b64encode(png(self.figure())).decode("ascii")
        told = [f"<p>{html.escape(line)}</p>" for line in (*self.skipped, *self.failures)]
        image = f'<img alt="gallery" style="max-width:100%" src="data:image/png;base64,{picture}">'
        return "\n".join([self.table.to_html(index=False, na_rep="–"), *told, image])


def compare_stipplings(
    image: ImageLike,
    sources: StipplingSourceLike
    | Iterable[StipplingSourceLike]
    | Mapping[str, StipplingSourceLike] = DEFAULT_STIPPLERS,
    *,
    n: int | None = None,
    realizations: int = 1,
    seed: int = 0,
    invert: bool = False,
    gamma: float = 1.0,
    white_cutoff: float | None = None,
    shape: tuple[int, ...] | None = None,
    out: str | Path | None = None,
    jobs: int | None = None,
    quiet: bool = False,
    device: str | None = None,
    reading: ReadingOptions = DEFAULT_READING,
    pictures: bool = False,
    command: str = "gbnbench.compare_stipplings",
) -> StipplingComparison:
    """Draw and measure stipplings of one image, in a folder from which the same call goes on.

    Parameters
    ----------
    image : str, path, array_like, Density or callable
        As ``stipple`` takes it; two axes, not toroidal.
    sources : str, path, array_like or AdaptiveGenerator, or a sequence or mapping of these
        Names of ``ADAPTIVE_GENERATORS`` with settings, such as ``"gbn[sigma=0.85]"``; files and folders of
        points by anybody, in pixels or in fractions of the image's sides, x to the right and y down; a list
        of arrays (n, 2) or (realizations, n, 2) in pixels, x first, such as ``Stippling.points``. A mapping
        gives labels.
    n : int, optional
        Points a set of generators, at least 1; by default as many as ``stipple`` draws.
    realizations : int
        Sets of each generator, at least 1.
    seed : int
        >= 0; realization k draws from ``SeedSequence(seed, spawn_key=(k,))``, however the work is split.
    invert, gamma, white_cutoff, shape
        As ``stipple`` takes them.
    out : path, optional
        The folder; by default one under ``runs`` named by the settings. One that holds something else is
        refused.
    jobs : int, optional
        Worker processes, each with one thread; by default one a core.
    quiet : bool
        No progress on standard error.
    device : str, optional
        Part of the name of the OpenCL device, or its position, as in ``GBNBENCH_DEVICE``.
    reading : ReadingOptions
        How files are read: columns, box and so on.
    pictures : bool
        Also write report.html and the figures into the folder; ``StipplingComparison.report`` makes them
        later.
    command : str
        What the manifest and the report say was called.

    Returns
    -------
    StipplingComparison
        Of the sources that did not fail; ``failures`` names the others.

    Raises
    ------
    InputError
        If something given is no source or no image, a number is wrong, or the folder holds something else.
    RefusalError
        If no generator can make such sets and nothing else was given.
    DeviceError
        If there is no device, or the name fits none or several.

    Notes
    -----
    Of each set: the relative variance energy, F16, PSNR and SSIM of the picture that Algorithm 2 finds back
    (Ahmed, Ren & Wonka 2022, Sections 4.10 and 5.3), the power of the set less its density, and the same in
    the flattest square of the image; docs/adaptive.md defines them.

    Examples
    --------
    >>> import tempfile, gbnbench
    >>> import numpy as np
    >>> ramp = np.linspace(0, 0.9, 32)[:, None] * np.ones(32)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     made = gbnbench.compare_stipplings(
    ...         ramp, ["gbn[gradients=30]", "rejection"], n=90, out=folder, jobs=1, quiet=True
    ...     )
    ...     again = gbnbench.StipplingComparison.read(folder)
    >>> again.table.equals(made.table)
    True
    >>> made.table.source.tolist(), bool(made.table.psnr[0] > made.table.psnr[1] + 3)
    (['gbn[gradients=30]', 'rejection'], True)
    """
    darkness = as_darkness(image, shape=shape, curve=ToneCurve(invert, gamma, white_cutoff))
    density = darkness.density()
    count = darkness.default_n if n is None else n
    for name, value in (("n", count), ("realizations", realizations)):
        if value < 1:
            raise InputError(f"{name} must be at least 1; got {value}")
    if isinstance(sources, Mapping):
        given = [(str(label), item) for label, item in sources.items()]
    else:
        one = isinstance(sources, (str, Path, AdaptiveGenerator)) or hasattr(sources, "__array__")
        given = [("", item) for item in ([sources] if one else sources)]
    if density.d != 2:
        raise InputError(f"stipplings are compared on images; {darkness.name} is a volume")
    if isinstance(image, Density) and image.toroidal:
        raise InputError("stipplings are compared on bounded images; opposite borders of this density meet")
    with use_device(device):
        found, skipped = stippling_sources(given, density, count, realizations, reading)
        with progress.choose(quiet) as shown:
            done = run_stippling_comparison(
                found,
                density,
                darkness.name,
                count,
                out,
                seed=seed,
                jobs=jobs,
                command=command,
                skipped=skipped,
                progress=shown,
                draw=draw if pictures else None,
                meanwhile=load_pictures if pictures else None,
            )
    return StipplingComparison(done.run, done.folder, done.reused, done.pieces, done.seconds, done.undrawn)


def draw(run: StipplingRun, folder: Path) -> None:
    """Write the figures and report.html of a comparison into its folder.

    Parameters
    ----------
    run : StipplingRun
        What was measured.
    folder : Path
        Where ``figures`` and report.html are made, or replaced.

    Raises
    ------
    UndrawnError
        If any of them cannot be made; all others are.
    """
    from gbnbench.reports.stippling_comparison.figure_files import write_figures
    from gbnbench.reports.stippling_comparison.page import write_report

    drawn: dict[str, bytes] = {}
    make_each(
        [
            (FIGURES, lambda: write_figures(run, folder / FIGURES, drawn)),
            (REPORT, lambda: write_report(run, folder / REPORT, drawn)),
        ]
    )


def load_pictures() -> None:
    """Import what makes the figures and the report, while other processes work."""
    import gbnbench.reports.stippling_comparison.page  # noqa: F401
