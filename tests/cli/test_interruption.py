"""The real command stopped, killed, out of disk: what survives, what is said, and that it goes on."""

from __future__ import annotations

import os
import resource
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from gbnbench.runs.comparison_folder import read_run
from gbnbench.runs.resumable_folder import explain_interruption
from gbnbench.runs.sources import resolve
from gbnbench.studies.comparison import run_comparison
from tests.processes import COMMAND, command


@pytest.mark.slow
def test_killed_in_the_middle_it_resumes_to_the_same_bits(tmp_path: Path) -> None:
    arguments = ["compare", "lloyd", "-n", 144, "--realizations", 6, "--out", "run", "--quiet"]
    out = tmp_path / "run"
    busy = subprocess.Popen([*COMMAND, *map(str, arguments), "--jobs", "1"], cwd=tmp_path, text=True)
    wait_for(lambda: len(list(out.glob("parts/*/[0-9]*.npz"))) >= 2, busy)
    busy.kill()
    assert busy.wait() == -signal.SIGKILL
    kept = {path: path.stat().st_mtime_ns for path in out.glob("parts/*/[0-9]*.npz")}
    assert kept
    assert not (out / "manifest.json").exists()
    assert "unfinished run" in command("report", out, cwd=tmp_path).stderr
    resumed = command(*arguments, cwd=tmp_path)
    assert resumed.returncode == 0, resumed.stderr
    assert f"{len(kept)} of 7 pieces reused" in resumed.stdout
    sources, _ = resolve(["lloyd"], (144,), (2,), 6)
    straight = run_comparison(sources, tmp_path / "straight", jobs=1).run.sources[0]
    after = read_run(out).sources[0]
    assert after.points.tobytes() == straight.points.tobytes()
    assert after.spectrum.power.tobytes() == straight.spectrum.power.tobytes()
    assert repr(dict(after.measures)) == repr(dict(straight.measures))


@pytest.mark.slow
def test_ctrl_c_stops_at_once_and_says_how_to_go_on(tmp_path: Path) -> None:
    slow = ["compare", "lloyd", "-n", "4096", "--realizations", "40", "--out", "run"]
    busy = subprocess.Popen(
        [*COMMAND, *slow], cwd=tmp_path, stderr=subprocess.PIPE, text=True, start_new_session=True
    )
    wait_for(lambda: (tmp_path / "run" / "settings.json").exists(), busy)
    time.sleep(0.5)
    os.killpg(busy.pid, signal.SIGINT)  # as the terminal does: to every process
    _, said = busy.communicate(timeout=30)
    assert busy.returncode == 130
    assert said.splitlines()[-1] == (
        "gbnbench: stopped; what is finished is kept in run; the same command continues from there"
    )
    assert "Traceback" not in said
    with pytest.raises(ProcessLookupError):  # no worker is left in its session
        os.killpg(busy.pid, 0)


def test_an_interruption_within_a_string_of_code_still_ends_with_130(tmp_path: Path) -> None:
    # python notes such a one and would kill its own process at the end, although it was caught
    program = (
        "from gbnbench import cli\n"
        "@cli.gbnbench.command('stop')\n"
        "def stop():\n"
        "    exec('raise KeyboardInterrupt')\n"
        "cli.main(['stop'])\n"
    )
    (tmp_path / "interrupted.py").write_text(program)
    ended = subprocess.run(
        [sys.executable, "-m", "interrupted"], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert ended.stderr == "gbnbench: stopped\n"
    assert ended.returncode == 130


def test_an_interruption_that_a_library_made_an_import_error_is_one_still(tmp_path: Path) -> None:
    def load() -> None:
        try:
            raise KeyboardInterrupt
        except KeyboardInterrupt as stop:
            raise ImportError("initialization failed") from stop

    with pytest.raises(KeyboardInterrupt, match="kept in"), explain_interruption(tmp_path):
        load()
    with pytest.raises(ImportError, match="no such"), explain_interruption(tmp_path):
        raise ImportError("no such library")


@pytest.mark.slow
def test_a_full_disk_is_one_line_and_loses_nothing(tmp_path: Path) -> None:
    sizes = ["-n", "1024,200000", "--realizations", "2", "--jobs", "1"]

    def small_files() -> None:  # room for OpenCL's own cache and for 1,024 points, not for 200,000
        resource.setrlimit(resource.RLIMIT_FSIZE, (2_000_000, resource.RLIM_INFINITY))

    full = command(
        "compare", "random", *sizes, "--out", "run", "--quiet", cwd=tmp_path, preexec_fn=small_files
    )
    assert full.returncode == 2
    assert full.stderr == (
        "gbnbench: error: run/parts/random_n200000_d2/000000.npz: File too large; what is finished is kept "
        "and the same command continues from there\n"
    )
    left = {path.relative_to(tmp_path).as_posix() for path in tmp_path.rglob("*") if path.is_file()}
    assert left == {
        "run/.lock",
        "run/settings.json",
        "run/parts/random_n1024_d2/000000.npz",
        "run/parts/random_n1024_d2/000001.npz",
    }


@pytest.mark.slow
@pytest.mark.parametrize("kills", [1, 2])
def test_a_crashed_worker_costs_a_try_and_after_two_is_named_and_the_rest_kept(
    tmp_path: Path, kills: int
) -> None:
    arguments = ["compare", "lloyd", "-n", "400", "--realizations", "3", "--jobs", "1", "--out", "run"]
    busy = subprocess.Popen([*COMMAND, *arguments], cwd=tmp_path, stderr=subprocess.PIPE, text=True)
    for kept in ("000000.npz", "000002.npz")[:kills]:  # what was lost is tried again after all others
        wait_for(lambda kept=kept: list((tmp_path / "run").rglob(kept)), busy)
        children = Path(f"/proc/{busy.pid}/task").glob("*/children")
        (worker,) = (int(pid) for path in children for pid in path.read_text().split())
        os.kill(worker, signal.SIGKILL)
    _, said = busy.communicate()
    if kills == 1:
        assert busy.returncode == 0, said
        assert (tmp_path / "run" / "manifest.json").exists()
        return
    assert busy.returncode == 2
    assert "lloyd (n=400, d=2), realization 1: its process was killed by SIGKILL" in said
    assert {path.name for path in (tmp_path / "run").rglob("0*.npz")} == {"000000.npz", "000002.npz"}
    assert not (tmp_path / "run" / "manifest.json").exists()


def wait_for(condition: Callable[[], object], process: subprocess.Popen[str]) -> None:
    deadline = time.monotonic() + 60
    while not condition():
        assert process.poll() is None, "the command ended early"
        assert time.monotonic() < deadline
        time.sleep(0.005)
