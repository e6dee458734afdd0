"""A small library of random points, written by hand: what the reader is held against."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path

import numpy as np

from gbnbench.io.set_library.entries import ReadySets, RefusedSets
from gbnbench.io.set_library.manifest import Manifest
from gbnbench.io.set_library.set_file import encoded


def small_library(folder: Path) -> Manifest:
    """Write two files of sets and their manifest into a folder."""
    entries = []
    for n, d in ((16, 2), (8, 3)):
        sets = np.random.default_rng(n).random((2, n, d))
        name = f"random/{d}d/random-{d}d-{n}.npy"
        (folder / name).parent.mkdir(parents=True)
        np.save(folder / name, sets)
        entries.append(
            ReadySets(
                file=name, generator="random", settings={}, n=n, d=d, realizations=(0, 3),
                refused={"1": "no", "2": "no"}, cpu_seconds=0.5, measuring_cpu_seconds=0.25,
                measures={"noise_floor": 1.0}, standard_errors={"noise_floor": 0.5},
                undefined={"psi6": "psi6 is defined in the plane; got d=3"} if d == 3 else {},
                sha256=hashlib.sha256(encoded(sets)).hexdigest(),
            )
        )  # fmt: skip
    manifest = Manifest("0.0", 7, None).with_entries([*entries, RefusedSets("bnot", 8, 3, "bnot is 2D")])
    (folder / "manifest.json").write_text(json.dumps(manifest.record()))
    return manifest
