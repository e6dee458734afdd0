"""Files of other formats, for the tests of reading them."""

from __future__ import annotations

import numpy as np

from tests.io.point_bytes import npy

A, B = [[0.5, 0.25, 0.125], [0.125, 0.75, 0.5]], [[0.0, 0.875, 0.25]]
FLAT = [row[:2] for row in A]


def ply(kind: str, body: bytes, properties: str = "float x\nproperty float y\nproperty float z") -> bytes:
    head = f"ply\nformat {kind} 1.0\ncomment by hand\nelement vertex 2\nproperty {properties}\nend_header\n"
    return head.encode() + body


DUMP = """ITEM: TIMESTEP
0
ITEM: NUMBER OF ATOMS
2
ITEM: BOX BOUNDS pp pp pp
-1.0 1.0
0.0 4.0
0 8
ITEM: ATOMS id type x y z
1 1 0.0 1.0 1.0
7 2 -0.75 3.0 4.0
"""
CELL = (
    'Lattice="2.0 0 0 0 4.0 0 0 0 8.0" Origin="-1 0 0" Properties=species:S:1:pos:R:3:forces:R:3 pbc="T T T"'
)
FRACTIONS = (
    DUMP.replace("x y z", "xs ys zs")
    .replace("0.0 1.0 1.0", "0.5 0.25 0.125")
    .replace("-0.75 3.0 4.0", "0.125 0.75 0.5")
)
PLANE = (
    DUMP.replace(" z\n", "\n")
    .replace("1.0 1.0\n1", "1.0\n1")
    .replace("1.0 1.0\n7", "1.0\n7")
    .replace("3.0 4.0", "3.0")
)
EDAT = "-1\t0\n1\t4\n1\n0.0\t1.0\n-0.75\t3\n"
POLYGON = b"0.5 0.25 0.125\n0.125 0.75 0.5\n3 0 1 1\n"
FACES = "float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices"
FIELDS = npy(np.zeros(3, [("x", "f8"), ("mass", "f8")]))
