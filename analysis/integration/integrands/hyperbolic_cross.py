"""Hyperbolic crosses: integer vectors classed by the product of their components that are not 0."""

from __future__ import annotations

from collections import defaultdict

import numpy as np
from numpy.typing import NDArray


def product_classes(d: int, most: int) -> dict[tuple[int, int], int]:
    """Count integer vectors by their components that are not 0 and the product of the sizes of these.

    Parameters
    ----------
    d : int
        Dimension.
    most : int
        Largest product.

    Returns
    -------
    dict
        (components that are not 0, product) -> vectors; (0, 1) is the vector 0.
    """
    classes = {(0, 1): 1}
    for _ in range(d):
        longer: defaultdict[tuple[int, int], int] = defaultdict(int)
        for (j, product), count in classes.items():
            longer[j, product] += count
            for h in range(1, most // product + 1):
                longer[j + 1, product * h] += 2 * count
        classes = dict(longer)
    return classes


def half_cross(d: int, classes: list[tuple[int, int]]) -> NDArray[np.int64]:
    """List half the integer vectors of some classes, the first component that is not 0 being positive.

    Parameters
    ----------
    d : int
        Dimension.
    classes : list of (int, int)
        Keys of ``product_classes``.

    Returns
    -------
    (m, d) int64
    """
    most = max(product for _, product in classes)
    wanted = np.zeros((d + 1, most + 1), dtype=bool)
    for key in classes:
        wanted[key] = True
    # Whether a vector may still become one of a class: by nonzeros and product so far, axes to go.
    open_to = [wanted]
    for _ in range(d):
        after = open_to[-1]
        before = after.copy()
        for h in range(1, most + 1):
            reach = most // h
            before[:-1, 1 : reach + 1] |= after[1:, h : reach * h + 1 : h]
        open_to.append(before)
    rows = np.zeros((1, 0), dtype=np.int64)
    j, product = np.zeros(1, dtype=np.int64), np.ones(1, dtype=np.int64)
    side = np.arange(-most, most + 1)
    size = np.maximum(np.abs(side), 1)
    for left in range(d - 1, -1, -1):
        row, column = np.nonzero((product[:, None] * size <= most) & ((j > 0)[:, None] | (side >= 0)))
        nonzeros, products = j[row] + (side[column] != 0), product[row] * size[column]
        keep = open_to[left][nonzeros, products]
        row, column = row[keep], column[keep]
        rows = np.column_stack([rows[row], side[column]])
        j, product = nonzeros[keep], products[keep]
    return rows
