"""Inks of a palette: which share of each pixel every colour covers, and palettes found from an image."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray
from gbnbench.io.images import Image
from gbnbench.studies.stippling.colours import luma, read_colour
from gbnbench.studies.stippling.darkness import PLAIN, Darkness, ToneCurve, bare

MOST_INKS = 8
FOUND = 4  # colours, unless their number is given
LEAST_INK = (
    1e-3  # weight of the ink over the squared error of a colour: of equal mixtures the sparest is taken
)
SAMPLED = 20_000  # pixels from which a palette is found
FULL = 0.99  # share of a cluster's pixels that its ink can be as dark as
CHUNK = 1 << 16  # colours at a time


def read_palette(text: str) -> tuple[str, ...] | int:
    """Read a palette.

    Parameters
    ----------
    text : str
        Colours parted by commas, as ``#d00`` or by their names in CSS; or how many are to be found.

    Returns
    -------
    tuple of str or int
        ``#rrggbb``, light ones first; or that number.

    Raises
    ------
    InputError
        If a colour is none, white, or there twice, or there are too many.

    Examples
    --------
    >>> read_palette("#000,gold, #08c"), read_palette("3")
    (('#ffd700', '#0088cc', '#000000'), 3)
    """
    if text.strip().isdecimal():
        count = int(text)
        if not 1 <= count <= MOST_INKS:
            raise InputError(f"a palette has 1 to {MOST_INKS} inks; got {count}")
        return count
    found: list[str] = []
    for word in text.split(","):
        colour = read_colour(word, ", several parted by commas")
        if colour == "#ffffff":
            raise InputError("white is the paper: leave it out of the palette")
        if colour in found:
            raise InputError(f"{colour} is in the palette twice")
        found.append(colour)
    if len(found) > MOST_INKS:
        raise InputError(f"a palette has 1 to {MOST_INKS} inks; got {len(found)}")
    return _light_first(found)


def found_palette(image: Image, count: int, seed: int = 0) -> tuple[str, ...]:
    """Find the inks that an image needs.

    Parameters
    ----------
    image : Image
        The image.
    count : int
        How many, 1 to 8.
    seed : int
        Of the choice of pixels and of the clustering.

    Returns
    -------
    tuple of str
        ``#rrggbb``, light ones first; fewer where the image has fewer colours.

    Raises
    ------
    InputError
        If it is white everywhere.

    Notes
    -----
    What a pixel takes from white, 1 - (red, green, blue), is a hue times an amount. Hues of pixels, drawn in
    proportion to their amounts, are clustered by k-means (``scipy.cluster.vq``), and each cluster's ink is as
    dark as 99% of its pixels need: lighter tones of the hue are fewer dots of it.
    """
    from scipy.cluster.vq import kmeans2

    taken = _taken_from_white(image)
    amount = taken.max(axis=1)
    if not amount.any():
        raise InputError(bare(image.name))
    rng = np.random.default_rng(np.random.SeedSequence(seed))
    drawn = rng.choice(len(amount), SAMPLED, p=amount / amount.sum())
    hues, amounts = taken[drawn] / amount[drawn, None], amount[drawn]
    distinct = len(np.unique(np.rint(hues * 255), axis=0))
    centres, cluster = kmeans2(hues, min(count, distinct), minit="++", seed=rng)
    inks = [
        centre / centre.max() * np.quantile(amounts[cluster == k], FULL)
        for k, centre in enumerate(centres)
        if (cluster == k).any()
    ]
    codes = np.rint(255 * (1 - np.array(inks))).astype(int)
    return _light_first({f"#{red:02x}{green:02x}{blue:02x}" for red, green, blue in codes})


def palette_darkness(image: Image, palette: Sequence[str], curve: ToneCurve = PLAIN) -> dict[str, Darkness]:
    """Part an image into the inks of a palette.

    Parameters
    ----------
    image : Image
        The image.
    palette : sequence of str
        ``#rrggbb``, in the order of printing.
    curve : ToneCurve
        Taken of each ink by itself, 1 less an ink's share being its tone.

    Returns
    -------
    dict of str to Darkness
        By colour, without those that the image needs nowhere.

    Raises
    ------
    InputError
        If it needs none, or light is to be dense.
    """
    if curve.invert:
        raise InputError("invert goes with one ink; colours have no negative here")
    codes, pixel = np.unique(np.rint(_taken_from_white(image) * 255), axis=0, return_inverse=True)
    shares = np.concatenate([ink_shares(part, palette) for part in _chunks(codes / 255)])
    of_pixels = curve.darkness(1 - shares[pixel.ravel()]).reshape(*image.samples.shape[:2], len(palette))
    found = {
        colour: Darkness(of_pixels[..., k], f"{image.name}, {colour}", image.remarks)
        for k, colour in enumerate(palette)
        if of_pixels[..., k].any()
    }
    if not found:
        raise InputError(bare(image.name))
    return found


def ink_shares(taken: FloatArray, palette: Sequence[str]) -> FloatArray:
    """Mix colours from inks that lie beside one another on white paper.

    Parameters
    ----------
    taken : (m, 3) float64
        What each colour takes from white, 0 to 1: 1 - (red, green, blue).
    palette : sequence of str
        k inks as ``#rrggbb``.

    Returns
    -------
    (m, k) float64
        Shares a of the paper that each ink covers: at least 0, and together at most 1.

    Notes
    -----
    They make 1/2 |taken - a D|^2 + lambda sum(a) least, D being what the inks take and lambda = 1e-3, which
    prefers one black dot to three of other colours. Every choice of the inks that can be the optimum's, with
    some paper left or none, is solved and the best feasible one taken: the least is found exactly.
    """
    inks = np.array([[255 - int(colour[k : k + 2], 16) for k in (1, 3, 5)] for colour in palette]) / 255
    best = 0.5 * (taken**2).sum(axis=1)
    shares = np.zeros((len(taken), len(inks)))
    for chosen, covered in _supports(len(inks)):
        own = inks[list(chosen)]
        k = len(chosen)
        system = np.zeros((k + covered, k + covered))
        system[:k, :k] = own @ own.T
        right = np.ones((len(taken), k + covered))
        right[:, :k] = taken @ own.T - LEAST_INK
        if covered:
            system[:k, k] = system[k, :k] = 1
        a = (right @ np.linalg.pinv(system))[:, :k]
        value = 0.5 * ((taken - a @ own) ** 2).sum(axis=1) + LEAST_INK * a.sum(axis=1)
        better = (a.min(axis=1) >= 0) & (a.sum(axis=1) <= 1 + 1e-12) & (value < best)
        best[better] = value[better]
        shares[better] = 0
        shares[np.ix_(better, list(chosen))] = a[better]
    return np.minimum(shares, 1)


def _supports(inks: int) -> Iterator[tuple[tuple[int, ...], bool]]:
    """Choices of inks, and whether they cover the paper: three colours need three inks and paper, or four."""
    for covered in (False, True):
        for k in range(1, min(inks, 4 if covered else 3) + 1):
            for chosen in itertools.combinations(range(inks), k):
                yield chosen, covered


def _taken_from_white(image: Image) -> FloatArray:
    rgb: NDArray[np.float64] = 1 - image.rgb.astype(np.float64)
    return np.broadcast_to(rgb, (*rgb.shape[:2], 3)).reshape(-1, 3)


def _chunks(rows: FloatArray) -> Iterator[FloatArray]:
    for first in range(0, len(rows), CHUNK):
        yield rows[first : first + CHUNK]


def _light_first(colours: set[str] | list[str]) -> tuple[str, ...]:
    return tuple(sorted(colours, key=lambda colour: (-luma(colour), colour)))
