"""The energy in frequency space, E = (1/2n) sum over 0 < |f| <= reach of w_f |F_f|^2: no pair is formed."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from gbnbench.core.torus import FloatArray
from gbnbench.generators.gbn import kernel, operation_counts
from gbnbench.generators.gbn.evaluation import CHUNK, DeviceEvaluation
from gbnbench.generators.gbn.frequency_ball import ball_square
from gbnbench.generators.gbn.protocol import EnergyGradient
from gbnbench.generators.gbn.wave_tables import TILE, ball_waves
from gbnbench.opencl import Runtime

FILES = ("/turns.cl", "gbn_harmonics.cl")
LINE = 64  # bytes


class Harmonics(DeviceEvaluation):
    """The weighted power of every frequency that matters; see kernels/gbn_harmonics.cl.

    Parameters
    ----------
    runtime, n, d, sigma, precision
        As for every evaluation.
    edge : float, optional
        Keep only 0 < nu <= edge of the energy: what lies beyond is left as it falls (the supplement's step
        blue noise and one-dimensional blue noise). A ball, since blue noise is asked to be isotropic; Eq. 23
        with sums cut at f_max, as the supplement has it, is the cube around it.

    Notes
    -----
    Six flops a point and frequency of a half space, three products of tables; the ball has about
    V_d (1.4 n^(1/d) / sigma)^d frequencies in double. Where the kernel is flat the lowest frequencies are all
    there is, and their digits are kept; where it is narrow pairs are cheaper.
    """

    method = "harmonics"

    def __init__(
        self, runtime: Runtime, n: int, d: int, sigma: float, precision: str, edge: float | None = None
    ) -> None:
        super().__init__(runtime, n, d, sigma, precision)
        self.edge = edge
        self.error = operation_counts.harmonics(n, d, self.sigma, precision, edge).error
        # An odd number of cache lines: rows a power of two apart would drive each other out of the cache.
        line = 2 * self.lanes if self.lanes > 1 else LINE // self.bytes
        self.stride = (-(-n // line) | 1) * line
        modes = self.modes = ball_waves(d, ball_square(n, d, self.sigma, precision, edge))
        self._groups = (modes.leading, modes.trailing)
        fmax = math.isqrt(modes.square)
        self._waves = max(2 * fmax + 1, max(g.rows for g in self._groups if g.axes == 1) if d < 4 else 0)
        weights = modes.weights(kernel.decay(self.side, self.sigma))
        self._scale = kernel.uniform_energy(d, self.sigma) * math.exp(-kernel.decay(self.side, self.sigma))
        self._weight = runtime.upload((weights / n).astype(self.real))
        self._tiles = runtime.upload(modes.tiles)
        self._index = [runtime.upload(g.index) for g in self._groups]
        derivatives = [g.derivative() for g in self._groups]
        self._partner = [runtime.upload(partner) for partner, _ in derivatives]
        self._factor = [runtime.upload(factor.astype(self.real)) for _, factor in derivatives]
        self._column_ends = [runtime.upload(modes.column_ends(side)) for side in (0, 1)]
        defines = {"FMAX": fmax, "WAVES": self._waves, "CHUNK": CHUNK, "TILE_A": TILE[0], "TILE_B": TILE[1]}
        self._program = self.program(*FILES, **defines)
        self._slopes = [
            self.program("gbn_slopes.cl", AXES=g.axes, TILE=tile)
            for g, tile in zip(self._groups, TILE, strict=True)
            if d > 1 or g is modes.leading
        ]

    def bytes_a_set(self) -> int:
        """Size of a set's buffers."""
        rows = sum(g.rows for g in self._groups)
        products = 2 * self._groups[0].rows * self._groups[1].rows
        return self.bytes * (self.stride * (rows + self.d * (self._waves + 3)) + products)

    def _sums(self, x: FloatArray) -> EnergyGradient:
        sets = len(x)
        n, stride, many = np.uint32(self.n), np.uint32(self.stride), np.uint32(sets)
        vectors, count = self.stride // self.lanes, len(self.modes.tiles)
        wave = self.buffer("wave", sets * self.d * self._waves * self.stride)
        turns = self.send_turns(x)
        self.launch(self._program, "gbn_waves", sets * self.d * vectors, turns, many, n, stride, wave)
        tables = [self._table(k, sets, wave) for k in range(2)]
        rows = [np.uint32(g.rows) for g in self._groups]
        products = self._groups[0].rows * self._groups[1].rows
        weighted = [self.buffer(name, sets * products) for name in ("forward", "backward")]
        energy = self.buffer("energy", sets * count)
        self.launch(
            self._program, "gbn_amplitudes", sets * count, *tables[0], *tables[1], many, stride, *rows,
            self._tiles, np.uint32(count), self._weight, *weighted, energy,
        )  # fmt: skip
        gradient = self.buffer("gradient", sets * self.stride * self.d)
        for side, program in enumerate(self._slopes):
            self.launch(
                program, "gbn_slopes", sets * vectors // 2, *tables[side], *tables[1 - side], many, stride,
                rows[side], rows[1 - side], self._column_ends[side], weighted[side], self._partner[side],
                self._factor[side], np.uint32(self._groups[side].first), gradient,
            )  # fmt: skip
        slopes = self.runtime.download(gradient, np.empty((sets, self.stride, self.d), self.real))
        sums = self.runtime.download(energy, np.empty((sets, count), self.real))
        # E = (1/2n) sum w |F|^2 = n Ex; the kernel's weights are over n and over the lowest frequency's.
        return EnergyGradient(
            slopes[:, : self.n].astype(np.float64) * (self._scale / self.side),
            sums.sum(axis=1, dtype=np.float64) * (self._scale / (2 * self.n)),
        )

    def _table(self, side: int, sets: int, wave: Any) -> tuple[Any, np.uint32, np.uint32]:
        """Rows of a group: their buffer, the first row in it and the rows from a set to the next."""
        g = self._groups[side]
        if g.axes == 1:  # the axis's own waves, which stand in the same order
            return wave, np.uint32(g.first * self._waves), np.uint32(self.d * self._waves)
        table = self.buffer(f"table {side}", sets * g.rows * self.stride)
        self.launch(
            self._program, "gbn_rows", sets * g.rows, wave, np.uint32(sets), np.uint32(self.stride),
            np.uint32(g.first), np.uint32(g.axes), self._index[side], np.uint32(g.rows), table,
        )  # fmt: skip
        return table, np.uint32(0), np.uint32(g.rows)
