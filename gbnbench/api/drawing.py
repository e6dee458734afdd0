"""Stipplings drawn from darkness: of one ink, or of several whose union is blue noise too."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from gbnbench import __version__
from gbnbench.api.stippling import Stippling
from gbnbench.core.errors import DeviceError
from gbnbench.core.settings import specification
from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.gbn.progressive import progressive_order
from gbnbench.generators.adaptive.protocol import AdaptiveGenerator, Seen, Told
from gbnbench.generators.adaptive.registry import adaptive_classes, adaptive_generator
from gbnbench.opencl import choose, use_device
from gbnbench.studies.stippling.amplitudes import amplitudes
from gbnbench.studies.stippling.darkness import Darkness


def draw(
    darkness: Darkness,
    n: int | None = None,
    *,
    method: AdaptiveGenerator | str = "gbn",
    seed: int = 0,
    toroidal: bool = False,
    progress: Told | None = None,
    device: str | None = None,
) -> Stippling:
    """Draw points for a darkness.

    Parameters
    ----------
    darkness : Darkness
        What is to be drawn.
    n, method, seed, toroidal, progress, device
        As ``stipple`` takes them.

    Returns
    -------
    Stippling

    Raises
    ------
    InputError
        If an argument breaks its rule, or nothing is dark.
    RefusalError
        If the method cannot make such a set.
    """
    count = darkness.default_n if n is None else n
    made = draw_inks(
        {"": darkness}, {"": count},
        method=method, seed=seed, toroidal=toroidal, progress=progress, device=device,
    )  # fmt: skip
    return made[""]


def draw_inks(
    darkness: Mapping[str, Darkness],
    counts: Mapping[str, int],
    *,
    method: AdaptiveGenerator | str = "gbn",
    seed: int = 0,
    toroidal: bool = False,
    progress: Told | None = None,
    seen: Callable[[dict[str, FloatArray]], None] | None = None,
    device: str | None = None,
) -> dict[str, Stippling]:
    """Draw points of several inks.

    Parameters
    ----------
    darkness : mapping of str to Darkness
        Of each ink, on one grid of pixels, by name.
    counts : mapping of str to int
        Points of each.
    method : AdaptiveGenerator or str
        As ``stipple`` takes it; gbn draws all inks together, so that their union is blue noise too, others
        draw each by itself.
    seed, toroidal, progress, device
        As ``stipple`` takes them.
    seen : callable, optional
        Called with the points of each ink, as ``Stippling.pixels``, at the start and after each step; only
        by gbn.

    Returns
    -------
    dict of str to Stippling
        By the names of the inks; ``seconds`` are those of them all.

    Raises
    ------
    InputError
        If an argument breaks its rule, or nothing is dark.
    RefusalError
        If the method cannot make such sets.

    Examples
    --------
    >>> import numpy as np
    >>> inks = {"red": Darkness(np.full((9, 9), 0.2), "red"), "blue": Darkness(np.full((9, 9), 0.1), "blue")}
    >>> made = draw_inks(inks, {"red": 20, "blue": 10}, method="gbn[gradients=5]")
    >>> [len(one.points) for one in made.values()]
    [20, 10]
    """
    generator = adaptive_generator(method) if isinstance(method, str) else method
    densities = [one.density(toroidal=toroidal) for one in darkness.values()]
    began = time.perf_counter()
    with use_device(device):
        sets = adaptive_classes(
            generator, densities, [counts[ink] for ink in darkness], seed=seed, told=progress,
            seen=None if seen is None else _by_ink(darkness, seen),
        )  # fmt: skip
        used = _device_name()
    seconds = time.perf_counter() - began
    return {
        ink: Stippling(
            pixels=np.ascontiguousarray(x[:, ::-1]),
            amplitudes=amplitudes(generator, density, x),
            density=density,
            coverage=dark.coverage,
            name=dark.name,
            method=specification(generator),
            seed=int(seed),
            device=used,
            version=__version__,
            seconds=seconds,
            remarks=dark.remarks,
        )
        for (ink, dark), density, x in zip(darkness.items(), densities, sets, strict=True)
    }


def in_progressive_order(made: Stippling, progress: Told | None = None) -> Stippling:
    """Put the points in an order of which every prefix is a stippling of the image.

    Parameters
    ----------
    made : Stippling
        By any method.
    progress : callable, optional
        Called with (points in order, n, what is being done).

    Returns
    -------
    Stippling
        The same points in the new order.
    """
    order = progressive_order(made.density, made.pixels[:, ::-1], told=progress)
    return replace(made, pixels=made.pixels[order], amplitudes=made.amplitudes[order])


def _by_ink(inks: Mapping[str, object], seen: Callable[[dict[str, FloatArray]], None]) -> Seen:
    def told(sets: Sequence[FloatArray]) -> None:
        seen({ink: x[:, ::-1] for ink, x in zip(inks, sets, strict=True)})

    return told


def _device_name() -> str:
    try:
        return choose().name
    except DeviceError:  # which a method without kernels does not need
        return ""
