"""Caches where there is no home: none is named, it cannot be written, or the user has no name."""

from __future__ import annotations

import shutil
import subprocess
import tempfile
from pathlib import Path

import pytest

from gbnbench.core import cache_folder
from tests.processes import COMMAND, NOBODY, as_nobody, python

WHERE = (
    "import os\n"
    "from gbnbench.opencl.device import import_pyopencl\n"
    "from gbnbench.core.cache_folder import cache_folder\n"
    "import_pyopencl()\n"
    "import pyopencl.invoker\n"
    "print(cache_folder(), os.environ['POCL_CACHE_DIR'], os.environ['MPLCONFIGDIR'],"
    " pyopencl.invoker.invoker_cache.container_dir)"
)


@pytest.fixture
def open_folder(tmp_path: Path):
    """A folder that anyone may write, reached by a path that anyone may follow."""
    folder = Path(tempfile.mkdtemp())
    folder.chmod(0o777)
    yield folder
    shutil.rmtree(folder)


@pytest.mark.parametrize("home", [{}, pytest.param({"HOME": "/nonexistent/home"}, marks=pytest.mark.slow)])
def test_a_user_without_a_name_or_a_home_has_every_cache_in_one_temporary_folder(
    open_folder: Path, home: dict[str, str]
) -> None:
    done = as_nobody([*COMMAND[:1], "-c", WHERE], cwd=open_folder, TMPDIR=str(open_folder), **home)
    assert done.returncode == 0, done.stderr
    ours, *libraries = map(Path, done.stdout.split())
    assert ours == open_folder / f"gbnbench-cache-{NOBODY}"
    assert all(folder.is_relative_to(ours) for folder in libraries)
    assert [entry.name for entry in open_folder.iterdir()] == [ours.name]  # no folder called "~"


@pytest.mark.slow
def test_a_command_of_a_user_without_a_name_measures_and_draws(open_folder: Path) -> None:
    (open_folder / "x.txt").write_text("0.1 0.2\n0.6 0.7\n0.3 0.9\n0.8 0.4\n")
    done = as_nobody([*COMMAND, "spectrum", "x.txt", "-o", "x.png"], cwd=open_folder, TMPDIR=str(open_folder))
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    assert (open_folder / "x.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.slow
def test_worker_processes_of_a_user_without_a_name_share_the_cache(open_folder: Path) -> None:
    done = as_nobody(
        [*COMMAND, "compare", "random", "-n", "16", "--realizations", "2", "--jobs", "2", "-o", "run"],
        cwd=open_folder,
        TMPDIR=str(open_folder),
        HOME="/root",
    )
    assert done.returncode == 0, done.stderr
    assert {entry.name for entry in open_folder.iterdir()} == {"run", f"gbnbench-cache-{NOBODY}"}


def test_a_temporary_folder_that_cannot_be_written_gives_way_to_the_systems(tmp_path: Path) -> None:
    blocked = tmp_path / "file"
    blocked.write_text("")
    places = dict.fromkeys(("GBNBENCH_CACHE", "XDG_CACHE_HOME", "TMPDIR"), str(blocked / "no"))
    done = python("from gbnbench.core.cache_folder import cache_folder\nprint(cache_folder())", **places)
    assert done.returncode == 0, done.stderr
    assert not done.stdout.startswith(str(tmp_path))


def test_a_folder_on_a_full_disk_is_not_writable(tmp_path, monkeypatch) -> None:
    full = Path("/dev/full")
    if not full.exists():
        pytest.skip("there is no /dev/full here")

    def on_a_full_disk(**_: object):
        return full.open("wb")

    monkeypatch.setattr(cache_folder.tempfile, "TemporaryFile", on_a_full_disk)
    assert not cache_folder.is_writable(tmp_path)


def test_an_unusable_temporary_folder_of_someone_else_is_left_alone(tmp_path, monkeypatch) -> None:
    import os

    if not hasattr(os, "getuid"):
        pytest.skip("this system has no user ids")
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    (tmp_path / f"gbnbench-cache-{os.getuid()}").symlink_to(elsewhere)
    monkeypatch.setattr(cache_folder.tempfile, "gettempdir", lambda: str(tmp_path))
    monkeypatch.setattr(cache_folder.tempfile, "tempdir", str(tmp_path))
    monkeypatch.setenv("GBNBENCH_CACHE", "")
    found = cache_folder._temporary_folder()
    assert found.parent == tmp_path
    assert not found.is_symlink()
    assert os.environ["GBNBENCH_CACHE"] == str(found)
    shutil.rmtree(found)


@pytest.mark.parametrize("command", [["generate", "gbn", "-n", "16", "-o", "y.txt"], ["spectrum", "x.txt"]])
def test_a_limit_on_the_size_of_files_is_named_before_a_compiler_dies_of_it(
    tmp_path: Path, command: list[str]
) -> None:
    """Nor does numpy do it, whose last digits are others than those of a worker that had room."""
    resource = pytest.importorskip("resource")

    def restrict() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (10_000, resource.RLIM_INFINITY))

    (tmp_path / "x.txt").write_text("0.1 0.2\n0.6 0.7\n0.3 0.9\n0.8 0.4\n")
    done = subprocess.run(
        [*COMMAND, *command],
        cwd=tmp_path, capture_output=True, text=True, preexec_fn=restrict, check=False,
    )  # fmt: skip
    assert done.returncode == 2
    assert "no folder takes the files of compiled kernels" in done.stderr
    assert "ulimit -f" in done.stderr
    assert done.stderr.count("\n") == 1
