"""A study of integration as one object: variances of integrals against n, their slopes and the picture."""

from __future__ import annotations

import base64
import html
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from gbnbench.api.source_arguments import SourceLike, as_sources
from gbnbench.core.atomic_write import write_whole
from gbnbench.execution import progress
from gbnbench.execution.executor_choice import use_executor
from gbnbench.io.points import ReadingOptions
from gbnbench.opencl import use_device
from gbnbench.reports.comparison.figure_files import pdf, png
from gbnbench.reports.integration import variance
from gbnbench.runs.sources import DEFAULT_READING
from gbnbench.studies.integration.study import (
    DEFAULT_INTEGRANDS,
    DEFAULT_N,
    DEFAULT_SOURCES,
    run_integration_study,
)
from gbnbench.studies.integration.study_folder import IntegrationStudy, read_integration

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

PICTURE = "integration"  # stem of its files in the folder


@dataclass(frozen=True)
class Integration:
    """A finished study of integration, as ``integrate`` returns it and as its folder holds it.

    In a notebook it shows its table and its picture.

    Attributes
    ----------
    study : IntegrationStudy
        The tables, and the manifest with all settings.
    folder : Path
        Where it is kept.
    reused, pieces : int
        Pieces of work found finished in the folder, and all of them.
    seconds : float
        Wall time of the call.
    undrawn : str
        Why pictures that were asked for could not be made; empty where they were.

    Examples
    --------
    >>> import tempfile, gbnbench
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     made = gbnbench.integrate(
    ...         "random", n=16, instances=2, realizations=2, out=folder, jobs=1, quiet=True
    ...     )
    ...     again = gbnbench.Integration.read(folder)
    >>> again.table.equals(made.table)
    True
    """

    study: IntegrationStudy
    folder: Path
    reused: int = 0
    pieces: int = 0
    seconds: float = 0.0
    undrawn: str = ""

    @classmethod
    def read(cls, folder: str | Path) -> Integration:
        """Read a finished study from its folder.

        Raises
        ------
        InputError
            If it is none, or an unfinished one.
        FormatError
            If a file in it is missing or was changed.
        """
        return cls(read_integration(folder), Path(folder))

    @property
    def table(self) -> pd.DataFrame:
        """A row a source, n, d and family of integrands, with the variance and its 95% band."""
        return self.study.variance

    @property
    def slopes(self) -> pd.DataFrame:
        """A row a source, d and family with two or more n: slope of the variance against n, its error."""
        return self.study.slopes

    @property
    def skipped(self) -> tuple[str, ...]:
        """A sentence for each generator, n and d that was refused."""
        return tuple(self.study.manifest.get("skipped") or ())

    def figure(self) -> Figure:
        """Draw variance against n, a panel a family and dimension, as a new matplotlib Figure."""
        return variance.figure(self.study)

    def picture(self) -> Path:
        """Return the path of integration.png, which is made, with the PDF, where it is missing.

        Raises
        ------
        OSError
            If the folder cannot be written.
        """
        path = self.folder / f"{PICTURE}.png"
        if not path.exists():
            draw(self.study, self.folder)
        return path

    def _repr_html_(self) -> str:
        """Return the table and the picture, for a notebook."""
        picture = base64.b64encode(png(self.figure())).decode("ascii")
        image = f'<img alt="{PICTURE}" style="max-width:100%" src="data:image/png;base64,{picture}">'
        skipped = [f"<p>skipped: {html.escape(line)}</p>" for line in self.skipped]
        return "\n".join([self.table.to_html(index=False, na_rep="–"), *skipped, image])


def integrate(
    sources: SourceLike | Iterable[SourceLike] | Mapping[str, SourceLike] = DEFAULT_SOURCES,
    *,
    n: int | Sequence[int] = DEFAULT_N,
    d: int | Sequence[int] = 2,
    realizations: int = 16,
    integrands: str | Sequence[str] = DEFAULT_INTEGRANDS,
    instances: int = 100,
    shifts: int = 0,
    seed: int = 0,
    out: str | Path | None = None,
    jobs: int | None = None,
    executor: str | None = None,
    executor_config: str | Path | None = None,
    quiet: bool = False,
    device: str | None = None,
    reading: ReadingOptions = DEFAULT_READING,
    pictures: bool = False,
    command: str = "gbnbench.integrate",
) -> Integration:
    """Estimate integrals by the means over points, and their variance against n.

    Parameters
    ----------
    sources : str, path, array_like, Generator or Source, or a sequence or mapping of these
        As in ``compare``; by default random, jittered, sobol and gbn.
    n, d : int or sequence of int
        Points a set and dimensions for the generators; files and arrays bring their own.
    realizations : int
        Sets of each generator, >= 1.
    integrands : str or sequence of str
        Families of integrands with or without settings, such as ``"gaussians[count=16]"``; a dimension where
        one has no integrands is skipped and said.
    instances : int
        Random integrands of each family, >= 1, the same for all sources and n.
    shifts : int
        Random toroidal shifts of each set; 0 takes the sets as they are.
    seed : int
        >= 0; realization k draws from stream k of it, integrands and shifts from streams of their own.
    out : path, optional
        The folder; by default one under ``runs`` named by the settings. One that holds another study is
        refused.
    jobs : int, optional
        Worker processes, each with one thread; by default one a core.
    executor : str, optional
        Who does the work: ``"local"``, ``"dask:tcp://HOST:PORT"``, ``"dask:local"``, ``"mpi"`` or
        ``"slurm"``; by default processes on this machine.
    executor_config : path, optional
        A TOML file with settings of the executor.
    quiet : bool
        No progress on standard error.
    device : str, optional
        Part of the name of the OpenCL device, or its position, as in ``GBNBENCH_DEVICE``, which it overrides.
    reading : ReadingOptions
        How files are read: columns, box and so on, as ``load`` takes them; the same for all.
    pictures : bool
        Also write the picture into the folder; ``Integration.picture`` makes it later.
    command : str
        What the manifest says was called.

    Returns
    -------
    Integration

    Raises
    ------
    InputError
        If a source, a family or a number is wrong, or the folder holds something else.
    RefusalError
        If nothing remains of the sources, or no family has integrands in any of the dimensions.
    DeviceError
        If a device is named and fits none or several.
    UnfinishedError
        If a piece of the work failed; what is finished is kept, and the same call tries only the rest.

    Examples
    --------
    >>> import tempfile, gbnbench
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     study = gbnbench.integrate(
    ...         ["random", "jittered"], n=[16, 64], integrands="korobov", instances=10, realizations=4,
    ...         out=folder, jobs=1, quiet=True,
    ...     )
    >>> study.slopes.source.tolist(), bool(study.slopes.slope[1] < study.slopes.slope[0])
    (['random', 'jittered'], True)
    """
    with use_device(device), use_executor(executor, executor_config):
        found, skipped = as_sources(sources, n, d, realizations, reading)
        with progress.choose(quiet) as shown:
            done = run_integration_study(
                found,
                out,
                integrands=(integrands,) if isinstance(integrands, str) else integrands,
                instances=instances,
                shifts=shifts,
                seed=seed,
                jobs=jobs,
                command=command,
                skipped=skipped,
                progress=shown,
                draw=draw if pictures else None,
            )
    return Integration(done.study, done.folder, done.reused, done.pieces, done.seconds, done.undrawn)


def draw(study: IntegrationStudy, folder: Path) -> None:
    """Write the picture of a study into its folder, as PNG and PDF.

    Parameters
    ----------
    study : IntegrationStudy
        What was measured.
    folder : Path
        Where integration.png and integration.pdf are made, or replaced.
    """
    drawn = variance.figure(study)
    write_whole(folder / f"{PICTURE}.png", png(drawn))
    write_whole(folder / f"{PICTURE}.pdf", pdf(drawn))
