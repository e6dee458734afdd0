"""Runs: any split gives the same points, a killed run goes on bit by bit, traces hold what happened."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from gbnbench.core.errors import InputError
from gbnbench.generators.gbn import batches, optimiser, step_sizes
from gbnbench.generators.gbn.energy import energy_evaluation
from gbnbench.generators.monitor import Monitor, Trace
from gbnbench.generators.registry import generate


@pytest.mark.parametrize(
    "settings", [{"gradients": 40}, {"iterations": 40}, {"excess": 3e-3}, {"gradients": 0}]
)
@pytest.mark.parametrize(("n", "d"), [(200, 2), (40, 5)])
def test_sets_are_bitwise_the_same_however_they_are_split(monkeypatch, n, d, settings):
    together = generate("gbn", n=n, d=d, seed=3, realizations=5, **settings)
    monkeypatch.setattr(batches, "BATCH", 2 * n)
    assert np.array_equal(together, generate("gbn", n=n, d=d, seed=3, realizations=5, **settings))
    assert np.array_equal(together[0], generate("gbn", n=n, d=d, seed=3, **settings))


class KilledError(Exception):
    """What stops a run in its middle."""


@pytest.mark.parametrize(
    ("n", "settings", "at"),
    [
        (200, {"gradients": 30}, 47),  # in the second batch of two sets
        (200, {"iterations": 30}, 10),
        (200, {"gradients": 30}, 90),  # after the last gradient
        (2200, {"gradients": 20}, 25),  # above 45 spacings a side: the low band has a state too
    ],
)
def test_a_killed_run_goes_on_to_the_same_points_and_trace(monkeypatch, tmp_path, n, settings, at):
    monkeypatch.setattr(batches, "BATCH", 2 * n)
    whole, kept = Trace(keep_at=(5, 20)), tmp_path / "state.npz"
    expected = generate("gbn", n=n, seed=1, realizations=6, monitor=Monitor(trace=whole), **settings)

    def stop(done: int, *_: object) -> None:
        if done == at:
            raise KilledError

    with pytest.raises(KilledError):
        generate(
            "gbn", n=n, seed=1, realizations=6, monitor=Monitor(stop, Trace((5, 20)), kept, 0), **settings
        )
    resumed = Trace(keep_at=(5, 20))
    counts: list[int] = []
    monitor = Monitor(lambda done, *_: counts.append(done), resumed, kept, 0)
    assert np.array_equal(generate("gbn", n=n, seed=1, realizations=6, monitor=monitor, **settings), expected)
    assert min(counts, default=at) >= at - 1
    assert resumed.to_frame().equals(whole.to_frame())
    assert np.array_equal(resumed.points(20), whole.points(20))


@pytest.mark.slow
@pytest.mark.parametrize("n", [600, 10_000])  # the larger has the state of its low band too
def test_a_process_killed_outright_goes_on_from_its_file(tmp_path, n):
    command = [
        sys.executable, "-m", "gbnbench", "generate", "gbn[gradients=100]", "-n", str(n), "--realizations",
        "2", "--checkpoint", "state.npz", "--quiet", "-o",
    ]  # fmt: skip
    environment = {**os.environ, "GBNBENCH_CHECKPOINT_SECONDS": "0"}
    child = subprocess.Popen([*command, "a.npy"], cwd=tmp_path, env=environment)
    state = tmp_path / "state.npz"
    while not state.exists():
        assert child.poll() is None
        time.sleep(0.01)
    child.send_signal(signal.SIGKILL)
    child.wait()
    assert not (tmp_path / "a.npy").exists()
    began = int(np.load(state)["gradients"])
    subprocess.run([*command, "b.npy"], cwd=tmp_path, env=environment, check=True)
    assert 0 < began < 100
    assert not state.exists()
    fresh = generate("gbn[gradients=100]", n=n, realizations=2)
    assert np.array_equal(np.load(tmp_path / "b.npy"), fresh)


@pytest.mark.parametrize("content", [b"", b"nothing", None])
def test_foreign_checkpoints_are_refused_and_kept(tmp_path, content):
    kept = tmp_path / "state.npz"
    if content is None:
        np.savez(kept, x=np.zeros(3))
    else:
        kept.write_bytes(content)
    before = kept.read_bytes()
    with pytest.raises(InputError, match=r"state\.npz is no checkpoint"):
        generate("gbn", n=20, monitor=Monitor(checkpoint=kept))
    assert kept.read_bytes() == before


def test_checkpoints_of_other_runs_are_refused(tmp_path):
    kept = Path(tmp_path / "state.npz")
    generate("gbn[gradients=5]", n=20, monitor=Monitor(checkpoint=kept))
    for other in ({"n": 21}, {"n": 20, "seed": 1}, {"n": 20, "sigma": 0.9}, {"n": 20, "realizations": 2}):
        with pytest.raises(InputError, match="of another run"):
            generate("gbn[gradients=5]", monitor=Monitor(checkpoint=kept), **other)


def test_generators_without_an_optimiser_say_so(tmp_path):
    with pytest.raises(InputError, match="jittered has no checkpoint"):
        generate("jittered", n=16, monitor=Monitor(checkpoint=tmp_path / "x"))
    for name in ("jittered", "stealthy"):
        with pytest.raises(InputError, match=f"{name} has no trace"):
            generate(name, n=16, monitor=Monitor(trace=Trace()))


def test_a_trace_tells_the_energy_that_the_points_have():
    trace = Trace(keep_at=(10, 30))
    x = generate("gbn[iterations=30]", n=256, seed=2, realizations=2, monitor=Monitor(trace=trace))
    frame = trace.to_frame()
    assert list(frame.groupby("set").size()) == [30, 30]
    assert np.array_equal(trace.points(30), x)
    after_ten = energy_evaluation(256, 2, 1.0)(
        trace.points(10)
    )  # the eleventh gradient is taken where ten led
    told = frame[frame.gradient == 11]
    assert told.excess.to_numpy() == pytest.approx(after_ten.excess, rel=1e-9)
    x10 = trace.points(10)
    u = np.abs(x10[:, :, None] - x10[:, None])
    u = np.minimum(u, 1 - u) * 16
    pairs = np.exp(-(u**2).sum(-1) / 2).sum(axis=(1, 2)) - 256  # 16 sigmas a side: images add 1e-14
    assert told.energy.to_numpy() == pytest.approx(pairs / 2 / 256, rel=1e-9)
    longest = np.sqrt((after_ten.gradient**2).sum(-1).max(-1))
    assert told.largest.to_numpy() == pytest.approx(longest, rel=1e-6)


def test_a_set_that_is_done_waits_for_the_others():
    alone = generate("gbn[excess=3e-3]", n=128, seed=5, realizations=4)
    at = energy_evaluation(128, 2, 1.0)(alone)
    assert (at.excess <= 3e-3).all()
    assert (at.excess > 1e-3).all()


def test_the_step_is_halved_while_the_energy_rises():
    """Ten times the largest stable step: the energy rises until the step has come down."""
    x = np.random.default_rng(0).random((1, 256, 2))
    method = optimiser.Nesterov(energy_evaluation(256, 2, 1.0), x, 10 * step_sizes.step_size(256, 2, 1.0))
    for _ in range(400):
        method.advance()
    assert method.size[0] < 5 * step_sizes.step_size(256, 2, 1.0)
    assert method.excess[0] < 1e-3


def test_each_set_gets_its_own_band_back():
    """A set that is finished at its first gradient has no band to restore; the others keep theirs."""
    x = np.random.default_rng(0).random((2, 2100, 2))
    energy = energy_evaluation(2100, 2, 1.0)
    enough = float(energy(x).excess.min()) * (1 + 1e-9)
    step = step_sizes.step_size(2100, 2, 1.0)
    one, other = (
        optimiser.Nesterov(
            energy_evaluation(2100, 2, 1.0), x, step, enough, curvature=step_sizes.gaussian_curvature(2, 1.0)
        )
        for _ in range(2)
    )
    one.advance()
    assert one.finished.sum() == 1
    other.restore(one.state())
    for a, b in zip(one._bands, other._bands, strict=True):
        assert (a.anchor is None) == (b.anchor is None)
    one.advance()
    other.advance()
    assert np.array_equal(one.x, other.x)
