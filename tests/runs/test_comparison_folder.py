"""Folders of comparisons: what is written is read, and what is damaged or another's is told."""

from __future__ import annotations

import dataclasses
import math
import os
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

from gbnbench.analysis.measure_definitions import DEFINITIONS
from gbnbench.core.errors import FormatError, InputError
from gbnbench.core.results.measures import Measures
from gbnbench.core.results.radial import RadialPower
from gbnbench.core.results.spectrum import Spectrum
from gbnbench.io import data_files
from gbnbench.runs import comparison_folder
from gbnbench.runs.comparison_result import Run, SourceResult
from gbnbench.runs.resumable_folder import _difference

AWKWARD = (0.1, 1 / 3, 5e-324, -0.0, 1e300, math.nan, math.inf, -math.inf, 0.1 + 0.2)


def result(key: str = "gbn_n8_d2", label: str = 'gbn[x=1], "é"', d: int = 2, sets: int = 3) -> SourceResult:
    """Every field filled with numbers that are hard to write down."""
    rng = np.random.default_rng(5)
    numbers = [AWKWARD[i % len(AWKWARD)] for i in range(len(DEFINITIONS))]
    names = [definition.name for definition in DEFINITIONS]
    frequency = np.sqrt(np.arange(1.0, 6.0))
    return SourceResult(
        key=key,
        label=label,
        n=8,
        d=d,
        realizations=sets,
        points=rng.random((sets, 8, d)),
        spectrum=Spectrum(rng.random((5,) * d), 8, d, sets, 2, method="direct", device="a, b"),
        radial=RadialPower(frequency, frequency / 8**0.5, rng.random(5) * 1e-30, np.arange(4, 9)),
        anisotropy=pd.DataFrame(
            {
                "frequency": frequency,
                "nu": frequency / 3,
                "anisotropy_db": [0.1, math.nan, -math.inf, 1 / 3, 5e-324],
            }
        ),
        rdf=pd.DataFrame({"r": [0.1, 0.3], "g": [0.0, 2 / 3]}) if d == 2 else None,
        valence=pd.DataFrame({"degree": [5, 6], "share": [1 / 3, 2 / 3]}) if d == 2 else None,
        zone_plate=rng.random((4, 4)) if d == 2 else None,
        measures=Measures(
            dict(zip(names, numbers, strict=True)),
            dict(zip(names, reversed(numbers), strict=True)),
            {"psi6": "line one\nline two, with a comma", "peak": "nan"},
        ),
        cpu_seconds=0.1 if d == 2 else math.nan,
        warnings=("not toroidal: P(1) is 3x", "nan"),
    )


def identity(seed: int = 0, *results: SourceResult) -> dict[str, Any]:
    sources = [
        {"key": r.key, "label": r.label, "n": r.n, "d": r.d, "realizations": r.realizations} for r in results
    ]
    return {"seed": seed, "sources": sources}


def write(path: Path, *results: SourceResult) -> comparison_folder.ComparisonFolder:
    settings = identity(0, *results)
    folder = comparison_folder.ComparisonFolder(path, settings)
    with folder.lock():
        folder.begin()
        for each in results:
            folder.write_source(each)
        verdicts = [{"source": results[0].key, "measure": "peak", "verdict": "worse"}]
        folder.finish({"settings": settings, "verdicts": verdicts, "command": "x"})
    return folder


def assert_same(a: object, b: object) -> None:
    """Compare to the last bit, nan equal to nan, -0.0 different from 0.0."""
    assert type(a) is type(b)
    if dataclasses.is_dataclass(a):
        for field in dataclasses.fields(a):
            assert_same(getattr(a, field.name), getattr(b, field.name))
    elif isinstance(a, pd.DataFrame):
        pd.testing.assert_frame_equal(a, b, check_exact=True)  # type: ignore[arg-type]
    elif isinstance(a, np.ndarray):
        assert a.dtype == b.dtype  # type: ignore[attr-defined]
        assert a.tobytes() == b.tobytes()  # type: ignore[attr-defined]
        assert a.shape == b.shape  # type: ignore[attr-defined]
    elif isinstance(a, dict):
        assert list(a) == list(b)  # type: ignore[call-overload]
        for key in a:
            assert_same(a[key], b[key])  # type: ignore[index]
    else:
        assert repr(a) == repr(b)


def test_a_run_read_is_the_run_written(tmp_path: Path) -> None:
    written = (result(), result("flat", "random", d=3, sets=1))
    write(tmp_path / "run", *written)
    run = comparison_folder.read_run(tmp_path / "run")
    assert len(run.sources) == 2
    for before, after in zip(written, run.sources, strict=True):
        assert_same(before, after)
    assert run.verdicts == {("gbn_n8_d2", "peak"): "worse"}
    assert not list(tmp_path.rglob("*.tmp"))


def test_a_realization_read_is_the_one_written(tmp_path: Path) -> None:
    folder = comparison_folder.ComparisonFolder(tmp_path, identity())
    x = np.random.default_rng(1).random((8, 2))
    folder.write_realization("gbn", 3, comparison_folder.Realization(x, 0.1, True))
    part = folder.read_realization("gbn", 3)
    assert part is not None
    assert part.x.tobytes() == x.tobytes()
    assert (part.cpu_seconds, part.first) == (0.1, True)
    assert folder.read_realization("gbn", 2) is None
    spoilt = tmp_path / "parts" / "gbn" / "000003.npz"
    spoilt.write_bytes(spoilt.read_bytes()[:100])
    assert folder.read_realization("gbn", 3) is None


def test_the_tables_hold_every_source_and_measure(tmp_path: Path) -> None:
    run = Run({}, (result(),), {("gbn_n8_d2", "peak"): "worse"})
    comparison_folder.ComparisonFolder(tmp_path, identity()).write_tables(run)
    table = pd.read_csv(tmp_path / "measures.csv", dtype=str).set_index("measure")
    assert list(table.index) == [definition.name for definition in DEFINITIONS]
    assert table.loc["peak", "verdict"] == "worse"
    assert table.loc["psi6", "reason"] == "line one\nline two, with a comma"
    expected = np.array(list(run.sources[0].measures.values()))
    np.testing.assert_array_equal(table["value"].astype(float), expected)
    assert pd.read_csv(tmp_path / "table.csv", dtype=str).loc[0, "noise_floor"] == "0.1"


def test_a_deleted_table_of_a_finished_run_is_written_again(tmp_path: Path) -> None:
    run = Run({}, (result(),), {})
    folder = comparison_folder.ComparisonFolder(tmp_path, identity())
    folder.write_tables(run)
    before = (tmp_path / "table.csv").read_bytes()
    (tmp_path / "table.csv").unlink()
    folder.write_tables(run, missing=True)
    assert (tmp_path / "table.csv").read_bytes() == before


def test_a_table_that_the_user_edited_stays_when_the_other_is_written_again(tmp_path: Path) -> None:
    run = Run({}, (result(),), {})
    folder = comparison_folder.ComparisonFolder(tmp_path, identity())
    (tmp_path / "table.csv").write_text("notes of the user's own")
    folder.write_tables(run, missing=True)
    assert (tmp_path / "table.csv").read_text() == "notes of the user's own"
    assert (tmp_path / "measures.csv").is_file()


def test_a_folder_without_its_manifest_is_no_run(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="not a run of gbnbench: there is no such folder"):
        comparison_folder.read_run(tmp_path / "absent")
    with pytest.raises(InputError, match=r"not a run of gbnbench: it has no manifest\.json"):
        comparison_folder.read_run(tmp_path)
    folder = write(tmp_path / "run", result())
    assert folder.whole
    folder.begin()
    assert not folder.whole
    with pytest.raises(InputError, match="unfinished run"):
        comparison_folder.read_run(tmp_path / "run")


@pytest.mark.parametrize("name", ["source.json", "points.npz", "spectrum.npz", "radial.csv", "rdf.csv"])
@pytest.mark.parametrize("damage", ["missing", "truncated", "altered"])
def test_a_damaged_file_is_named(tmp_path: Path, name: str, damage: str) -> None:
    folder = write(tmp_path / "run", result())
    path = tmp_path / "run" / "sources" / "gbn_n8_d2" / name
    data = path.read_bytes()
    if damage == "missing":
        path.unlink()
    else:
        path.write_bytes(data[: len(data) // 2] if damage == "truncated" else data[:-9] + b"7" + data[-8:])
    with pytest.raises(FormatError, match=f"{name}.*(missing|changed)"):
        comparison_folder.read_run(tmp_path / "run")
    if damage == "truncated" and not name.endswith("csv"):
        assert folder.read_source("gbn_n8_d2") is None


def test_a_manifest_that_is_not_ours_is_said(tmp_path: Path) -> None:
    write(tmp_path / "run", result())
    for text, words in (("{", "is not what gbnbench wrote"), ('{"format": 99}', "has format 99"),
                        ('{"format": 1}', "is not what gbnbench wrote")):  # fmt: skip
        (tmp_path / "run" / "manifest.json").write_text(text)
        with pytest.raises(FormatError, match=words):
            comparison_folder.read_run(tmp_path / "run")


def test_a_run_of_other_settings_is_refused_and_left_alone(tmp_path: Path) -> None:
    write(tmp_path, result())
    before = {p: p.stat().st_mtime_ns for p in tmp_path.rglob("*")}
    with pytest.raises(InputError, match="seed is 0 there, 7 here"):
        comparison_folder.ComparisonFolder(tmp_path, identity(7, result()))
    with pytest.raises(InputError, match=r"realizations of .* is 3 there, 5 here"):
        comparison_folder.ComparisonFolder(tmp_path, identity(0, result(sets=5)))
    with pytest.raises(InputError, match=r"sources are .* there, random n=8 d=2 here"):
        comparison_folder.ComparisonFolder(tmp_path, identity(0, result("r", "random")))
    assert {p: p.stat().st_mtime_ns for p in tmp_path.rglob("*")} == before


def test_a_folder_of_something_else_is_refused(tmp_path: Path) -> None:
    (tmp_path / "thesis.tex").write_text("x")
    with pytest.raises(InputError, match="not empty and is not a run"):
        comparison_folder.ComparisonFolder(tmp_path, identity())
    with pytest.raises(InputError, match="is a file"):
        comparison_folder.ComparisonFolder(tmp_path / "thesis.tex", identity())
    (tmp_path / "killed early").mkdir()
    (tmp_path / "killed early" / ".lock").write_text("1")
    assert not comparison_folder.ComparisonFolder(tmp_path / "killed early", identity()).whole


def test_one_process_at_a_time(tmp_path: Path) -> None:
    folder = comparison_folder.ComparisonFolder(tmp_path / "run", identity())
    busy = rf"being written by another gbnbench \(process {os.getpid()}\)"
    with folder.lock(), pytest.raises(InputError, match=busy), folder.lock():
        pass
    with folder.lock():  # what is left behind does not lock
        assert (tmp_path / "run" / ".lock").read_text() == f"{os.getpid()}\n"


def test_default_folders_follow_the_settings() -> None:
    one, other = identity(0, result("r", "random")), identity(1, result("r", "random"))
    folder = comparison_folder.default_folder(one)
    assert folder == comparison_folder.default_folder(identity(0, result("r", "random")))
    assert folder != comparison_folder.default_folder(other)
    assert folder.parts[:-1] == ("runs",)
    assert folder.name.startswith("random_n8_")


def test_csv_floats_read_back_the_same(tmp_path: Path) -> None:
    numbers = np.concatenate([np.random.default_rng(3).random(500) * 10.0 ** np.arange(-250, 250), AWKWARD])
    path = tmp_path / "v.csv"
    path.write_bytes(data_files.to_csv(pd.DataFrame({"v": numbers})))
    words = path.read_text().splitlines()[1:]
    assert np.array([float(word) for word in words]).tobytes() == numbers.tobytes()
    assert data_files.read_csv(path)["v"].to_numpy().tobytes() == numbers.tobytes()


def test_files_read_otherwise_are_told_by_how_they_are_read() -> None:
    source = {"label": "dots", "n": 2, "d": 2, "kind": "files", "sha256": "12"}
    source |= {"reading": {"period": [512.0]}}
    other = {**source, "sha256": "34", "reading": {"period": [256.0]}}
    said = _difference({"sources": [source]}, {"sources": [other]})
    assert said == "period of dots is 512 there, 256 here"
    plain = {**source, "sha256": "56"}
    assert _difference({"sources": [source]}, {"sources": [plain]}) == "the content of dots differs"


def test_settings_with_parts_are_told_in_words() -> None:
    density = {"name": "camera", "shape": [512, 512], "sha256": "12"}
    for part, said in (
        ({"name": "coins"}, "name of the density is camera there, coins here"),
        ({"shape": [303, 384]}, "shape of the density is 512,512 there, 303,384 here"),
        ({"sha256": "34"}, "the content of the density differs"),
    ):
        assert _difference({"density": density}, {"density": {**density, **part}}) == said
    flat = {"patch": {"side": 41, "variation": 0.5}}
    assert _difference(flat, {"patch": None}) == "side of the patch is 41 there, not given here"
    assert _difference({"wrap": True}, {"wrap": False}) == "wrap is on there, off here"
