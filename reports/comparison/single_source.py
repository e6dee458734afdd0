"""Figure of one source alone: a set, its spectrum, its radial power, and its zone plate in 2D."""

from __future__ import annotations

from matplotlib.figure import Figure

from gbnbench.reports import captions, layout, style
from gbnbench.reports.comparison import points, radial, spectrum, zone_plate
from gbnbench.runs.comparison_result import Run

SIDE = 2.6  # inches


@style.styled
def figure(run: Run) -> Figure:
    """Draw the pictures of a source side by side.

    Parameters
    ----------
    run : Run
        A comparison of one source.

    Returns
    -------
    Figure
        A panel a picture.
    """
    (source,) = run.sources
    scale = spectrum.norm([source])
    plated = source.zone_plate is not None
    notes = " ".join(filter(None, (points.note(source), spectrum.note(source))))
    plate = "; a zone plate, a chirp sampled at the points and rebuilt by a filter" if plated else ""
    caption = (
        f"The first realization; log10 of power, zero in the middle, axes in nu, clipped at {scale.vmin:.0e} "
        f"and {scale.vmax:g}, DC left out; mean power on exact shells |f| against nu = |f| n^(-1/d), the "
        f"line at 1 is white noise{plate}. {notes} "
    ).replace("  ", " ")
    sheet = layout.sheet(
        captions.shown(source.label, 90), caption + captions.settings(run), 4 if plated else 3, SIDE, [SIDE],
        left=0.3, between=0.42, under=0.4, key=0.45,
    )  # fmt: skip
    panels = [stack[0] for stack in sheet.cells]
    points.panel(panels[0], source)
    spectrum.panel(panels[1], source, scale)
    radial.power_panel(panels[2], source, style.strokes(run)[source.key], radial.power_limit([source]))
    panels[2].set_xlabel("nu")
    if plated:
        zone_plate.panel(panels[3], source)
    for ax, title in zip(panels, ("points", "power spectrum", "radial power", "zone plate"), strict=False):
        ax.set_title(title, loc="left")
    spectrum.add_colour_bar(sheet, scale)
    return sheet.figure
