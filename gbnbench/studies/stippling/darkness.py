"""Darkness: which share of each pixel is to be covered, from the tones of an image or from any density."""

from __future__ import annotations

import math
import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from gbnbench.core.errors import FormatError, InputError
from gbnbench.core.flags import check_flags
from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density, as_density, density_of
from gbnbench.io.images import Image, read_image
from gbnbench.io.images.arrays import ARRAY_SUFFIX, COLOURS, image_of, load_array
from gbnbench.studies.stippling.units import checked_shape

# what stipple takes: a path or name, an array, an image that was read, a density, or a function of positions
ImageLike = str | os.PathLike[str] | ArrayLike | Image | Density | Callable[[FloatArray], ArrayLike]

PIXELS_A_POINT = 2.5  # side of the black square for which one point stands, unless n is given
MOST_POINTS = 20_000  # unless n is given


@dataclass(frozen=True)
class ToneCurve:
    """From tones to darkness.

    Parameters
    ----------
    invert : bool
        Light is dense: white dots on black paper cover what black dots on white leave free.
    gamma : float
        Exponent of the tones, above 0: 1 takes them as they are coded, 2.2 as the light that they stand for,
        which makes mid-tones denser, or sparser where light is dense.
    white_cutoff : float, optional
        How near to the paper's colour, 0 to 1, a tone is that gets no points: without invert tones of that
        and above, with invert, where the paper is black, tones of 1 less that and below. By default only
        where the tone is the paper's.

    Raises
    ------
    InputError
        If a setting is out of range.
    """

    invert: bool = False
    gamma: float = 1.0
    white_cutoff: float | None = None

    def __post_init__(self) -> None:
        check_flags(invert=self.invert)
        if not (math.isfinite(self.gamma) and self.gamma > 0):
            raise InputError(f"gamma must be above 0; got {self.gamma}")
        if self.white_cutoff is not None and not 0 < self.white_cutoff <= 1:
            raise InputError(f"white_cutoff must be above 0 and at most 1; got {self.white_cutoff}")

    def darkness(self, tones: FloatArray) -> FloatArray:
        """Turn tones into darkness.

        Parameters
        ----------
        tones : float64
            0 black to 1 white.

        Returns
        -------
        float64
            1 - tone^gamma, inverted tone^gamma; 0 where the tone is the paper's by the cutoff.
        """
        light = tones if self.gamma == 1 else tones**self.gamma
        dark = light if self.invert else 1 - light
        if self.white_cutoff is not None:
            paper = 1 - tones if self.invert else tones
            dark = np.where(paper >= self.white_cutoff, 0.0, dark)
        return np.asarray(dark, np.float64)


PLAIN = ToneCurve()


def bare(name: str) -> str:
    """Say of an image that it needs no dots.

    Parameters
    ----------
    name : str
        What the image is called.

    Returns
    -------
    str
    """
    return (
        f"{name} has no place for points: it is all white (with invert all black), or as light everywhere as "
        "the white cutoff leaves bare"
    )


@dataclass(frozen=True)
class Darkness:
    """What is to be stippled.

    Attributes
    ----------
    values : (rows, columns) or (slices, rows, columns) float64
        Share of each pixel that is to be covered, 0 to 1.
    name : str
        What it is called in messages.
    remarks : tuple of str
        What was done to read it that might surprise.
    """

    values: FloatArray
    name: str
    remarks: tuple[str, ...] = ()

    @property
    def coverage(self) -> float:
        """Mean over all pixels."""
        return float(self.values.mean())

    @property
    def default_n(self) -> int:
        """Points that draw it well: one for 2.5 by 2.5 pixels of black (2.5 cubed), 20,000 at most."""
        black = float(self.values.sum())
        return max(1, min(MOST_POINTS, round(black / PIXELS_A_POINT**self.values.ndim)))

    def density(self, *, toroidal: bool = False) -> Density:
        """Take the darkness as a density of points.

        Parameters
        ----------
        toroidal : bool
            Whether opposite borders meet.

        Returns
        -------
        Density

        Raises
        ------
        InputError
            If there is no darkness anywhere.
        """
        if not self.values.any():
            raise InputError(bare(self.name))
        return as_density(self.values, toroidal=toroidal)


def image_darkness(image: Image, curve: ToneCurve = PLAIN) -> Darkness:
    """Take the tones of an image.

    Parameters
    ----------
    image : Image
        The image.
    curve : ToneCurve
        From tones to darkness.

    Returns
    -------
    Darkness
    """
    return Darkness(curve.darkness(image.tones), image.name, image.remarks)


def as_darkness(
    image: ImageLike, *, shape: tuple[int, ...] | None = None, curve: ToneCurve = PLAIN
) -> Darkness:
    """Take whatever can be stippled.

    Parameters
    ----------
    image : str, path, array_like, Image, Density or callable
        As ``gbnbench.stipple`` takes it.
    shape : tuple of int, optional
        Pixels along each axis, of a callable.
    curve : ToneCurve
        From tones to darkness; what is a density already takes none.

    Returns
    -------
    Darkness

    Raises
    ------
    FormatError
        If a file cannot be read.
    InputError
        If this can be no image and no density.
    """
    if callable(image) and shape is None:
        raise InputError(
            "a function of positions needs shape, the pixels that it is taken at, such as (300, 400)"
        )
    if shape is not None and not callable(image):
        raise InputError("shape is of a function of positions: leave it out, as the image has its own pixels")
    if isinstance(image, Image):
        return image_darkness(image, curve)
    if isinstance(image, Density):
        return _density(image, "the density", curve)
    if callable(image) and shape is not None:
        return _density(density_of(image, checked_shape(shape, (2, 3))), "the density", curve)
    if isinstance(image, (str, os.PathLike)):
        path = Path(image)
        if path.suffix.lower() != ARRAY_SUFFIX or not path.is_file():
            return image_darkness(read_image(image), curve)
        try:
            return _array(load_array(path), str(path), curve)
        except FormatError:
            raise
        except InputError as error:
            raise FormatError(path, str(error)) from None
    return _array(np.asarray(image), "the array", curve)


def _array(array: np.ndarray[Any, Any], name: str, curve: ToneCurve) -> Darkness:
    """Three axes, the last of which cannot be colours, are a volume of densities; all else is an image."""
    if array.ndim == 3 and array.shape[2] not in COLOURS:
        return _density(as_density(array), name, curve)
    return image_darkness(image_of(array, name), curve)


def _density(density: Density, name: str, curve: ToneCurve) -> Darkness:
    if curve != PLAIN:
        raise InputError(f"invert, gamma and white_cutoff are of an image's tones; {name} has none")
    return Darkness(density.values, name)
