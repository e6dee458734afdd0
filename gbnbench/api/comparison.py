"""A comparison of point-set sources as one object: its table, its figures and its report.

What draws and prints is imported where it is used: matplotlib takes half a second, while workers can start.
"""

from __future__ import annotations

import base64
import html
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from gbnbench.api.report_files import report_in, write_files
from gbnbench.core.errors import InputError
from gbnbench.runs.baseline import Change
from gbnbench.runs.comparison_folder import REPORT, read_run
from gbnbench.runs.comparison_result import Run, SourceResult
from gbnbench.runs.comparison_tables import long_table, wide_table
from gbnbench.studies.growing_report import Unfinished

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

NOTEBOOK_FIGURES = ("gallery", "loglog", "sweep")  # shown in a notebook


@dataclass(frozen=True)
class Comparison:
    """A finished comparison, as ``compare`` returns it and as its folder holds it.

    In a notebook it shows its table and its main pictures; ``print`` shows the table.

    Attributes
    ----------
    run : Run
        Everything measured: ``run.sources`` has points, spectra and measures; ``run.manifest`` the settings.
    folder : Path
        Where it is kept.
    changes : tuple of Change
        Measures that are better or worse than the baseline's.
    notes : tuple of str
        Sources that could not be compared with the baseline.
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
    ...     made = gbnbench.compare("random", n=64, realizations=2, out=folder, jobs=1, quiet=True)
    ...     again = gbnbench.Comparison.read(folder)
    >>> again.table.equals(made.table), again.figures[:3]
    (True, ('gallery', 'points', 'spectrum'))
    """

    run: Run
    folder: Path
    changes: tuple[Change, ...] = ()
    notes: tuple[str, ...] = ()
    reused: int = 0
    pieces: int = 0
    seconds: float = 0.0
    undrawn: str = ""

    @classmethod
    def read(cls, folder: str | Path) -> Comparison:
        """Read a finished comparison from its folder.

        Raises
        ------
        InputError
            If it is none, or an unfinished one.
        FormatError
            If a file in it is missing or was changed.
        """
        return cls(read_run(folder), Path(folder))

    @property
    def table(self) -> pd.DataFrame:
        """A row a source: columns source, n, d, realizations, every measure, cpu_seconds (a set)."""
        import pandas as pd

        return pd.DataFrame(wide_table(self.run))

    @property
    def measures(self) -> pd.DataFrame:
        """A row a source and measure: value, standard_error, better, unit, verdict and reason beside them."""
        import pandas as pd

        return pd.DataFrame(long_table(self.run))

    def to_markdown(self, measures: Sequence[str] | None = None, *, errors: bool = False) -> str:
        """Return the table in Markdown, as the README shows it.

        Parameters
        ----------
        measures : sequence of str, optional
            Names of measures, or ``cpu_seconds``, as the columns; those of the terminal where not given.
        errors : bool
            Show standard errors beside the values.

        Returns
        -------
        str
            A row a source, the best of each column in bold.

        Raises
        ------
        InputError
            If there is no column of such a name.
        """
        from gbnbench.reports.comparison import markdown

        return markdown.markdown_table(self.run, measures, errors=errors)

    @property
    def sources(self) -> tuple[SourceResult, ...]:
        """What was measured of each source, in order."""
        return self.run.sources

    @property
    def skipped(self) -> tuple[str, ...]:
        """A sentence for each generator, n and d that was refused."""
        return tuple(self.run.manifest.get("skipped") or ())

    @property
    def worse(self) -> bool:
        """Whether anything is worse than the baseline."""
        return any(change.verdict == "worse" for change in self.changes)

    @property
    def figures(self) -> tuple[str, ...]:
        """Names of all figures; with several (n, d) they end in ``_n1024_d2``, and ``sweep`` is of all."""
        from gbnbench.reports.comparison.figure_files import planned

        return tuple(name for name, _, _ in planned(self.run))

    def figure(self, name: str = "gallery") -> Figure:
        """Draw one figure.

        Parameters
        ----------
        name : str
            One of ``figures``.

        Returns
        -------
        matplotlib.figure.Figure
            New at each call, and in no window: ``savefig`` writes it, a notebook shows it.

        Raises
        ------
        InputError
            If there is no figure of that name.
        """
        from gbnbench.reports.comparison.figure_files import planned

        for known, draw, group in planned(self.run):
            if known == name:
                return draw(self.run, group)
        raise InputError(f"this comparison has no figure {name!r}; it has {', '.join(self.figures)}")

    def report(self) -> Path:
        """Return the path of report.html, which is made, with the figures' files, where it is missing.

        Raises
        ------
        OSError
            If the folder cannot be written.
        """
        return report_in(self.run, self.folder, draw)

    def __str__(self) -> str:
        from gbnbench.reports.comparison import terminal

        return terminal.terminal_text(self.run)

    def _repr_html_(self) -> str:
        """Return the table and the main pictures, for a notebook."""
        from gbnbench.reports.comparison.figure_files import png
        from gbnbench.reports.comparison.notebook import html_table

        names = [name for name in self.figures if name.partition("_n")[0] in NOTEBOOK_FIGURES]
        pictures = [
            f'<img alt="{name}" style="max-width:100%" src="data:image/png;base64,'
            f'{base64.b64encode(png(self.figure(name))).decode("ascii")}">'
            for name in names
        ]
        skipped = [f"<p>skipped: {html.escape(line)}</p>" for line in self.skipped]
        return "\n".join([html_table(self.run), *skipped, *pictures])


def draw(run: Run, folder: Path, *, pdf: bool = False) -> None:
    """Write the figures and report.html of a comparison into its folder.

    Parameters
    ----------
    run : Run
        What was measured.
    folder : Path
        Where ``figures`` and report.html are made, or replaced.
    pdf : bool
        Make the figures also as PDF.

    Raises
    ------
    UndrawnError
        If any of them cannot be made; all others are.
    """
    from gbnbench.reports.comparison.figure_files import write_figures
    from gbnbench.reports.html.page import write_report

    write_files(run, folder, partial(write_figures, with_pdf=pdf), write_report)


def draw_unfinished(run: Run, folder: Path, unfinished: Unfinished) -> None:
    """Write report.html of what is measured so far.

    Parameters
    ----------
    run : Run
        The sources that are.
    folder : Path
        Where report.html is made, or replaced.
    unfinished : Unfinished
        What is still to come.
    """
    from gbnbench.reports.html.page import write_report

    write_report(run, folder / REPORT, unfinished=unfinished)


def load_pictures() -> None:
    """Import what makes the figures and the report, while other processes work."""
    import pandas  # noqa: F401
    from matplotlib.backends import backend_agg  # noqa: F401

    import gbnbench.reports.html.page  # noqa: F401
