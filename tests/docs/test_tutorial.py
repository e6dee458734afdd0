"""The tutorial notebook, executed: no cell fails, and what it shows is what its text says."""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path

import nbformat
import pytest
from nbclient import NotebookClient

from tests.paths import ROOT

NOTEBOOK = ROOT / "docs" / "tutorial.ipynb"
RESULTS = """
import json
print(json.dumps({
    "shape": sets["gbn"].shape,
    "floor": {name: found[name]["noise_floor"] for name in found} | {"deep": deep["noise_floor"]},
    "peak": {name: found[name]["peak"] for name in found} | {"deep": deep["peak"]},
    "order": [m["valence6"], deep["valence6"]],
    "message": message,
    "rounding": rounding,
    "variance": {name: v.value for name, v in variance.items()},
    "slope": dict(zip(study.slopes.source, study.slopes.slope)),
    "deviation": study.table.deviation.abs().max(),
    "home": gbnbench.__file__,
    "files": sorted(path.name for path in folder.iterdir()),
}))
"""


def test_it_is_kept_without_outputs() -> None:
    for cell in nbformat.read(NOTEBOOK, as_version=4).cells:
        assert cell.get("execution_count") is None
        assert not cell.get("outputs")


@pytest.mark.slow
@pytest.mark.filterwarnings("default")  # the kernel's client has warnings of its own
def test_it_runs_and_shows_what_it_says(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([str(ROOT), *sys.path]))
    monkeypatch.setenv("IPYTHONDIR", str(tmp_path))
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    notebook.cells.append(nbformat.v4.new_code_cell(RESULTS))
    # Of this interpreter, whatever kernels are installed under the name python3.
    notebook.metadata.kernelspec["name"] = "python3"
    NotebookClient(notebook, timeout=300, resources={"metadata": {"path": str(tmp_path)}}).execute()

    shown = json.loads(notebook.cells[-1].outputs[0].text)
    assert Path(shown["home"]).is_relative_to(ROOT)
    assert shown["shape"] == [4, 1024, 2]
    floor, peak = shown["floor"], shown["peak"]
    assert 4e-10 < floor["gbn"] < 1e-9
    assert floor["deep"] < 1e-20
    assert floor["gbn"] < floor["fpo"] < floor["sobol"] < floor["jittered"] < floor["random"]
    assert peak["deep"] < peak["gbn"] < 2.6 < peak["fpo"]
    assert shown["order"][1] < shown["order"][0]
    assert shown["message"].endswith("line 1: this line says 3 points, and the file ends after 2")
    assert shown["rounding"] < 1e-26
    assert shown["variance"]["deep"] < shown["variance"]["gbn"] < 1e-5 * shown["variance"]["sobol"]
    assert shown["slope"]["gbn"] < -4 < shown["slope"]["sobol"] < shown["slope"]["random"] < -0.7
    assert shown["deviation"] < 8  # the largest of 16 that have few degrees of freedom: 4 sets
    assert shown["files"] == ["comparison", "cut.txt", "deep.csv", "deep.npz", "mine.txt", "study"]
    pictures = [
        output
        for cell in notebook.cells
        for output in cell.get("outputs", [])
        if "image/png" in output.get("data", {})
    ]
    assert len(pictures) == 6
    assert not [o for cell in notebook.cells for o in cell.get("outputs", []) if o.get("name") == "stderr"]
    if "TUTORIAL_OUT" in os.environ:
        nbformat.write(notebook, os.environ["TUTORIAL_OUT"])
