"""Sums of many Gaussians of different widths at many places, on the OpenCL device."""

from __future__ import annotations

import numpy as np

from gbnbench.analysis.precision import precision_of
from gbnbench.core.neighbour_grid import neighbour_grid
from gbnbench.core.torus import FloatArray

REACH = 5.5  # standard deviations after which a kernel ends: 3e-7 of its height
CHUNK = 16  # places that a work-item of a CPU sums for
BATCH = 1 << 22  # places of a launch


def kernel_sums(
    places: FloatArray, points: FloatArray, weights: FloatArray, variances: FloatArray
) -> FloatArray:
    """Sum w_l exp(-|x - x_l|^2 / (2 v_l)) over points.

    Parameters
    ----------
    places : (m, d) float64
        Where the sum is wanted; d is 2 or 3.
    points : (n, d) float64
        Centres of kernels.
    weights, variances : (n,) float64
        Their heights and variances, these above 0.

    Returns
    -------
    (m,) float64
        To 1e-6 of the heights that add up.
    """
    p = precision_of("float")
    rt, d = p.runtime, places.shape[1]
    grid = neighbour_grid(points, variances, REACH, None)
    stride = grid.places.shape[1] + p.lanes
    sources = np.zeros((d + 2, stride), p.real)
    sources[:d, : len(points)] = grid.places
    sources[d, grid.targets] = weights[grid.points]
    sources[d + 1] = 1
    sources[d + 1, : len(points)] = grid.variances
    arguments = (
        np.uint32(stride),
        rt.upload(sources[:d]),
        rt.upload(sources[d]),
        rt.upload(sources[d + 1]),
        np.uint32(len(grid.sides)),
        rt.upload(grid.sides.astype(p.real)),
        rt.upload(grid.widest.astype(p.real)),
        rt.upload(grid.counts),
        rt.upload(grid.offsets),
        rt.upload(grid.starts),
        p.real(REACH),
    )
    program = p.program("/exp2.cl", "kernel_sums.cl", AXES=d)
    chunk = CHUNK if rt.device.is_cpu else 1
    corner, found = points.min(axis=0), np.empty(len(places), p.real)
    for first in range(0, len(places), BATCH):
        some = places[first : first + BATCH]
        items = -(-len(some) // chunk)
        out = rt.empty(some.shape[0] * np.dtype(p.real).itemsize)
        program.run(
            "kernel_sums",
            (-(-items // rt.group) * rt.group,),
            (rt.group,),
            np.uint32(len(some)),
            np.uint32(chunk),
            rt.upload((some - corner).T.astype(p.real)),
            *arguments,
            out,
        )
        rt.download(out, found[first : first + BATCH])
    return found.astype(np.float64)
