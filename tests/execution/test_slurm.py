"""Comparisons by a real Slurm, whose jobs are cancelled, never started or refused, and whose driver ends."""

from __future__ import annotations

import contextlib
import shlex
import signal
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.execution.cluster_processes import ASKED, ended, finished_pieces, sums, until
from tests.execution.slurm_cluster import HERE, REASON, Slurm, slurm
from tests.processes import COMMAND

pytestmark = [pytest.mark.slow, pytest.mark.skipif(not HERE, reason=REASON)]


@pytest.fixture(scope="module")
def cluster() -> Iterator[Slurm]:
    """A Slurm of one node; the tests are skipped where its daemons cannot run, as in some containers."""
    with contextlib.ExitStack() as stack:
        try:
            made = stack.enter_context(slurm())
        except TimeoutError as error:
            pytest.skip(f"Slurm's daemons do not come up here: {error}")
        yield made


@pytest.fixture(scope="module")
def alone(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """Checksums of the comparison by one process on this machine."""
    out = tmp_path_factory.mktemp("alone") / "run"
    subprocess.run([*COMMAND, *ASKED, "--out", str(out), "--jobs", "1"], check=True, capture_output=True)
    return sums(out)


def running(process: subprocess.Popen[str]) -> bool:
    """Say that a process runs: one that has ended fails the test with what it said."""
    assert process.poll() is None, process.communicate()
    return True


def test_a_job_out_of_time_and_one_cancelled_cost_nothing_but_time(
    cluster: Slurm, alone: dict[str, str], tmp_path: Path
) -> None:
    out = tmp_path / "run"
    process = cluster.begin(out, ASKED)
    at_work = until(lambda: running(process) and finished_pieces(out) >= 1 and cluster.jobs("RUNNING"))
    cluster.said("scancel", "--signal", "USR2", at_work[0])
    at_work = until(lambda: running(process) and finished_pieces(out) >= 6 and cluster.jobs("RUNNING"))
    cluster.said("scancel", at_work[-1])
    code, said = ended(process)
    assert code == 0, said
    assert "submitit" not in said  # it warns where there is no accounting
    assert sums(out) == alone
    assert cluster.jobs() == []
    assert [path.name for path in (tmp_path / "jobs").glob("*/*.lock")] == []


def test_the_driver_killed_leaves_jobs_that_the_next_takes_away(
    cluster: Slurm, alone: dict[str, str], tmp_path: Path
) -> None:
    out = tmp_path / "run"
    process = cluster.begin(out, ASKED)
    until(lambda: running(process) and finished_pieces(out) >= 3 and cluster.suspended())
    process.kill()
    process.communicate()
    left, kept = cluster.jobs(), finished_pieces(out)
    assert left  # at least the suspended one: any other may end in time by itself
    process = cluster.begin(out, ASKED)
    until(lambda: not set(left) & set(cluster.jobs()))
    until(lambda: running(process) and finished_pieces(out) > kept and cluster.jobs())
    process.send_signal(signal.SIGTERM)  # as Slurm does at the end of a job that is the driver
    code, said = ended(process)
    assert code == 130, said
    assert cluster.jobs() == []
    kept = finished_pieces(out)
    code, said = ended(cluster.begin(out, ASKED))
    assert code == 0, said
    assert f"{kept} of 23 pieces reused" in said
    assert sums(out) == alone
    assert not (tmp_path / "jobs").exists()


def test_the_driver_may_be_a_job_whose_memory_is_counted_otherwise(cluster: Slurm, tmp_path: Path) -> None:
    """Slurm refuses a job that inherits memory for each processor and asks for it in all."""
    asked = ["generate", "jittered", "-n", "64", "--realizations", "8"]
    subprocess.run([*COMMAND, *asked, "--out", str(tmp_path / "one.npy")], check=True, capture_output=True)
    driver = shlex.join(cluster.command(tmp_path / "two.npy", asked))
    log = tmp_path / "driver.log"
    cluster.said("sbatch", "--wait", "--mem-per-cpu", "500", "--output", str(log), "--wrap", driver)
    assert (tmp_path / "two.npy").read_bytes() == (tmp_path / "one.npy").read_bytes(), log.read_text()


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"partition": "none"}, "a job cannot be sent: sbatch: error: invalid partition specified: none; "),
        ({"mem_gb": 100}, "Requested node configuration is not available"),
        (
            {"timeout_min": 600},
            "none of the jobs is started: the reason that Slurm gives is PartitionTimeLimit",
        ),
    ],
)
def test_jobs_that_are_refused_or_never_start_are_said(
    cluster: Slurm, tmp_path: Path, settings: dict[str, object], words: str
) -> None:
    code, said = ended(cluster.begin(tmp_path / "run", ASKED, wait_seconds=1, **settings))
    assert code == 2, said
    assert words in said
    assert "Traceback" not in said
    assert cluster.jobs() == []
    assert not (tmp_path / "jobs").exists()
