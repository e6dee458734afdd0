"""Sources of a comparison: generators, files and folders, in the order asked for."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from gbnbench.core.errors import FormatError, InputError, RefusalError
from gbnbench.generators.direct.jittered import Jittered
from gbnbench.runs.sources import Source, resolve
from tests.published_sets import published_files


def rows(path: Path, n: int, d: int = 2, seed: int = 0) -> np.ndarray:
    x = np.random.default_rng(seed).random((n, d))
    path.parent.mkdir(parents=True, exist_ok=True)
    np.save(path, x)
    return x


def named(*names: object, n: tuple[int, ...] = (64,), d: tuple[int, ...] = (2,)) -> tuple[Source, ...]:
    return resolve([str(name) for name in names], n, d, 3)[0]


def test_generators_sweep_in_the_order_asked() -> None:
    found = named("random", "lloyd[tolerance=0.001,iterations=7]", n=(16, 64), d=(2, 3))
    assert [(s.label, s.n, s.d) for s in found] == [
        (label, n, d) for label in ("random", "lloyd[iterations=7]") for d in (2, 3) for n in (16, 64)
    ]
    assert {s.realizations for s in found} == {3}
    assert len({s.key for s in found}) == len(found)
    assert found[-1].identity()["settings"]["iterations"] == 7


def test_a_folder_is_a_source_for_each_n_and_d_in_natural_order(tmp_path: Path) -> None:
    second = rows(tmp_path / "mine" / "s10.npy", 20, seed=1)
    first = rows(tmp_path / "mine" / "s9.npy", 20, seed=2)
    cube = rows(tmp_path / "mine" / "t.npy", 20, d=3)
    (tmp_path / "mine" / "README.md").write_text("not points")
    found = named(tmp_path / "mine")
    assert [(s.label, s.n, s.d, s.realizations) for s in found] == [("mine", 20, 2, 2), ("mine", 20, 3, 1)]
    np.testing.assert_array_equal(found[0].sets, np.stack([first, second]))
    np.testing.assert_array_equal(found[1].sets, cube[None])


def test_a_file_with_several_sizes_is_several_sources(tmp_path: Path) -> None:
    (tmp_path / "p.dat").write_text("0.5 0.25\n0.125 0.75\n#\n0.5 0.5\n0.25 0.125\n0.75 0.5\n#\n")
    assert [(s.label, s.n, s.realizations) for s in named(tmp_path / "p.dat")] == [("p", 2, 1), ("p", 3, 1)]


def test_repeated_and_clashing_names_stay_apart(tmp_path: Path) -> None:
    rows(tmp_path / "a" / "p.npy", 8)
    rows(tmp_path / "b" / "p.npy", 8, seed=1)
    found = named("random", "random", tmp_path / "a" / "p.npy", tmp_path / "b" / "p.npy", n=(8,))
    assert [s.label for s in found] == [
        "random", "random (2)", str(tmp_path / "a" / "p.npy"), str(tmp_path / "b" / "p.npy")
    ]  # fmt: skip
    assert len({s.key for s in found}) == 4


def test_a_generator_wins_over_a_path_of_its_name(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    rows(tmp_path / "random" / "p.npy", 8)
    assert named("random")[0].generator is not None
    assert named("./random")[0].generator is None


def test_identity_follows_the_content_of_files(tmp_path: Path) -> None:
    rows(tmp_path / "p.npy", 8)
    before = named(tmp_path / "p.npy")[0].identity()
    assert named(tmp_path / "p.npy")[0].identity() == before
    rows(tmp_path / "p.npy", 8, seed=1)
    assert named(tmp_path / "p.npy")[0].identity() != before


def test_what_is_neither_generator_nor_path_gets_the_nearest_name() -> None:
    with pytest.raises(InputError, match=r"'jitterd' is neither .* did you mean jittered"):
        named("jitterd")


def test_an_unreadable_file_in_a_folder_is_named(tmp_path: Path) -> None:
    rows(tmp_path / "mine" / "good.npy", 8)
    (tmp_path / "mine" / "bad.txt").write_text("0.5 word\n")
    with pytest.raises(FormatError, match=r"bad\.txt, line 1"):
        named(tmp_path / "mine")
    (tmp_path / "none").mkdir()
    with pytest.raises(InputError, match="holds no point sets"):
        named(tmp_path / "none")


def test_a_refusal_is_skipped_where_others_remain_and_an_error_where_none_do() -> None:
    found, skipped = resolve(["jittered", "random"], (64, 50), (2,), 1)
    assert [(s.label, s.n) for s in found] == [("jittered", 64), ("random", 64), ("random", 50)]
    assert len(skipped) == 1
    assert skipped[0].startswith("jittered at n=50, d=2: ")
    with pytest.raises(RefusalError, match="jittered at n=50"):
        resolve(["jittered"], (50,), (2,), 1)


@pytest.mark.parametrize(("n", "d", "realizations"), [(0, 2, 1), (64, 0, 1), (64, 2, 0)])
def test_numbers_below_one_are_refused(n: int, d: int, realizations: int) -> None:
    with pytest.raises(InputError, match="must be at least 1; got 0"):
        resolve(["random"], (n,), (d,), realizations)


def test_sets_made_by_other_programs() -> None:
    found = named(*(published_files(f"{name}/*")[0].parent for name in ("bnot-1024", "gbn-3d-1024")))
    assert [(s.label, s.d, s.realizations) for s in found] == [("bnot-1024", 2, 4), ("gbn-3d-1024", 3, 1)]


@dataclass(frozen=True)
class Shifted(Jittered):
    """Somebody's own generator, under the name of one of the registry."""

    by: float = 0.25


def test_an_own_generator_is_a_source_that_is_not_taken_for_ours() -> None:
    (own, ours), skipped = resolve([Shifted(0.5), "jittered"], (64, 65), (2,), 3)
    assert (own.label, own.n, own.realizations) == ("jittered[by=0.5]", 64, 3)
    assert own.generator == Shifted(0.5)
    assert own.identity()["class"] == f"{__name__}.Shifted"
    assert own.identity()["settings"] == {"by": 0.5}
    assert "class" not in ours.identity()
    assert [line.partition(" at ")[0] for line in skipped] == ["jittered[by=0.5]", "jittered"]
    with pytest.raises(InputError, match=r"write Shifted\(\)"):
        resolve([Shifted], (64,), (2,), 1)  # type: ignore[list-item]
