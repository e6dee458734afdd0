"""Large sets on the command line: the same numbers in parts, what is said before, and what Ctrl-C leaves."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import gbnbench
from gbnbench.analysis import piece_measures
from gbnbench.analysis.spatial import distances, slabs
from gbnbench.cli import run

X = np.random.default_rng(51).random((3000, 2))


@pytest.fixture
def small(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Take sets of more than ten points for large ones, beside one in x.npy."""
    for module in (distances, piece_measures, slabs):
        monkeypatch.setattr(module, "WHOLE", 10)
    monkeypatch.setattr(slabs, "SLAB_POINTS", 700)
    monkeypatch.chdir(tmp_path)
    np.save("x.npy", X)


@pytest.mark.usefixtures("small")
def test_a_large_set_has_the_measures_of_the_whole(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["analyze", "x.npy", "--json"]) == 0
    out, err = capsys.readouterr()
    found = json.loads(out)[0]["measures"]
    slabs.WHOLE = piece_measures.WHOLE = distances.WHOLE = 1 << 20
    for name, value in gbnbench.measures(X).items():
        assert found[name] == pytest.approx(value, rel=1e-11), name
    assert re.match(r"gbnbench: x\.npy: about 0\.\d+ GB of memory at most, spectrum to nu = 2", err)
    assert re.search(r"^\d+/100 neighbours|^\d+/100 ", err, re.MULTILINE)


@pytest.mark.usefixtures("small")
def test_the_plan_says_memory_stages_and_what_is_left_out(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("gbnbench.analysis.radial.psa.MOST_POINTS", 100)
    monkeypatch.setattr("gbnbench.analysis.spatial.discrepancy.MOST_PLANE_POINTS", 100)
    assert run(["analyze", "x.npy", "--explain", "--fmax", "20"]) == 0
    out = capsys.readouterr().out
    assert "|f_a| <= 20" in out
    assert re.search(r"measures: 0\.\d+ GB of memory at most, of it 4\.8e-05 GB the points", out)
    for stage in ("spectrum", "distances", "neighbours"):
        assert f"    {stage}: " in out
    assert "discrepancies: " not in out
    assert "no effective_nyquist: PSA's" in out
    assert "no discrepancy_wd: a discrepancy in the plane" in out
    assert run(["analyze", "x.npy", "--quiet", "--json"]) == 0
    done = capsys.readouterr()
    assert done.err == ""
    assert json.loads(done.out)[0]["reasons"]["discrepancy_star"].startswith("a discrepancy in the plane")


@pytest.mark.usefixtures("small")
def test_what_cannot_be_held_is_refused_before_the_work(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("gbnbench.core.memory.memory_limit", lambda: 10**8)
    monkeypatch.setattr("gbnbench.analysis.measures.measure_piece", None)
    assert run(["analyze", "x.npy", "--fmax", "100"]) == 2
    err = capsys.readouterr().err
    assert "the measures of n=3000 points in d=2 take about " in err
    assert err.rstrip().endswith("this machine has 0.1; ask for a smaller --fmax")


@pytest.mark.usefixtures("small")
def test_stopping_leaves_what_was_measured(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:

    expected = gbnbench.measures(X)["mean_distance"]
    whole = piece_measures.plane_order

    def one_slab(x, sides, progress):
        def tell(share: float) -> None:
            if share > 0:
                os.kill(os.getpid(), signal.SIGINT)
            progress(share)

        return whole(x, sides, tell)

    monkeypatch.setattr(piece_measures, "plane_order", one_slab)
    assert run(["analyze", "x.npy", "--json"]) == 130
    out, err = capsys.readouterr()
    (found,) = json.loads(out)
    assert found["measures"]["mean_distance"] == pytest.approx(expected)
    for name in ("psi6", "bond_order", "valence6", "discrepancy_wd"):
        assert found["measures"][name] is None
        assert found["reasons"][name] == "stopped before it was measured"
    assert err.rstrip().endswith("gbnbench: stopped; what was measured before is printed")


def test_g_of_r_as_far_as_was_asked_for(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    np.save("two.npy", np.stack([X, X[::-1]]))
    assert run(["analyze", "two.npy", "--rdf", "g.csv", "--range", "4", "--bins", "50"]) == 0
    said = "wrote g.csv: 50 bins of 0.08 densest spacings, up to 4; r is where a bin begins\n"
    assert capsys.readouterr().out == said
    r, g = np.loadtxt("g.csv", delimiter=",", skiprows=1).T
    from gbnbench.analysis.spatial.rdf import rdf

    np.testing.assert_allclose(g, rdf(X, reach=4, bins=50).g, rtol=1e-12)
    np.testing.assert_allclose(r, np.arange(50) * 0.08, rtol=1e-12)
    assert run(["analyze", "two.npy", "--rdf", "g.csv", "--range", "4", "--bins", "1"]) == 0
    said = "wrote g.csv: 1 bin of 4 densest spacings, up to 4; r is where a bin begins\n"
    assert capsys.readouterr().out == said


def test_g_of_r_is_not_written_over_the_points(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    np.savetxt("x.csv", X[:50], delimiter=",")
    before = Path("x.csv").read_bytes()
    assert run(["analyze", "x.csv", "--rdf", "./x.csv"]) == 2
    assert "x.csv is read here, and writing would replace it" in capsys.readouterr().err
    assert Path("x.csv").read_bytes() == before


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["x.npy", "--range", "3"], "give --rdf FILE.csv too"),
        (["x.npy", "x.npy", "--rdf", "g.csv"], "--rdf is of the sets in one file; got 2 files"),
        (["x.npy", "--rdf", "g.txt"], "--rdf writes a .csv; got g.txt"),
        (["x.npy", "--rdf", "none/g.csv"], "there is no folder none"),
        (["x.npy", "--rdf", "g.csv", "--json"], "--rdf goes with --range and --bins alone"),
        (["x.npy", "--window", "0,1,0,1", "--fmax", "3"], "--projections, --box and --fmax"),
    ],
)
@pytest.mark.usefixtures("small")
def test_options_that_do_not_go_together(
    arguments: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["analyze", *arguments]) == 2
    assert said in capsys.readouterr().err


@pytest.mark.usefixtures("small")
def test_bands_come_again(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["spectrum", "x.npy", "--band", "1,4", "--band", "30,31", "-o", "s.csv"]) == 0
    table = np.genfromtxt("s.csv", delimiter=",", names=True)
    expected = gbnbench.shells(X, band=[(1, 4), (30, 31)])
    np.testing.assert_array_equal(table["power"], expected.power)
    assert run(["spectrum", "x.npy", "--band", "1,4", "--band", "30,31"]) == 0
    assert "noise floor" not in capsys.readouterr().out
    assert run(["spectrum", "--explain", "-n", "100", "--band", "1,4", "--band", "7,8"]) == 0
    assert capsys.readouterr().out.count("shells: ") == 2


@pytest.mark.usefixtures("small")
def test_shells_far_out_are_few_rows(capsys: pytest.CaptureFixture[str]) -> None:
    far = ["spectrum", "x.npy", "--band", "2100,2100", "-o", "s.csv", "--quiet"]  # |f|^2 = 4,410,000
    assert run(far) == 0
    assert len(Path("s.csv").read_text().splitlines()) == 2
    assert capsys.readouterr().err == ""


PEAK = """
import re, sys
from pathlib import Path
from gbnbench.cli import run
code = run(sys.argv[1:])
status = Path("/proc/self/status").read_text()
print(1024 * int(re.search(r"VmHWM:\\s+(\\d+) kB", status)[1]), file=sys.stderr)
sys.exit(code)
"""


def peak_of(*arguments: str, cwd: Path, **variables: str) -> tuple[float, float]:
    """Bytes that the command says it takes at most, and those that it took.

    getrusage would count those that the process which started it had.
    """
    done = subprocess.run(
        [sys.executable, "-c", PEAK, *arguments],
        cwd=cwd,
        env=os.environ | variables,
        capture_output=True,
        text=True,
        check=True,
    )
    (stated,) = re.findall(r"([\d.]+) GB (?:of memory )?at most", done.stderr)
    return float(stated) * 1e9, float(done.stderr.splitlines()[-1])


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="memory is read from /proc")
@pytest.mark.parametrize(
    "arguments",
    [["analyze"], ["spectrum", "--band", "1,64", "--band", "900,901"], ["spectrum", "--fmax", "600"]],
    ids=["analyze", "shells", "cube"],
)
@pytest.mark.parametrize("d", [2, 3])
def test_the_memory_that_is_stated_is_held(tmp_path: Path, arguments: list[str], d: int) -> None:
    """Never more than was said, and not less than half of it, at a little over a million points.

    In three dimensions no kernel has been compiled before: the compiler's own memory is in what is said.
    """
    variables = {}
    if d == 3:
        variables = {"POCL_CACHE_DIR": str(tmp_path / "pocl"), "XDG_CACHE_HOME": str(tmp_path / "cache")}
        arguments = [{"900,901": "45,46", "1,64": "1,6", "600": "40"}.get(word, word) for word in arguments]
    np.save(tmp_path / "x.npy", np.random.default_rng(d).random((1_100_000, d)))
    stated, measured = peak_of(*arguments, "x.npy", cwd=tmp_path, **variables)
    assert measured <= stated <= 2 * measured
