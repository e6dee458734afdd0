"""Point sets on the device, as tables of frequencies are made of them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class DevicePoints:
    """A batch of point sets on the device.

    Attributes
    ----------
    turns, weight : buffer
        Fixed-point coordinates, and weights, which are 0 beyond the last point.
    stride : int
        Numbers from one coordinate of a set to the next.
    weight_stride : int
        Numbers from one set's weights to the next set's; 0 where all sets share them.
    """

    turns: Any
    weight: Any
    stride: int
    weight_stride: int
