"""``gbnbench convert``: the same points in every other format, boxes kept where they can be, else refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from gbnbench.cli import run
from gbnbench.io.points import read_sets, save
from gbnbench.io.points.writer import WRITTEN

X = np.random.default_rng(4).random((2, 6, 3))


@pytest.mark.parametrize("source", WRITTEN)
def test_between_all_formats(source: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    x = X[:1] if source == ".ply" else X
    there = tmp_path / f"in{source}"
    save(there, x)
    for target in WRITTEN:
        out = tmp_path / f"out{target}"
        code = run(["convert", str(there), "-o", str(out)])
        said = capsys.readouterr()
        if target == ".ply" and len(x) > 1:
            assert code == 2
            assert "a PLY file holds one set; got several, which .npz and .txt hold" in said.err
            continue
        assert code == 0, said.err
        assert said.out.startswith(f"wrote {out}: {len(x)} set{'s' * (len(x) > 1)} of 6 points, d=3")
        assert np.array_equal(np.stack(read_sets(out).sets), x)


def test_a_box_goes_along(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pixels = tmp_path / "pixels.csv"
    pixels.write_text("x,y,w\n128,64,9\n256,192,9\n")
    call = ["convert", str(pixels), "--columns", "x,y"]
    fractions = [[0.25, 0.25], [0.5, 0.75]]
    for name in ("a.npz", "a.edat", "a.dump", "a.json", "a.json.gz"):
        assert run([*call, "--period", "512,256", "-o", str(tmp_path / name)]) == 0
        assert "in their box of 512 x 256" in capsys.readouterr().out
        found = read_sets(tmp_path / name)
        assert found.sets[0].tolist() == fractions
        assert (found.sides, found.low, found.toroidal) == ((512.0, 256.0), (0.0, 0.0), True)
    assert run([*call, "--period", "512,256", "-o", str(tmp_path / "a.txt")]) == 2
    said = capsys.readouterr().err
    assert "a.txt: text cannot hold a box of unequal sides, 512 x 256; .npz, .lammpstrj, " in said
    assert "--fractions leaves the box out" in said
    assert run([*call, "--period", "512,256", "--fractions", "-o", str(tmp_path / "a.txt")]) == 0
    assert "as fractions of their box of 512 x 256" in capsys.readouterr().out
    assert read_sets(tmp_path / "a.txt").sets[0].tolist() == fractions
    assert run([*call, "--period", "512", "-o", str(tmp_path / "b.txt")]) == 0
    assert "as fractions of their box of 512 x 512" in capsys.readouterr().out


def test_what_does_not_go_together_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    one, two, flat = tmp_path / "one.edat", tmp_path / "two.edat", tmp_path / "flat.txt"
    one.write_text("0 0\n1 1\n1\n0.5 0.5\n")
    two.write_text("0 0\n2 2\n1\n0.5 0.5\n")
    save(flat, X[0])
    both = ["convert", str(one), str(two), "-o", str(tmp_path / "a.txt")]
    assert run(both) == 2
    assert f"{two}: its box is not that of {one}" in capsys.readouterr().err
    assert run([*both, "--fractions"]) == 0
    assert [x.tolist() for x in read_sets(tmp_path / "a.txt").sets] == [[[0.5, 0.5]], [[0.25, 0.25]]]
    assert run(["convert", str(one), str(flat), "-o", str(tmp_path / "b.txt")]) == 2
    assert f"{flat}: its points have d=3, those of {one} d=2" in capsys.readouterr().err
    assert run(["convert", str(flat), "-o", str(flat)]) == 2
    assert "is read here, and writing would replace it" in capsys.readouterr().err
    assert run(["convert", str(flat), "-o", str(tmp_path / "b.rps")]) == 2
    assert "got extension '.rps'" in capsys.readouterr().err
    assert run(["convert", str(tmp_path / "none.txt"), "-o", str(tmp_path / "b.txt")]) == 2
    assert "none.txt: cannot be read: no such file" in capsys.readouterr().err
