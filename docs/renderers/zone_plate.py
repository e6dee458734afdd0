"""A small renderer: a zone plate whose pixels are filtered by a set that gbnbench exported, a shift for each.

    gbnbench export gbn -n 16 -o sets.bin
    gbnbench export --mask 64 -o mask.png
    python zone_plate.py blue blue.png
    python zone_plate.py random random.png

Each pixel averages the pattern over its own square at all points of the set, shifted on the torus by a vector
that it reads from the mask (Cranley & Patterson 1976). What is printed is the root mean square error against
256 points a pixel.
"""

import json
import sys
from pathlib import Path

import numpy as np
from PIL import Image

SIDE, REFERENCE = 128, 16  # pixels of the picture; points along each side of a pixel, for the reference


def pattern(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Rings that are a pixel apart at the far corner, where a pixel can only be grey."""
    return 0.5 + 0.5 * np.cos(np.pi * (x**2 + y**2) / (SIDE * np.sqrt(2)))


def exported_points(path: Path) -> np.ndarray:
    """Read numbers by the description beside them: (sets, n, d) in [0, 1)."""
    about = json.loads(path.with_name(f"{path.name}.json").read_text())
    points = np.fromfile(path, np.dtype(about["dtype"]).newbyteorder("<")).reshape(about["shape"])
    return points / 2.0**32 if about["dtype"] == "uint32" else points.astype(np.float64)


def exported_thresholds(path: Path) -> np.ndarray:
    """Read a mask of 16 bits as thresholds in (0, 1)."""
    return (np.asarray(Image.open(path)).astype(np.float64) + 0.5) / 2**16


def main(how: str, out: str) -> None:
    """Render by blue or random samples."""
    points = exported_points(Path("sets.bin"))[0]
    mask = exported_thresholds(Path("mask.png"))
    row, column = np.mgrid[:SIDE, :SIDE]
    shifts = [np.tile(np.roll(mask, moved, (0, 1)), (SIDE // len(mask) + 1,) * 2)[:SIDE, :SIDE]
              for moved in ((0, 0), (23, 41))]  # fmt: skip
    rng = np.random.default_rng(1)
    picture = np.zeros((SIDE, SIDE))
    for point in points:
        if how == "random":
            u, v = rng.random((2, SIDE, SIDE))
        else:
            u, v = ((point[axis] + shifts[axis]) % 1.0 for axis in (0, 1))
        picture += pattern(column + u, row + v) / len(points)
    exact = np.zeros((SIDE, SIDE))
    for u in (np.arange(REFERENCE) + 0.5) / REFERENCE:
        for v in (np.arange(REFERENCE) + 0.5) / REFERENCE:
            exact += pattern(column + u, row + v) / REFERENCE**2
    Image.fromarray(np.round(255 * picture).clip(0, 255).astype(np.uint8)).save(out)
    print(f"{np.sqrt(np.mean((picture - exact) ** 2)):.6g}")


if __name__ == "__main__":
    main(*sys.argv[1:])
