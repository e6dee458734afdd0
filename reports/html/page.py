"""Page ``report.html`` of a run: one file that opens offline, prints and is whole without scripts."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import MappingProxyType

from gbnbench.core.atomic_write import write_whole
from gbnbench.reports import captions, style
from gbnbench.reports.comparison import sweep, table
from gbnbench.reports.html import notes
from gbnbench.reports.html.environment import template_environment
from gbnbench.reports.html.pictures import colour_bar
from gbnbench.reports.html.sections import anchor, figure_or_drawn, group_sections
from gbnbench.reports.source_groups import Group, groups
from gbnbench.runs.comparison_result import Run
from gbnbench.runs.joined_runs import JoinedRuns
from gbnbench.studies import growing_report
from gbnbench.studies.growing_report import Unfinished

RUN_SECTIONS = (("runs", "Runs"),)  # where several are joined
GROUP_SECTIONS = (
    ("table", "Measures"),
    ("gallery", "Side by side"),
    ("loglog", "Log-log"),
    ("radial", "Radial"),
)


def write_report(
    run: Run,
    path: str | Path,
    drawn: Mapping[str, bytes] | None = None,
    *,
    unfinished: Unfinished | None = None,
    joined: JoinedRuns | None = None,
) -> None:
    """Write the page of a run, whole or not at all.

    Parameters
    ----------
    run : Run
        The comparison. Nothing in it is measured again.
    path : path
        Usually ``report.html`` in the run folder; an older page there is replaced.
    drawn : mapping of bytes, optional
        PNGs that ``write_figures`` made of the same run, by the stems of their files: not drawn again.
    unfinished : Unfinished, optional
        What is still to come; the page then says so and reads itself again from time to time.
    joined : JoinedRuns, optional
        The runs of which ``run`` was joined.
    """
    write_whole(Path(path), page(run, drawn or {}, unfinished, joined).encode("utf-8"))


@style.styled
def page(
    run: Run,
    drawn: Mapping[str, bytes] = MappingProxyType({}),
    unfinished: Unfinished | None = None,
    joined: JoinedRuns | None = None,
) -> str:
    """Return the page as text; every label, path and setting in it is escaped.

    Parameters
    ----------
    run : Run
        The comparison.
    drawn : mapping of bytes
        PNGs by the stems of their files, which are not drawn again.
    unfinished : Unfinished, optional
        What is still to come.
    joined : JoinedRuns, optional
        The runs of which ``run`` was joined.

    Returns
    -------
    str
        HTML.
    """
    every = groups(run)
    swept = sweep.several(run)
    template = template_environment(table.COLUMNS).get_template("report.html")
    text = template.render(
        title=_title(run) if joined is None else f"gbnbench: {', '.join(joined.names)}",
        joined=joined,
        version=run.manifest.get("version", ""),
        unfinished=unfinished,
        reload_seconds=growing_report.RELOAD,
        reloads=(growing_report.START, growing_report.END),
        settings=captions.settings(run),
        links=_links(every, swept, joined is not None),
        warnings=[(table.row_label(s, run), warning) for s in run.sources for warning in s.warnings],
        skipped=[_sentence(source) for source in run.manifest.get("skipped") or []],
        groups=[group_sections(run, group, drawn, len(every) > 1, joined) for group in every],
        compared=bool(run.verdicts),
        sweep=figure_or_drawn(
            drawn,
            "sweep",
            lambda: sweep.figure(run),
            "Measures against the number of points, a curve a source",
        )
        if swept
        else None,
        undefined_values=notes.undefined_values(run),
        provenance=notes.provenance(run.manifest) if joined is None else notes.joined_provenance(joined),
        manifest=json.dumps(run.manifest, indent=2, ensure_ascii=False, default=str),
        colour_bar=colour_bar(),
    )
    return text.encode("utf-8", "replace").decode("utf-8")  # odd file names hold lone surrogates


def _title(run: Run) -> str:
    labels = list(dict.fromkeys(source.label for source in run.sources))
    few = ", ".join(label if len(label) <= 40 else f"{label[:39]}…" for label in labels[:4])
    return f"gbnbench: {few}" + (f" and {len(labels) - 4} more" if len(labels) > 4 else "")


def _links(every: Sequence[Group], swept: bool, joined: bool) -> list[tuple[str, str]]:
    """Anchor and title of each section."""
    links = []
    for n, d in every:
        mark = f" n={n}, d={d}" if len(every) > 1 else ""
        sections = (*RUN_SECTIONS, *GROUP_SECTIONS) if joined else GROUP_SECTIONS
        links += [(f"{name}-{anchor((n, d))}", title + mark) for name, title in sections]
    links += [("sweep", "Against n")] if swept else []
    return [*links, ("undefined", "Undefined"), ("definitions", "Definitions"), ("made", "What made it")]


def _sentence(item: object) -> str:
    return ", ".join(f"{k}: {v}" for k, v in item.items()) if isinstance(item, Mapping) else str(item)
