"""Sets and stipplings by a real Dask scheduler: the files of one process, also after kill -9."""

from __future__ import annotations

import subprocess
from pathlib import Path

import numpy as np
import pytest
from PIL import Image as Pillow

from tests.execution.cluster_processes import cluster, ended, spread, until
from tests.processes import COMMAND

pytestmark = pytest.mark.slow

SETS = ["generate", "gbn[gradients=300]", "-n", "128", "--realizations", "700", "--seed", "4", "--quiet"]
DOTS = ["stipple", "-n", "1500", "--method", "gbn[gradients=150]", "--format", "txt", "--quiet"]


@pytest.fixture(scope="module")
def alone(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """The file of sets that one process writes, all sets together."""
    out = tmp_path_factory.mktemp("alone") / "x.npy"
    subprocess.run([*COMMAND, *SETS, "--out", str(out)], check=True, capture_output=True)
    return out.read_bytes()


def kept(out: Path) -> int:
    """Count the pieces of a file of sets that is not whole yet."""
    return len(list(out.with_name(f"{out.name}.pieces").rglob("*.npz")))


@pytest.mark.parametrize("count", [1, 2])
def test_sets_by_workers_are_those_of_one_process(alone: bytes, tmp_path: Path, count: int) -> None:
    out = tmp_path / "x.npy"
    with cluster(tmp_path / "dask") as workers:
        workers.several(count)
        code, said = ended(spread(workers.address, out, asked=SETS))
    assert code == 0, said
    assert out.read_bytes() == alone
    assert not out.with_name("x.npy.pieces").exists()


def test_sets_whose_driver_and_a_worker_are_killed_go_on(alone: bytes, tmp_path: Path) -> None:
    out = tmp_path / "x.npy"
    with cluster(tmp_path / "dask") as workers:
        victim, _ = workers.several(2)
        process = spread(workers.address, out, asked=SETS)
        until(lambda: kept(out) >= 3)
        process.kill()
        process.communicate()
        assert not out.exists()
        there = kept(out)
        process = spread(workers.address, out, asked=SETS)
        until(lambda: kept(out) >= there + 3)
        workers.lose(victim)
        code, said = ended(process)
    assert code == 0, said
    assert f"{there} of 70 pieces reused" in said
    assert out.read_bytes() == alone


def test_stipplings_whose_driver_is_killed_go_on_and_a_bad_image_costs_itself(tmp_path: Path) -> None:
    rng = np.random.default_rng(3)
    images = []
    for k in range(12):
        images.append(str(tmp_path / f"im{k:02d}.png"))
        Pillow.fromarray(rng.integers(0, 200, (80, 90), np.uint8)).save(images[-1])
    (tmp_path / "im03.png").write_text("no image")
    for each in images[4:6]:
        subprocess.run([*COMMAND, *DOTS[:-3], "--quiet", each, "--out", f"{each}.txt"], check=True)
    out = tmp_path / "dots"
    asked = [*DOTS, *images]
    with cluster(tmp_path / "dask") as workers:
        workers.several(2)
        process = spread(workers.address, out, asked=asked)
        until(lambda: out.is_dir() and len(list(out.glob("*.txt"))) >= 3)
        process.kill()
        process.communicate()
        code, said = ended(spread(workers.address, out, asked=asked))
    assert code == 2, said
    assert said.count("kept ") >= 2
    assert said.count("kept ") + said.count("wrote ") == 11
    assert "1 of 12 images could not be drawn" in said
    assert "im03.png: is no image" in said
    assert "Traceback" not in said
    for each in images[4:6]:
        drawn = out / f"{Path(each).stem}.txt"
        assert drawn.read_bytes() == Path(f"{each}.txt").read_bytes()
