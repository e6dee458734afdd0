"""A comparison as a whole: the same bits however it is split, stopped or resumed."""

from __future__ import annotations

import errno
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from gbnbench.core.errors import InputError
from gbnbench.generators.registry import find
from gbnbench.runs.comparison_folder import read_run
from gbnbench.runs.comparison_result import Run
from gbnbench.runs.sources import resolve
from gbnbench.studies.comparison import ComparisonOutcome, _require_common, run_comparison
from gbnbench.studies.timed_draw import draw_realization


@pytest.fixture(scope="module")
def small(tmp_path_factory: pytest.TempPathFactory) -> ComparisonOutcome:
    """Two generators by two workers, nothing drawn."""
    sources, _ = resolve(["random", "latin"], (16,), (1,), 4)
    return run_comparison(sources, tmp_path_factory.mktemp("small") / "run", seed=9, jobs=2)


@pytest.mark.slow
def test_the_split_of_the_work_changes_no_bit(small: ComparisonOutcome, tmp_path: Path) -> None:
    sources, _ = resolve(["random", "latin"], (16,), (1,), 4)
    alone = run_comparison(sources, tmp_path / "run", seed=9, jobs=1)
    for one, two in zip(alone.run.sources, small.run.sources, strict=True):
        assert one.points.tobytes() == two.points.tobytes()
        assert one.spectrum.power.tobytes() == two.spectrum.power.tobytes()
        assert repr(one.measures) == repr(two.measures)
    for k in range(4):
        stream = np.random.default_rng(np.random.SeedSequence(9, spawn_key=(k,)))
        np.testing.assert_array_equal(small.run.sources[0].points[k], stream.random((16, 1)))


def test_the_result_is_the_run_on_disk(small: ComparisonOutcome) -> None:
    stored = read_run(small.folder)
    assert [repr(s.measures) for s in stored.sources] == [repr(s.measures) for s in small.run.sources]
    assert stored.manifest["settings"]["sources"][1]["generator"] == "latin"
    assert stored.manifest["timings"]["cpu_seconds_a_set"].keys() == {"random_n16_d1", "latin_n16_d1"}
    assert (small.reused, small.pieces) == (0, 10)


@pytest.mark.slow
@pytest.mark.parametrize("stop", [OSError(errno.ENOSPC, "No space left on device"), KeyboardInterrupt()])
def test_stopped_while_drawing_it_is_not_whole_and_goes_on(tmp_path: Path, stop: BaseException) -> None:
    sources, _ = resolve(["random"], (16,), (1,), 2)

    def fail(_: Run, folder: Path) -> None:
        (folder / "figures").mkdir()
        raise stop

    if isinstance(stop, OSError):  # what was measured is whole, and is shown
        outcome = run_comparison(sources, tmp_path / "run", jobs=1, draw=fail)
        assert "No space left on device" in outcome.undrawn
        assert outcome.run.sources[0].label == "random"
    else:
        with pytest.raises(type(stop), match="what is finished is kept in"):
            run_comparison(sources, tmp_path / "run", jobs=1, draw=fail)
    with pytest.raises(InputError, match="unfinished"):
        read_run(tmp_path / "run")
    drawn: list[Path] = []
    done = run_comparison(sources, tmp_path / "run", jobs=1, draw=lambda _, folder: drawn.append(folder))
    assert (done.reused, done.pieces, done.undrawn) == (3, 3, "")
    assert drawn == [tmp_path / "run"]


def test_only_the_first_set_of_a_worker_may_hold_its_set_up() -> None:
    generator = find("random")
    marks = [draw_realization(generator, 16, 2, 0, k).first for k in range(3)]
    assert marks == [True, False, False]
    assert draw_realization(generator, 17, 2, 0, 0).first
    drawn = draw_realization(generator, 18, 2, 0, 1, redraw=True)
    assert not drawn.first
    stream = np.random.default_rng(np.random.SeedSequence(0, spawn_key=(1,)))
    np.testing.assert_array_equal(drawn.x, stream.random((18, 2)))


def test_bad_numbers_are_refused_before_anything_is_written(tmp_path: Path) -> None:
    sources, _ = resolve(["random"], (16,), (1,), 2)
    for wrong in ({"jobs": 0}, {"seed": -1}):
        with pytest.raises(InputError, match=next(iter(wrong))):
            run_comparison(sources, tmp_path / "run", **wrong)  # type: ignore[arg-type]
    assert not (tmp_path / "run").exists()


def test_a_baseline_with_nothing_in_common_is_refused_before_any_work(tmp_path: Path) -> None:
    (source,), _ = resolve(["random"], (64,), (2,), 2)
    before = SimpleNamespace(sources=(SimpleNamespace(label="gbn", n=64, d=2),))
    with pytest.raises(InputError, match=r"none of these sources; it holds gbn \(n=64, d=2\)"):
        _require_common([source], before, tmp_path)  # type: ignore[arg-type]
    same = SimpleNamespace(sources=(SimpleNamespace(label="random", n=64, d=2),))
    assert _require_common([source], same, tmp_path) is None  # type: ignore[arg-type,func-returns-value]
