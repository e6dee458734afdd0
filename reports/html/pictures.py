"""Pictures of the page as PNG with their alternative texts."""

from __future__ import annotations

import base64
import io
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.image import AxesImage, imsave
from numpy.typing import NDArray
from PIL import Image, ImageColor

from gbnbench.reports import style
from gbnbench.reports.comparison import spectrum
from gbnbench.reports.comparison.figure_files import pixels
from gbnbench.reports.plot_axes import PlotAxes
from gbnbench.runs.comparison_result import SourceResult

PANEL = 2.5  # inches of a gallery picture, shown at 250 CSS pixels
COLOURS, COMPRESSION = 256, 4  # of a picture in the page, which has to stay small
DOTS = 160  # an inch of such a picture
WITH_AXES = ("radial power", "anisotropy\n(dB)")  # rows of the gallery whose panels need room for ticks


@dataclass(frozen=True)
class Picture:
    """A picture within the page.

    Attributes
    ----------
    alt : str
        Text for readers who do not see the picture.
    content : bytes
        The picture as PNG.
    """

    alt: str
    content: bytes

    @property
    def base64(self) -> str:
        """The PNG in base64, for a data address."""
        return base64.b64encode(self.content).decode("ascii")


def figure_picture(figure: Figure, alt: str) -> Picture:
    """Render a figure for the page.

    Parameters
    ----------
    figure : Figure
        Figure to render.
    alt : str
        Text for readers who do not see it.

    Returns
    -------
    Picture
        The figure at the resolution of all PNG files.
    """
    return Picture(alt, _packed(pixels(figure)))


def small_picture(content: bytes, alt: str) -> Picture:
    """Pack a PNG for the page with a palette: a third of the size.

    Parameters
    ----------
    content : bytes
        An opaque PNG.
    alt : str
        Text for readers who do not see it.

    Returns
    -------
    Picture
        The same pixels where they have at most 256 colours. Where there are more, at the rims of smooth
        lines, some are replaced by their neighbours in the palette, a few of 255 steps away.
    """
    with Image.open(io.BytesIO(content)) as picture:
        return Picture(alt, _packed(picture.convert("RGB")))


def _packed(picture: Image.Image) -> bytes:
    """Write an RGB picture as PNG with a palette."""
    stream = io.BytesIO()
    few = _in_own_colours(picture)
    if few is None:
        few = picture.quantize(COLOURS, method=Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE)
    few.save(stream, format="png", compress_level=COMPRESSION)
    return stream.getvalue()


def _in_own_colours(picture: Image.Image) -> Image.Image | None:
    """Give an RGB picture a palette of its own colours, sooner than Pillow; None where they are too many."""
    counted = picture.getcolors(COLOURS)
    if counted is None:
        return None
    colours = np.array([colour for _, colour in counted], np.uint8)
    number = np.empty(1 << 24, np.uint8)  # of each colour; memory is taken for those that are there
    number[_as_one(np.pad(colours, ((0, 0), (0, 1))))] = np.arange(len(colours))
    few = Image.fromarray(number[_as_one(np.asarray(picture.convert("RGBX")))])
    few.putpalette(colours.tobytes())
    return few


def _as_one(pixels: NDArray[np.uint8]) -> NDArray[np.uint32]:
    """Read the first three of four bytes as one number below 2^24."""
    return pixels.view("<u4")[..., 0] & np.uint32(0xFFFFFF)


@style.styled
def gallery_panel(
    row: str, ratio: float, draw: Callable[[Axes, SourceResult], None], source: SourceResult, alt: str
) -> Picture:
    """Draw a panel of the gallery, to its edge or with room for the ticks of its axes.

    Parameters
    ----------
    row : str
        Title of its row.
    ratio : float
        Height of the panel over its width.
    draw : callable
        Function that draws a source into axes.
    source : SourceResult
        Source to draw.
    alt : str
        Text for readers who do not see it.

    Returns
    -------
    Picture
        The panel.
    """
    plain = row not in WITH_AXES
    room = 0.02 if plain else 0.27
    under = 0.02 if plain and ratio == 1.0 else 0.2
    height = PANEL * ratio if plain else PANEL * ratio + 0.1
    figure = Figure(figsize=(PANEL, height))
    place = (room / PANEL, under / height, (PANEL - room - 0.03) / PANEL, (height - under - 0.04) / height)
    ax = figure.add_axes(place, axes_class=PlotAxes)
    draw(ax, source)
    if plain and ax.images and source.sides is None:
        return Picture(alt, _framed(ax.images[0]))
    return Picture(alt, _packed(pixels(figure, DOTS)))


def _framed(image: AxesImage) -> bytes:
    """Write an image that fills its panel, in grey or 256 colours: faster and smaller than as a figure."""
    width, margin, frame = round(PANEL * DOTS), 3, 1
    side = width - 2 * (margin + frame)
    shades = image.to_rgba(np.ma.asanyarray(image.get_array()), bytes=True)[::-1, :, :3]
    if (shades == shades[:, :, :1]).all():
        drawn = Image.fromarray(np.ascontiguousarray(shades[:, :, 0]))
    else:
        drawn = Image.fromarray(np.ascontiguousarray(shades))
    reduced = len(shades) > side
    drawn = drawn.resize((side, side), Image.Resampling.HAMMING if reduced else Image.Resampling.NEAREST)
    panel = Image.new(drawn.mode, (width, width), "white")
    panel.paste(ImageColor.getcolor(style.RULE, drawn.mode), (margin, margin, width - margin, width - margin))
    panel.paste(drawn, (margin + frame, margin + frame))
    if panel.mode == "RGB":
        return _packed(panel)
    stream = io.BytesIO()
    panel.save(stream, format="png", compress_level=COMPRESSION)
    return stream.getvalue()


def colour_bar() -> Picture:
    """Draw the colour scale of the spectra."""
    stream = io.BytesIO()
    imsave(stream, np.tile(np.linspace(0, 1, 256), (4, 1)), cmap=spectrum.palette(), format="png")
    return Picture("colour scale of the spectra, dark to bright", stream.getvalue())
