"""Comparisons by a real Dask scheduler, whose workers are killed, lack a device or have another version."""

from __future__ import annotations

import signal
import subprocess
import time
from pathlib import Path

import numpy as np
import pytest

from gbnbench.execution.executors.dask_scheduler import DaskScheduler
from tests.execution.cluster_processes import ASKED, cluster, ended, finished_pieces, spread, sums, until
from tests.processes import COMMAND, NO_DEVICE

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def alone(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The comparison by one process on this machine."""
    out = tmp_path_factory.mktemp("alone") / "run"
    subprocess.run([*COMMAND, *ASKED, "--out", str(out), "--jobs", "1"], check=True, capture_output=True)
    return out


def test_a_worker_that_is_killed_costs_nothing_but_time(alone: Path, tmp_path: Path) -> None:
    out = tmp_path / "run"
    with cluster(tmp_path / "dask") as workers:
        victim, _ = workers.several(2)
        process = spread(workers.address, out)
        until(lambda: finished_pieces(out) >= 3)
        workers.lose(victim)
        code, said = ended(process)
    assert code == 0, said
    assert sums(out) == sums(alone)


def test_all_workers_killed_and_new_ones_go_on_where_they_were(alone: Path, tmp_path: Path) -> None:
    out = tmp_path / "run"
    with cluster(tmp_path / "dask") as workers:
        victims = workers.several(2)
        process = spread(workers.address, out)
        until(lambda: finished_pieces(out) >= 3)
        workers.lose(*victims)
        code, said = ended(process)
        assert code == 2, said
        assert "there has been no worker at the Dask scheduler" in said
        assert f"what is finished is kept in {out}" in said
        assert "Traceback" not in said
        kept = finished_pieces(out)
        assert kept >= 3
        workers.worker()
        code, said = ended(spread(workers.address, out))
    assert code == 0, said
    assert f"{kept} of 23 pieces reused" in said
    assert sums(out) == sums(alone)


def test_the_driver_killed_goes_on_where_it_was(alone: Path, tmp_path: Path) -> None:
    out = tmp_path / "run"
    with cluster(tmp_path / "dask") as workers:
        workers.worker()
        process = spread(workers.address, out)
        until(lambda: finished_pieces(out) >= 3)
        process.kill()
        process.communicate()
        kept = finished_pieces(out)
        code, said = ended(spread(workers.address, out))
    assert code == 0, said
    assert f"{kept} of 23 pieces reused" in said
    assert sums(out) == sums(alone)


def test_the_scheduler_killed_is_said_and_another_goes_on(alone: Path, tmp_path: Path) -> None:
    out = tmp_path / "run"
    with cluster(tmp_path / "dask") as workers:
        workers.worker()
        process = spread(workers.address, out)
        until(lambda: finished_pieces(out) >= 3)
        workers.scheduler.kill()
        code, said = ended(process)
    assert code == 2, said
    assert "the Dask scheduler at" in said
    assert "is gone" in said
    assert "the same command continues" in said
    assert "Traceback" not in said
    kept = finished_pieces(out)
    code, said = ended(spread("local", out, "--jobs", 2))
    assert code == 0, said
    assert f"{kept} of 23 pieces reused" in said
    assert sums(out) == sums(alone)


def test_a_worker_without_opencl_is_left_out_and_alone_is_refused(alone: Path, tmp_path: Path) -> None:
    out = tmp_path / "run"
    with cluster(tmp_path / "dask") as workers:
        workers.worker(**NO_DEVICE)
        process = spread(workers.address, out)
        code, said = ended(process)
        assert code == 2, said
        assert "no worker has an OpenCL device" in said
        workers.worker()
        code, said = ended(spread(workers.address, out))
    assert code == 0, said
    assert sums(out) == sums(alone)


def test_another_version_of_gbnbench_is_refused_in_words(tmp_path: Path) -> None:
    other = tmp_path / "other_version.py"
    other.write_text('import gbnbench\ngbnbench.__version__ = "0.0.9"\n')
    with cluster(tmp_path / "dask") as workers:
        workers.worker("--preload", other)
        code, said = ended(spread(workers.address, tmp_path / "run"))
    assert code == 2, said
    assert "has gbnbench 0.0.9, and this run is made by" in said
    assert "install the same version there" in said
    assert "Traceback" not in said
    assert not (tmp_path / "run").exists()


def test_a_worker_with_threads_that_comes_later_is_left_out(tmp_path: Path) -> None:
    out = tmp_path / "run"
    with cluster(tmp_path / "dask") as workers:
        first = workers.worker()
        process = spread(workers.address, out, asked=ASKED[:-1])  # not --quiet: it tells whom it leaves out
        until(lambda: finished_pieces(out) >= 1)
        first.send_signal(signal.SIGSTOP)  # so that there is work left for the other
        workers.worker("--nthreads", "2")
        time.sleep(2)  # the other is given what waits, and says that it cannot serve
        first.send_signal(signal.SIGCONT)
        code, said = ended(process)
    assert code == 0, said
    assert "left out: the Dask worker" in said
    assert "carries out 2 calls at once in one process" in said


def test_workers_with_threads_and_a_scheduler_that_is_not_there_are_refused(tmp_path: Path) -> None:
    with cluster(tmp_path / "dask") as workers:
        workers.worker("--nthreads", "2")
        code, said = ended(spread(workers.address, tmp_path / "run"))
        address = workers.address
    assert code == 2, said
    assert "carries out 2 calls at once in one process" in said
    code, said = ended(spread(address, tmp_path / "run"))
    assert code == 2, said
    assert "no Dask scheduler answers at" in said


def test_results_that_went_with_their_worker_are_given_up_without_a_word(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    with cluster(tmp_path / "dask") as started:
        victim = started.worker()
        workers = DaskScheduler(address=started.address).start(1)
        made = workers.submit(np.ones, 100_000_000)  # on its way for half a second
        until(lambda: "finished" in {state.status for state in list(workers._client.futures.values())})
        started.lose(victim)
        time.sleep(1.5)  # until it is missed, and waits for another worker
        workers.shutdown()
        assert not made.done()
    assert [record.message for record in caplog.records if record.exc_info] == []
