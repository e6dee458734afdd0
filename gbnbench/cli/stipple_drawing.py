"""One image of ``gbnbench stipple`` drawn by its options: darkness, dots, their order, their page."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from gbnbench.api.drawing import draw_inks, in_progressive_order
from gbnbench.api.page_style import PageStyle, page_of
from gbnbench.api.stippled_page import TEXTS, in_tour_order
from gbnbench.cli import stipple_input
from gbnbench.cli.stipple_text import summary
from gbnbench.generators.adaptive.protocol import AdaptiveGenerator
from gbnbench.reports.stippling.gcode import GcodeTemplate
from gbnbench.reports.stippling.page import Page
from gbnbench.reports.stippling.png import picture_size
from gbnbench.studies.stippling.darkness import Darkness, ToneCurve
from gbnbench.studies.stippling.inks import shared_out

if TYPE_CHECKING:
    from gbnbench.api.stippling import Stippling
    from gbnbench.core.torus import FloatArray

Told = Callable[[int, int, str], None]
DPI = 300.0


@dataclass(frozen=True)
class StippleOptions:
    """What a command line says of how images are drawn.

    Attributes
    ----------
    n : int or None
        Dots.
    generator : AdaptiveGenerator
        That places them.
    curve : ToneCurve
        From tones to darkness.
    toroidal, progressive : bool
        As the command takes them.
    colour, palette : str or None
        Likewise.
    order : str
        Likewise.
    page : PageOptions
        Of the page.
    paper, ink : str
        Colours, as ``stipple_input.colours`` chooses them.
    template : GcodeTemplate or None
        Of a plotter.
    seed : int
        Of the dots.
    """

    n: int | None
    generator: AdaptiveGenerator
    curve: ToneCurve
    toroidal: bool
    progressive: bool
    colour: str | None
    palette: str | None
    order: str
    page: stipple_input.PageOptions
    paper: str
    ink: str
    template: GcodeTemplate | None
    seed: int

    @property
    def dpi(self) -> float:
        """Pixels an inch of a .png."""
        return DPI if self.page.dpi is None else self.page.dpi


@dataclass(frozen=True)
class PlannedImage:
    """An image that was read, and what is to be drawn of it.

    Attributes
    ----------
    darkness : dict of str to Darkness
        By the names of the inks.
    counts : dict of str to int
        Dots of each.
    style : PageStyle
        How they lie on the page.
    sheet : Page
        The empty page, of about that size.
    """

    darkness: dict[str, Darkness]
    counts: dict[str, int]
    style: PageStyle
    sheet: Page

    @property
    def remarks(self) -> list[str]:
        """What was done to read the image that might surprise."""
        return list(dict.fromkeys(remark for one in self.darkness.values() for remark in one.remarks))

    @property
    def columns(self) -> int:
        """Pixels along x."""
        return int(next(iter(self.darkness.values())).values.shape[1])


@dataclass(frozen=True)
class DrawnImage:
    """The dots of an image in their order.

    Attributes
    ----------
    layers : dict of str to Stippling
        By the names of the inks.
    page : Page
        With them on it.
    mm : float
        Side of a pixel.
    lengths : dict of str to float
        Metres of the tour of each ink, where there is one.
    """

    layers: dict[str, Stippling]
    page: Page
    mm: float
    lengths: dict[str, float]

    def summary(self, suffix: str) -> str:
        """Say how many dots a file has, and unless it holds points alone how large, on what page."""
        return summary(self.page, sized=suffix not in TEXTS, across=suffix != ".gcode")

    def tours(self, suffix: str) -> list[str]:
        """Say how long the tour of each ink is; of a file without a page, by what width."""
        wide = f" on a page {self.page.width:g} mm wide" if suffix in TEXTS else ""
        return [f"tour of {name}: {length:.4g} m{wide}" for name, length in self.lengths.items()]


def planned(image: str, given: StippleOptions, suffix: str) -> PlannedImage:
    """Read an image and find what is to be drawn.

    Parameters
    ----------
    image : str
        A file, or a name of scikit-image's.
    given : StippleOptions
        How.
    suffix : str
        Of the file that is to be written.

    Returns
    -------
    PlannedImage

    Raises
    ------
    FormatError
        If it cannot be read.
    InputError
        If nothing is dark, or the picture would be too large.
    click.UsageError
        If options contradict one another.
    """
    darkness = stipple_input.darkness(image, given.curve, given.colour, given.palette, given.seed, given.ink)
    rows, columns = next(iter(darkness.values())).values.shape
    page = given.page
    margin = 0.0 if given.toroidal and page.margin_mm is None else page.margin_mm
    style = PageStyle(page.width_mm, margin, page.dots, page.dot_mm, given.paper)
    wanted = given.n if given.n is not None else stipple_input.default_n(darkness, style)
    sheet = Page(page.width_mm, page.width_mm * rows / columns, ())
    if suffix == ".png":
        picture_size(sheet, given.dpi)
    return PlannedImage(darkness, shared_out(darkness, wanted), style, sheet)


def drawn(
    plan: PlannedImage,
    given: StippleOptions,
    told: Told | None = None,
    seen: Callable[[dict[str, FloatArray]], None] | None = None,
    ordering: Told | None = None,
) -> DrawnImage:
    """Place the dots and bring them in order.

    Parameters
    ----------
    plan : PlannedImage
        What is drawn.
    given : StippleOptions
        How.
    told, ordering : callable, optional
        Called with (steps done, steps in all, what is being done), of the places and of the order.
    seen : callable, optional
        As ``draw_inks`` takes it.

    Returns
    -------
    DrawnImage
    """
    equal = given.page.dots == "equal"
    wanted: Mapping[str, Darkness] = {
        name: dark if equal else replace(dark, values=dark.values**0.5)
        for name, dark in plan.darkness.items()
    }
    layers = draw_inks(
        wanted, plan.counts, method=given.generator, seed=given.seed, toroidal=given.toroidal,
        progress=told, seen=seen,
    )  # fmt: skip
    pixels: dict[str, float] = {}
    for name, made in layers.items():
        placed = replace(made, coverage=plan.darkness[name].coverage)
        if given.progressive:
            placed = in_progressive_order(placed, ordering)
        elif given.order == "tour":
            placed, pixels[name] = in_tour_order(placed)
        layers[name] = placed
    page = page_of(layers, plan.style)
    mm = (page.width - 2 * page.margin) / plan.columns
    return DrawnImage(layers, page, mm, {name: length * mm / 1000 for name, length in pixels.items()})
