"""An image as numbers from 0 to 1: its tones, its colours, and the four inks that print it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray

LUMA = (0.2126, 0.7152, 0.0722)  # of red, green and blue: Rec. ITU-R BT.709

Samples: TypeAlias = NDArray[np.floating[Any]]  # float32, or float64 of arrays that have more digits


@dataclass(frozen=True)
class Image:
    """An image.

    Attributes
    ----------
    samples : (rows, columns, 1, 3 or 4) float32 or float64
        From 0 to 1: grey or red, green and blue from black to white, or shares of cyan, magenta, yellow and
        black ink.
    name : str
        What it is called in messages.
    remarks : tuple of str
        What was done to read it that might surprise, in words.
    """

    samples: Samples
    name: str
    remarks: tuple[str, ...] = ()

    @property
    def tones(self) -> FloatArray:
        """(rows, columns) float64: greys as they are coded, 0 black to 1 white, of colours their luma."""
        rgb = self.rgb
        if rgb.shape[2] == 1:
            return rgb[..., 0].astype(np.float64)
        luma: FloatArray = 1 - (1 - rgb.astype(np.float64)) @ np.array(LUMA)  # so that white is 1 exactly
        return np.clip(luma, 0, 1)

    @property
    def rgb(self) -> Samples:
        """Grey, or red, green and blue: of inks, each takes its share of what the black leaves."""
        if self.samples.shape[2] < 4:
            return self.samples
        return (1 - self.samples[..., :3]) * (1 - self.samples[..., 3:])

    @property
    def inks(self) -> Samples:
        """(rows, columns, 4) float32 or float64: cyan, magenta, yellow and black ink.

        Black takes all that the three would print together, as a grey printed by one ink is sharper.
        """
        if self.samples.shape[2] == 4:
            return self.samples
        rgb = np.broadcast_to(self.samples, (*self.samples.shape[:2], 3))
        light = rgb.max(axis=2, keepdims=True)
        coloured = 1 - rgb / np.where(light > 0, light, 1)
        return np.concatenate([np.where(light > 0, coloured, 0), 1 - light], axis=2)
