"""Wrong kernels planted one at a time: `gbnbench doctor` has to name each and trust the device no more."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

import gbnbench
from gbnbench.benchmarks.reliability.commands import GBNBENCH, TIMEOUT, empty_folder
from gbnbench.benchmarks.reliability.trial import FAULT, Trials, shortened


@dataclass(frozen=True)
class Plant:
    """A mistake in the text of a kernel.

    Attributes
    ----------
    file : str
        Of the kernel; the same name stands once in the tree.
    right, wrong : str
        What stands there, and what is planted.
    kernel : str
        What doctor has to name, or the beginning of it.
    """

    file: str
    right: str
    wrong: str
    kernel: str


PLANTS = {
    "a sign in the product": Plant("product.cl", "c2##r += c * e2;", "c2##r -= c * e2;", "two-group product"),
    "sums of frequency 0 that forget": Plant(
        "product.cl", "tc##r += LOADV", "tc##r = LOADV", "two-group product"
    ),
    "a whole that forgets its parts": Plant(
        "register_sums.cl",
        "old = whole > 1 ? LOAD_SUMS",
        "old = whole > 2 ? LOAD_SUMS",
        "two-group product",
    ),
    "a square subtracted": Plant(
        "power.cl", "(cc - ss) * (cc - ss) + ", "(cc - ss) * (cc - ss) - ", "two-group product"
    ),
    "a table's angle": Plant(
        "tables.cl", "*s = su * cv + cu * sv", "*s = su * cv - cu * sv", "two-group product"
    ),
    "a sine for a cosine": Plant("selected.cl", "sines += w * s;", "sines += w * c;", "listed frequencies"),
    "a point left out": Plant(
        "selected.cl", "k = first; k < end", "k = first + LANES; k < end", "listed frequencies"
    ),
    "a Taylor term": Plant("/turns.cl", "1.0 / 24 ", "1.0 / 25 ", "two-group product"),
    "a tile of a small cube": Plant(
        "small_cube.cl", "(rows + ROWS - 1) / ROWS", "rows / ROWS", "two-group product"
    ),
    "a turn's unit": Plant(
        "turn_rows.cl", "exponent - one_turn : none", "exponent - (one_turn + 1) : none", "two-group product"
    ),
    "a quarter turn": Plant("/turns.cl", "(quarter & (TURN)2)", "(quarter & (TURN)1)", "two-group product"),
    "pairs counted once": Plant("shells.cl", "? 2 : 1", "? 1 : 1", "shells"),
    "a shell at the edge": Plant("shells.cl", "square > high", "square >= high", "shells"),
    "a window's sines": Plant("spread.cl", "s##m += by * sines;", "s##m -= by * sines;", "gridded product"),
    "a window's odd part": Plant(
        "grid_spread.cl", "= even1 + odd1 * s;", "= even1 - odd1 * s;", "gridded FFT"
    ),
    "a harmonic's odd part": Plant("plane_transform.cl", "m.re - p.re", "p.re - m.re", "gridded FFT"),
    "a fifth of a turn": Plant("fourier_passes.cl", "0.58778525", "0.58778526", "gridded FFT"),
    "an eighth of a turn": Plant("fourier_passes.cl", "b3), -root", "b3), root", "gridded FFT"),
    "a negative frequency": Plant("grid_power.cl", "f + wrap : f", "f + wrap - 1 : f", "gridded FFT"),
    "another point's place": Plant("line_spread.cl", "y, other, at)", "y, place, at)", "gridded FFT"),
    "a point in another's place": Plant(
        "deal_points.cl", "counts[places[k]]++;\n    for", "counts[places[k]];\n    for", "gridded FFT"
    ),
    "lanes in another order": Plant(
        "tables.cl", "STORE_ALIGNED(v[l]", "STORE_ALIGNED(v[LANES - 1 - l]", "two-group product"
    ),
    "a kernel of pairs": Plant("discrepancy_pairs.cl", "(t - t * t)", "(t + t * t)", "discrepancy, periodic"),
    "a lane too many": Plant("pair_distances.cl", "l < end - j", "l < LANES", "pair distances"),
    "a smaller for a larger": Plant(
        "discrepancy_pairs.cl", "at[a] > other", "at[a] < other", "discrepancy, star"
    ),
    "a displacement's sign": Plant("gbn_images.cl", "u = k - l;", "u = l - k;", "gbn gradient, images"),
    "an image of the box": Plant(
        "gbn_images.cl", "m * side;", "m * side * (REAL)1.01;", "gbn gradient, images"
    ),
    "a sine's sign": Plant("gbn_theta.cl", "at[2 * a] - ck[a]", "at[2 * a] + ck[a]", "gbn gradient, theta"),
    "a polynomial's last term": Plant("gbn_theta.cl", "value * c + w[0]", "value * c", "gbn gradient, theta"),
    "two points mixed up": Plant(
        "gbn_slopes.cl", "+= coefficient * right", "+= coefficient * left", "gbn gradient, harmonics"
    ),
    "an angle's sum": Plant(
        "gbn_harmonics.cl",
        "low_cos[r] - s * low_sin[r]",
        "low_cos[r] + s * low_sin[r]",
        "gbn gradient, harmonics",
    ),
    "strips too short": Plant(
        "gbn_strips.cl", "return gap * gap;", "return gap * gap * 4;", "gbn gradient, strips"
    ),
    "a triangle too small": Plant("fpo.cl", "tree[2 * i] < tree", "tree[2 * i] > tree", "farthest"),
    "a swap's gain": Plant(
        "ccvt_swap.cl",
        "row.u.x + row.y[k] * row.u.y; }",
        "row.u.x - row.y[k] * row.u.y; }",
        "swaps of samples",
    ),
    "a centroid's sign": Plant(
        "ccvt_recentre.cl", "centroid = shift", "centroid = -shift", "swaps of samples"
    ),
    "a spline's slope": Plant("adaptive_widths.cl", "slope[3] = t * t", "slope[3] = t", "adaptive gradient"),
    "a kernel's variance": Plant(
        "adaptive_pairs.cl", "v + LOADV(variances, l)", "v + v", "adaptive gradient"
    ),
    "a pixel's pull": Plant(
        "adaptive_pull.cl", "squares += part_xx", "squares -= part_xx", "adaptive gradient"
    ),
    "a sum's last lanes": Plant("kernel_sums.cl", "(to - l) ? g", "(to - l + 1) ? g", "sums of kernels"),
    "an integrand's term": Plant(
        "gaussians.cl", "* c + shape[power]", "* c - shape[power]", "integrand, gaussians"
    ),
    "an integrand's image": Plant("gaussians.cl", "u - ((u + round) - round)", "u", "integrand, gaussians"),
    "an integrand's phase": Plant("waves.cl", "total += cosine;", "total += sine;", "integrand, waves"),
}


def _spoil(plant: Plant, folder: Path) -> None:
    """Copy the package into a folder, with the mistake in its kernel."""
    package = folder / "gbnbench"
    skipped = shutil.ignore_patterns("__pycache__", "*.npz", "*.pdf", "*.png", ".gbnbench-*.tmp")
    shutil.copytree(Path(gbnbench.__file__).parent, package, ignore=skipped)
    (kernel,) = package.rglob(f"kernels/{plant.file.lstrip('/')}")
    text = kernel.read_text(encoding="utf-8")
    kernel.write_text(text.replace(plant.right, plant.wrong, 1), encoding="utf-8")


def planted_kernel(name: str) -> list[Trials]:
    """Plant a mistake and ask the doctor.

    Parameters
    ----------
    name : str
        One of ``PLANTS``.

    Returns
    -------
    list of Trials
    """
    plant = PLANTS[name]
    with empty_folder() as folder:
        _spoil(plant, folder)
        done = subprocess.run(
            [*GBNBENCH, "doctor", "--quick", "--json"],
            env={**os.environ, "PYTHONPATH": str(folder)},
            cwd=folder, capture_output=True, text=True, timeout=TIMEOUT, check=False,
        )  # fmt: skip
    tried = f"{name} ({plant.file.lstrip('/')})"
    try:
        checks = json.loads(done.stdout)
    except ValueError:
        return [
            Trials(
                "doctor", tried, "no verdict", FAULT, 1, shortened(f"{done.returncode} {done.stderr[-500:]}")
            )
        ]
    failed = sorted({check["kernel"] for check in checks if not check["passed"]})
    if done.returncode != 1 or not any(kernel.startswith(plant.kernel) for kernel in failed):
        said = shortened(f"exit code {done.returncode}; named: {', '.join(failed)}")
        return [Trials("doctor", tried, "not noticed", FAULT, 1, said)]
    return [Trials("doctor", tried, "named, and the device not trusted", note=", ".join(failed))]
