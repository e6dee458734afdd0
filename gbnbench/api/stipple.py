"""``gbnbench.stipple``: points whose density follows an image, a volume or a function."""

from __future__ import annotations

from collections.abc import Callable

from gbnbench.api.drawing import draw, in_progressive_order
from gbnbench.api.stippling import Stippling
from gbnbench.core.flags import check_flags
from gbnbench.generators.adaptive.density import Density
from gbnbench.generators.adaptive.protocol import AdaptiveGenerator
from gbnbench.opencl import use_device
from gbnbench.studies.stippling.darkness import ImageLike, ToneCurve, as_darkness


def stipple(
    image: ImageLike,
    n: int | None = None,
    *,
    method: AdaptiveGenerator | str = "gbn",
    seed: int = 0,
    toroidal: bool = False,
    progressive: bool = False,
    invert: bool = False,
    gamma: float = 1.0,
    white_cutoff: float | None = None,
    shape: tuple[int, ...] | None = None,
    progress: Callable[[int, int, str], None] | None = None,
    device: str | None = None,
) -> Stippling:
    """Draw points whose density follows an image or any other density.

    Parameters
    ----------
    image : str, path, array_like, Density or callable
        What is to be drawn:

        - a file that Pillow or tifffile reads, or the name of an image of scikit-image's such as
          ``"camera"``: dark is dense;
        - an array (rows, columns) of greys or (rows, columns, 3) of colours, with or without alpha: unsigned
          whole numbers, or real numbers from 0 (black) to 1 (white): dark is dense;
        - any other array of three axes, (slices, rows, columns): a volume of densities, large is dense;
        - a ``Density`` (``gbnbench.generators.adaptive.density.as_density``): large is dense;
        - a function of positions (m, d) in pixels, in the order of ``shape``, that gives a density for each.

        A .npy file is what its array would be.
    n : int, optional
        Points, at least 1. By default one for every 2.5 by 2.5 pixels of black ink that the image needs
        (in volumes 2.5 cubed), 20,000 at most: enough to show what the pixels show.
    method : AdaptiveGenerator or str
        A name of ``ADAPTIVE_GENERATORS``, with settings such as ``"gbn[sigma=0.85]"``.
    seed : int
        >= 0; the points are drawn from ``SeedSequence(seed, spawn_key=(0,))``.
    toroidal : bool
        Opposite borders meet, so that copies side by side have no seam.
    progressive : bool
        Order the points so that the first m of them draw the image too, for every m.
    invert : bool
        Of an image: light is dense.
    gamma : float
        Of an image: exponent of its tones, above 0; 2.2 takes them as the light that they stand for, which
        makes mid-tones denser, or sparser where light is dense.
    white_cutoff : float, optional
        Of an image: tone, 0 to 1, from which on there are no points; with ``invert`` there are none where
        the tone is 1 less that or darker, as the paper is black.
    shape : tuple of int, optional
        Of a function: pixels along each axis, (rows, columns) or (slices, rows, columns).
    progress : callable, optional
        Called with (steps done, steps in all, what is being done).
    device : str, optional
        Part of the name of the OpenCL device, or its position, as in ``GBNBENCH_DEVICE``.

    Returns
    -------
    Stippling

    Raises
    ------
    FormatError
        If a file cannot be read as an image.
    InputError
        If an argument breaks its rule, or nothing is dark.
    RefusalError
        If the method cannot make such a set.
    DeviceError
        If a device is named and fits none or several.

    Notes
    -----
    Darkness is 1 - tone^gamma, or tone^gamma where light is dense, the tone being the grey as it is coded, or
    the luma of a colour (Rec. ITU-R BT.709). By default gbn follows Ahmed, Ren & Wonka, "Gaussian blue
    noise", 2022, Sections 4.10 and 5.3.

    Examples
    --------
    >>> import gbnbench
    >>> made = gbnbench.stipple("coins", 300, method="gbn[gradients=10]", invert=True)
    >>> made.points.shape, made.size
    ((300, 2), (384, 303))
    """
    check_flags(toroidal=toroidal, progressive=progressive)
    curve = ToneCurve(invert, gamma, white_cutoff)
    made = draw(
        as_darkness(image, shape=shape, curve=curve), n,
        method=method, seed=seed, progress=progress, device=device,
        toroidal=toroidal or (isinstance(image, Density) and image.toroidal),
    )  # fmt: skip
    if progressive:
        with use_device(device):
            return in_progressive_order(made, progress)
    return made
