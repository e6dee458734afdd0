"""Stipplings side by side: what is measured is right, runs resume and do not depend on how work is split."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import pytest
from scipy.special import erf

import gbnbench
from gbnbench.api.stippled_page import text_of
from gbnbench.api.stipplings import compare_stipplings
from gbnbench.core.errors import FormatError, InputError, RefusalError
from gbnbench.generators.adaptive.density import Density, as_density
from gbnbench.generators.adaptive.registry import adaptive_points
from gbnbench.generators.adaptive.rejection import Rejection
from gbnbench.io.points import ReadingOptions, reading_options
from gbnbench.studies.stippling.units import unit_square
from gbnbench.studies.stippling_comparison.flat_patch import flattest_patch
from gbnbench.studies.stippling_comparison.measured_set import measured_set
from gbnbench.studies.stippling_comparison.points_of_image import sets_on_image
from gbnbench.studies.stippling_comparison.relative_variance import relative_variance
from gbnbench.studies.stippling_comparison.stippling_folder import read_stippling_run

RAMP = np.linspace(0.1, 0.9, 48)[:, None] * np.ones(40)
DENSITY = as_density(RAMP)
PLAIN = ReadingOptions()


@dataclass(frozen=True)
class Failing(Rejection):
    """Raises where a set of 100 points is drawn."""

    name: ClassVar[str] = "failing"
    summary: ClassVar[str] = "fails"

    def __call__(self, density: Density, n: int, rng: np.random.Generator, told=None):
        raise InputError("no set today")


@dataclass(frozen=True)
class Refusing(Rejection):
    """Refuses every density."""

    name: ClassVar[str] = "refusing"

    def refusal(self, density: Density, n: int) -> str | None:
        return "not this one"


def test_the_flattest_square_is_found():
    density = np.random.default_rng(1).random((60, 80))
    density[20:50, 30:60] = 0.5
    patch = flattest_patch(density, 400)
    assert patch is not None
    assert patch.variation == pytest.approx(0, abs=1e-5)
    assert (patch.of(density) == 0.5).all()
    assert patch.share == pytest.approx(patch.of(density).sum() / density.sum())
    assert patch.share * 400 >= 64 * (1 - 1e-9)


def test_a_flat_density_is_its_own_flattest_square():
    patch = flattest_patch(np.ones((48, 40)), 100)
    assert patch is not None
    assert (patch.side, patch.share) == (40, pytest.approx(40 / 48))
    assert flattest_patch(np.ones((48, 40)), 60) is None  # 64 points are to be in it


def test_relative_variance_is_that_of_sums_taken_one_by_one():
    density = as_density(np.ones((24, 24)))
    points = adaptive_points("rejection", density, 30, seed=1)
    s2 = 24 * 24 / 30 / 2  # of sigma = 1 at this density
    lines = np.meshgrid(np.arange(24), np.arange(24), indexing="ij")
    at = np.stack(lines, -1).reshape(-1, 1, 2) + 0.5
    found = np.exp(-((at - points) ** 2).sum(axis=2) / (2 * s2)).sum(axis=1) / (2 * np.pi * s2)
    edge = erf((np.arange(24) + 0.5) / np.sqrt(2 * s2)) + erf((23.5 - np.arange(24)) / np.sqrt(2 * s2))
    share = np.outer(edge, edge).ravel() / 4
    target = 30 / 24**2 * share
    wanted = ((found - target) ** 2 / target**2).mean()
    # T is also spread by a pixel's own square, of variance 1/12 beside 9.6; kernels' widths are a straight
    # line between two that are tried.
    assert relative_variance(points, density) == pytest.approx(wanted, rel=2e-3)


def test_measures_tell_blue_noise_from_chance():
    density = DENSITY
    patch = flattest_patch(RAMP, 300)
    gbn, white = (
        measured_set(adaptive_points(name, density, 300), density, patch, pictures=False)
        for name in ("gbn[gradients=40]", "rejection")
    )
    assert gbn["relative_variance"] < 0.05 * white["relative_variance"]
    assert gbn["blurred_difference"] < 0.3 * white["blurred_difference"]
    assert gbn["psnr"] > white["psnr"] + 6
    assert gbn["ssim"] > white["ssim"]
    assert gbn["patch_floor"] < 0.1 * white["patch_floor"]
    assert gbn["difference_power"][:3].mean() < 0.1 * white["difference_power"][:3].mean()


@pytest.mark.slow
def test_results_do_not_depend_on_how_the_work_is_split_and_a_run_resumes(tmp_path):
    sources = ["gbn[gradients=10]", "rejection"]
    one = compare_stipplings(
        DENSITY, sources, n=100, realizations=2, seed=3, out=tmp_path / "1", jobs=1, quiet=True
    )
    two = compare_stipplings(
        DENSITY, sources, n=100, realizations=2, seed=3, out=tmp_path / "2", jobs=2, quiet=True
    )
    cost = ["cpu_seconds"]
    assert one.table.drop(columns=cost).equals(two.table.drop(columns=cost))
    assert np.array_equal(one.run.sources[0].points, two.run.sources[0].points)
    assert np.array_equal(
        one.run.sources[0].points[1], adaptive_points(sources[0], DENSITY, 100, seed=3, realization=1)
    )
    (tmp_path / "1" / "manifest.json").unlink()
    (tmp_path / "1" / "pieces" / "rejection" / "000001.npz").unlink()
    again = compare_stipplings(
        DENSITY, sources, n=100, realizations=2, seed=3, out=tmp_path / "1", jobs=1, quiet=True
    )
    assert (again.reused, again.pieces) == (3, 4)
    assert again.table.drop(columns=cost).equals(one.table.drop(columns=cost))
    with pytest.raises(InputError, match="seed is 3 there, 4 here"):
        compare_stipplings(
            DENSITY, sources, n=100, realizations=2, seed=4, out=tmp_path / "1", jobs=1, quiet=True
        )
    (tmp_path / "1" / "pieces" / "rejection" / "000001.npz").write_bytes(b"")
    with pytest.raises(FormatError, match="sets of rejection are missing or were changed"):
        read_stippling_run(tmp_path / "1")


def test_a_source_that_fails_does_not_lose_the_others(tmp_path):
    made = compare_stipplings(
        DENSITY, [Failing(), "rejection", Refusing()], n=90, out=tmp_path / "run", jobs=1, quiet=True
    )
    assert made.table.source.tolist() == ["rejection"]
    assert [line.partition(":")[0] for line in made.failures] == ["failing"]
    assert "no set today" in made.failures[0]
    assert made.skipped == ("refusing at n=90: not this one",)
    assert (tmp_path / "run" / "table.csv").exists()
    with pytest.raises(InputError, match="is an unfinished comparison of stipplings"):
        read_stippling_run(tmp_path / "run")
    with pytest.raises(RefusalError, match="refusing at n=90: not this one"):
        compare_stipplings(DENSITY, Refusing(), n=90, out=tmp_path / "other", quiet=True)


@pytest.mark.slow
def test_arrays_and_files_lie_on_the_image_as_generators_do(tmp_path):
    x = unit_square(adaptive_points("rejection", DENSITY, 80)[:, ::-1], DENSITY.shape[::-1])
    rows = "\n".join(f"{a:.17g} {b:.17g} 1.5" for a, b in x)
    (tmp_path / "theirs.txt").write_text(rows + "\n")
    made = compare_stipplings(
        DENSITY, {"file": tmp_path / "theirs.txt", "array": x, "ours": "rejection"},
        n=80, out=tmp_path / "run", jobs=1, quiet=True,
    )  # fmt: skip
    table = made.table.drop(columns=["source", "cpu_seconds"])
    assert table.iloc[1].to_numpy() == pytest.approx(table.iloc[2].to_numpy(), rel=1e-9, nan_ok=True)
    assert table.iloc[0].to_numpy() == pytest.approx(table.iloc[2].to_numpy(), rel=1e-5, nan_ok=True)
    assert np.isnan(made.table.cpu_seconds).tolist() == [True, True, False]


@pytest.mark.parametrize(
    ("name", "text", "options"),
    [
        ("fractions.csv", "x,y\n0.25,0.5\n0.5,0.25\n", PLAIN),
        ("pixels.csv", "x,y,amplitude\n10,24,1\n20,36,2\n", PLAIN),
        ("pixels.txt", "10 24 0.5\n20 36 0.5\n", PLAIN),
        ("box.txt", "50.0 120.0\n100.0 60.0\n", reading_options(bounds=(0, 200, 0, 240))),
    ],
)
def test_files_are_read_in_pixels_with_y_down_or_fractions_with_y_up(tmp_path, name, text, options):
    (tmp_path / name).write_text(text)
    ((sets, digest),) = sets_on_image(tmp_path / name, (48, 40), options)
    assert sets[0] == pytest.approx(np.array([[24, 10], [36, 20]]))
    assert len(digest) == 64


def test_faults_of_sources_are_said(tmp_path):
    (tmp_path / "beyond.txt").write_text("10.5 24.5\n41 36.5\n")
    with pytest.raises(FormatError, match=r"beyond\.txt, line 2: coordinate 41.0 is not in .0, 40."):
        sets_on_image(tmp_path / "beyond.txt", (48, 40), PLAIN)
    (tmp_path / "words.txt").write_text("0.1 0.2\n0.3 dog\n")
    with pytest.raises(FormatError, match=r"words\.txt, line 2"):
        sets_on_image(tmp_path / "words.txt", (48, 40), PLAIN)
    for wrong, message in (
        (["gbnn"], "did you mean 'gbn'"),
        ([np.zeros((5, 3))], r"array: points must be \(n, 2\)"),
        ([np.full((5, 2), 45.0)], "must lie in the unit square"),
        ([], "no source given"),
    ):
        with pytest.raises(InputError, match=message):
            compare_stipplings(DENSITY, wrong, n=90, out=tmp_path / "none", quiet=True)
    with pytest.raises(InputError, match="say how files are read"):
        compare_stipplings(DENSITY, "rejection", n=90, reading=reading_options(period=2.0), quiet=True)
    with pytest.raises(InputError, match="n must be at least 1; got 0"):
        compare_stipplings(DENSITY, "rejection", n=0, quiet=True)
    with pytest.raises(InputError, match="is a volume"):
        compare_stipplings(np.ones((5, 6, 7)), "rejection", n=9, quiet=True)
    with pytest.raises(InputError, match="opposite borders of this density meet"):
        compare_stipplings(as_density(RAMP, toroidal=True), "rejection", n=9, out=tmp_path / "t", quiet=True)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["beyond.txt", "words.txt"]


@pytest.mark.slow
def test_stipplings_are_sources(tmp_path):
    made = gbnbench.stipple(DENSITY, 80, method="rejection", seed=4)
    run = compare_stipplings(DENSITY, [made, made.points], n=80, out=tmp_path / "run", jobs=1, quiet=True).run
    assert [source.label for source in run.sources] == ["rejection, seed 4", "array"]
    assert run.sources[0].points[0] == pytest.approx(made.pixels[:, ::-1], abs=1e-10)
    assert np.array_equal(run.sources[0].points, run.sources[1].points)
    labelled = compare_stipplings(DENSITY, {"mine": made}, n=80, out=tmp_path / "named", jobs=1, quiet=True)
    assert labelled.table.source.tolist() == ["mine"]


def test_a_file_that_cannot_be_read_does_not_lose_the_others(tmp_path):
    (tmp_path / "bad.txt").write_text("0.1 0.2\n0.3 dog\n")
    sources = [tmp_path / "bad.txt", "rejection", tmp_path / "gone.txt"]
    made = compare_stipplings(DENSITY, sources, n=90, out=tmp_path / "run", jobs=1, quiet=True)
    assert made.table.source.tolist() == ["rejection"]
    assert "bad.txt, line 2" in made.failures[0]
    assert "gone.txt: cannot be read" in made.failures[1]
    points = unit_square(adaptive_points("rejection", DENSITY, 70, seed=5)[:, ::-1], DENSITY.shape[::-1])
    np.savetxt(tmp_path / "bad.txt", points)
    mended = compare_stipplings(DENSITY, sources[:2], n=90, out=tmp_path / "run2", jobs=1, quiet=True)
    assert mended.table.source.tolist() == ["bad", "rejection"]
    assert mended.failures == ()
    with pytest.raises(InputError, match=r"gone\.txt: cannot be read"):
        compare_stipplings(DENSITY, tmp_path / "gone.txt", n=90, out=tmp_path / "none", quiet=True)


@pytest.mark.parametrize("suffix", [".csv", ".txt"])
def test_dots_of_several_inks_are_no_set(tmp_path, suffix):
    made = gbnbench.stipple(RAMP, 30, method="rejection")
    (tmp_path / f"one{suffix}").write_bytes(text_of({"black": made}, suffix))
    ((sets, _),) = sets_on_image(tmp_path / f"one{suffix}", made.density.shape, PLAIN)
    assert sets[0] == pytest.approx(made.pixels[:, ::-1], abs=1e-10)
    (tmp_path / f"inks{suffix}").write_bytes(text_of({"cyan": made, "black": made}, suffix))
    with pytest.raises(FormatError, match=f"inks{suffix}.*: its dots are of several inks"):
        sets_on_image(tmp_path / f"inks{suffix}", made.density.shape, PLAIN)


def test_points_of_a_volume_lie_on_no_image(tmp_path):
    (tmp_path / "cube.csv").write_text("x,y,z\n0.25,0.5,0.5\n0.5,0.25,0.75\n")
    with pytest.raises(FormatError, match="holds no points of a plane: name two columns by --columns"):
        sets_on_image(tmp_path / "cube.csv", (48, 40), PLAIN)
    ((sets, _),) = sets_on_image(tmp_path / "cube.csv", (48, 40), reading_options(columns="x,y"))
    assert sets[0] == pytest.approx(np.array([[24, 10], [36, 20]]))


def test_points_on_the_borders_of_an_image_stay_there(tmp_path):
    (tmp_path / "corners.csv").write_text("x,y\n0,0\n1,1\n")
    ((sets, _),) = sets_on_image(tmp_path / "corners.csv", (48, 40), PLAIN)
    assert sets[0] == pytest.approx(np.array([[48, 0], [0, 40]]))
    assert (sets < [48, 40]).all()
