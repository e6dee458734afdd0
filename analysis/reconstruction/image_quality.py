"""Quality of a reconstructed image beside the one that was sampled: PSNR and SSIM."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from skimage.metrics import structural_similarity

from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray

WINDOW = 7  # of SSIM, in pixels


@dataclass(frozen=True)
class ImageQuality:
    """Quality of a reconstruction.

    Attributes
    ----------
    psnr : float
        Peak signal over root mean square error, in dB; the peak is the image's largest value, to
        which the reconstruction is cut.
    ssim : float
        Structural similarity (Wang et al. 2004, but with a uniform window of 7 x 7 pixels), 1 for the image
        itself; nan for images below 7 pixels a side.
    gain : float
        By which the reconstruction was multiplied: that which makes the error least.
    """

    psnr: float
    ssim: float
    gain: float


def image_quality(reconstruction: FloatArray, image: FloatArray) -> ImageQuality:
    """Compare a reconstruction, whose scale is free, with the image.

    Parameters
    ----------
    reconstruction, image : float64 arrays of one shape
        At least 0.

    Returns
    -------
    ImageQuality

    Raises
    ------
    InputError
        If the shapes differ.
    """
    if reconstruction.shape != image.shape:
        raise InputError(f"images must have one shape; got {reconstruction.shape} and {image.shape}")
    peak = float(image.max())
    square = float((reconstruction**2).sum())
    gain = float((reconstruction * image).sum()) / square if square > 0 else 0.0
    scaled = np.clip(gain * reconstruction, 0, peak)
    error = float(((scaled - image) ** 2).mean())
    psnr = 10 * math.log10(peak**2 / error) if error > 0 else math.inf
    if min(image.shape) < WINDOW:
        return ImageQuality(psnr, math.nan, gain)
    found: Any = structural_similarity(scaled, image, data_range=peak, win_size=WINDOW)  # type: ignore[no-untyped-call]
    return ImageQuality(psnr, float(found), gain)
