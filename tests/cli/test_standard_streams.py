"""Commands whose standard streams are closed, full, broken, in few signs, or on a plain terminal."""

from __future__ import annotations

import codecs
import io
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from gbnbench.cli import standard_streams
from tests.processes import COMMAND

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="descriptors are redirected by a shell")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "x.txt").write_text("0.1 0.2\n0.6 0.7\n0.3 0.9\n0.8 0.4\n")
    return tmp_path


def shell(text: str, folder: Path, **environment: str) -> subprocess.CompletedProcess[str]:
    """Run a line of bash in which $G is gbnbench, with the exit code of its first command."""
    return subprocess.run(
        ["bash", "-c", f"{text}\nexit ${{PIPESTATUS[0]}}"],
        cwd=folder,
        env={**os.environ, "G": " ".join(COMMAND), **environment},
        capture_output=True,
        text=True,
        errors="surrogateescape",
        check=False,
    )


@pytest.mark.parametrize(
    ("redirection", "why"),
    [
        (">/dev/full", "No space left on device"),
        pytest.param(">&-", "it is closed", marks=pytest.mark.slow),
        pytest.param(">&- <&-", "it is closed", marks=pytest.mark.slow),
    ],
)
def test_output_that_cannot_be_written_is_said_and_files_are_kept(folder: Path, redirection: str, why: str):
    done = shell(f"$G generate 'gbn[iterations=10]' -n 16 -o y.txt --trace t.csv {redirection}", folder)
    assert done.returncode == 2
    assert done.stderr.endswith(  # after progress, on a slow machine
        f"gbnbench: error: standard output cannot be written ({why}): what was printed is lost, files and "
        "folders are kept\n"
    )
    assert (folder / "y.txt").exists()
    assert (folder / "t.csv").exists()  # which is written after the first line was printed


@pytest.mark.slow
def test_a_closed_error_output_takes_no_descriptor_of_a_file(folder: Path):
    done = shell("$G analyze x.txt 2>&-", folder)
    assert done.returncode == 0
    assert "x.txt" in done.stdout
    assert shell("$G analyze none.txt 2>&-", folder).returncode == 2
    assert shell("$G analyze none.txt 2>/dev/full", folder).returncode == 2
    assert shell("$G analyze x.txt >&- 2>&- <&-", folder).returncode == 2
    assert (folder / "x.txt").read_text().startswith("0.1 0.2\n0.6")


@pytest.mark.slow
def test_a_run_with_all_streams_closed_is_finished_and_read_by_the_next(folder: Path):
    line = "$G compare random -n 16 --realizations 2 --jobs 2 -o run"
    assert shell(f"{line} >&- 2>&- <&-", folder).returncode == 2
    assert (folder / "run" / "report.html").exists()
    again = shell(f"{line} | head -1", folder)
    assert again.returncode in (0, 141)  # the reader may be gone before the last line, or not
    assert "Traceback" not in again.stderr


@pytest.mark.slow
def test_a_reader_that_goes_away_stops_the_command_quietly(folder: Path):
    done = shell("$G analyze x.txt x.txt | sleep 0", folder)
    assert done.returncode == 141
    assert done.stderr == ""


@pytest.mark.parametrize("encoding", ["ascii", "iso-8859-1", "cp1252", "utf-16", "shift_jis"])
def test_any_encoding_prints_what_it_can(encoding: str):
    output = io.BytesIO()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(standard_streams.OutputFile, "write", lambda _, data: output.write(data))
        with Path(os.devnull).open("w") as null:
            codecs.register_error(standard_streams.ERRORS, standard_streams._spelt)
            before = io.TextIOWrapper(io.BytesIO(), encoding)
            text = standard_streams._text(
                standard_streams.OutputFile(null.fileno()), before, standard_streams.ERRORS
            )
            text.write("a – b ± c, ▲ é 点 caf\udce9\n")
            text.flush()
    written = output.getvalue().decode(encoding, "surrogateescape")
    assert written.startswith("a ")
    assert written.endswith("\n")
    if encoding == "ascii":
        assert written == "a - b +/- c, ^ e ? caf\udce9\n"
    if encoding == "iso-8859-1":
        assert written == "a - b ± c, ^ é ? café\n"


@pytest.mark.slow
def test_any_encoding_prints_a_table(folder: Path):
    for encoding in ("ascii", "iso-8859-1", "utf-16"):
        done = shell("$G analyze x.txt && $G integrate --list", folder, PYTHONIOENCODING=encoding)
        assert done.returncode == 0, done.stderr
        assert "x.txt" in done.stdout.replace("\0", "")


@pytest.mark.slow
def test_json_is_valid_in_any_encoding(folder: Path):
    odd = os.fsdecode("caf\N{LATIN SMALL LETTER E WITH ACUTE} \N{CJK UNIFIED IDEOGRAPH-70B9}".encode())
    (folder / "x.txt").rename(folder / f"{odd}.txt")
    for encoding in ("ascii", "utf-8", "iso-8859-1"):
        done = shell("$G spectrum --json *.txt", folder, PYTHONIOENCODING=encoding)
        assert done.returncode == 0, done.stderr
        assert json.loads(done.stdout)[0]["label"] == f"{odd}.txt"


@pytest.mark.parametrize(
    "columns",
    ["1", *(pytest.param(width, marks=pytest.mark.slow) for width in ("0", "7", "-3", "many", "100000"))],
)
def test_any_width_of_the_terminal_will_do(folder: Path, columns: str):
    done = shell("$G --help && $G compare --help", folder, COLUMNS=columns)
    assert done.returncode == 0, done.stderr


def on_a_terminal(folder: Path, *arguments: str, **environment: str) -> bytes:
    """Run gbnbench on a terminal of its own; return what it wrote there."""
    import pty

    ours, theirs = pty.openpty()
    child = subprocess.Popen(
        [*COMMAND, *arguments], stdout=theirs, stderr=theirs, cwd=folder, env={**os.environ, **environment}
    )
    os.close(theirs)
    written = b""
    while True:
        try:
            part = os.read(ours, 4096)
        except OSError:  # Linux's way of saying that nobody holds the other end
            part = b""
        if not part:
            break
        written += part
    os.close(ours)
    assert child.wait() == 0
    return written


@pytest.mark.slow
def test_a_dumb_terminal_and_no_color_get_plain_text(folder: Path):
    arguments = ("compare", "random", "jittered", "-n", "16", "--realizations", "2", "-o", "run")
    written = on_a_terminal(folder, *arguments, TERM="dumb")
    assert b"\x1b" not in written
    assert b"report: run" in written
    assert b"\x1b[1m" in on_a_terminal(folder, *arguments, TERM="xterm")
    table = on_a_terminal(folder, *arguments, "--quiet", TERM="xterm", NO_COLOR="1")
    assert b"\x1b" not in table
