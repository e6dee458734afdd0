"""A comparison of stipplings as one object: its table, its figures and its report.

What draws is imported where it is used: matplotlib takes half a second, while workers can start.
"""

from __future__ import annotations

import base64
import html
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from gbnbench.api.report_files import report_in, write_files
from gbnbench.core.errors import InputError
from gbnbench.studies.stippling_comparison.stippling_folder import read_stippling_run
from gbnbench.studies.stippling_comparison.stippling_results import StipplingRun, wide_table

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure


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

    def __repr__(self) -> str:
        """Say what it is in a line, without its numbers."""
        names = ", ".join(source.label for source in self.run.sources)
        return f"<StipplingComparison of {names}, kept in {self.folder}>"

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
        return report_in(self.run, self.folder, draw)

    def _repr_html_(self) -> str:
        """Return the table and the gallery, for a notebook."""
        from gbnbench.reports.comparison.figure_files import png

        picture = base64.b64encode(png(self.figure())).decode("ascii")
        told = [f"<p>{html.escape(line)}</p>" for line in (*self.skipped, *self.failures)]
        image = f'<img alt="gallery" style="max-width:100%" src="data:image/png;base64,{picture}">'
        return "\n".join([self.table.to_html(index=False, na_rep="–"), *told, image])


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

    write_files(run, folder, write_figures, write_report)


def load_pictures() -> None:
    """Import what makes the figures and the report, while other processes work."""
    import gbnbench.reports.stippling_comparison.page  # noqa: F401
