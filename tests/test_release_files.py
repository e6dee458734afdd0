"""The files by which a release is made and cited agree with pyproject.toml and with their schemas."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
import tomllib

import pytest
import yaml
from packaging.requirements import Requirement
from packaging.version import Version

from tests.paths import ROOT

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
CITATION = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
CODEMETA = json.loads((ROOT / "codemeta.json").read_text(encoding="utf-8"))
ZENODO = json.loads((ROOT / ".zenodo.json").read_text(encoding="utf-8"))
RECIPE = yaml.safe_load((ROOT / ".conda" / "recipe.yaml").read_text(encoding="utf-8"))
CONDA_NAMES = {"matplotlib": "matplotlib-base"}  # where conda-forge's name is another


def lowest_versions() -> dict[str, str]:
    """The lower bound of each dependency on Linux, by name."""
    environment = {"sys_platform": "linux", "platform_machine": "x86_64"}
    needs = [Requirement(line) for line in PROJECT["dependencies"]]
    return {
        need.name: next(iter(need.specifier)).version
        for need in needs
        if need.marker is None or need.marker.evaluate(environment)
    }


def test_every_file_names_the_same_version():
    versions = (CITATION["version"], CODEMETA["version"], ZENODO["version"], RECIPE["context"]["version"])
    assert set(versions) == {PROJECT["version"]}


def test_the_date_of_release_is_that_of_the_changelog():
    changelog = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    date = re.search(rf"^## {re.escape(PROJECT['version'])} - (\d{{4}}-\d\d-\d\d)$", changelog, re.MULTILINE)
    assert date is not None
    assert CITATION["date-released"] == CODEMETA["datePublished"] == date[1]


def test_every_file_describes_the_same_package():
    assert CODEMETA["description"] == RECIPE["about"]["summary"] == PROJECT["description"]
    assert CITATION["title"] == ZENODO["title"]
    assert CITATION["keywords"] == CODEMETA["keywords"] == ZENODO["keywords"] == PROJECT["keywords"]
    assert CITATION["license"] == ZENODO["license"] == RECIPE["about"]["license"] == PROJECT["license"]
    assert CODEMETA["license"].endswith(f"/{PROJECT['license']}")


def test_the_recipe_needs_what_the_package_needs():
    bounds = dict(line.split(" >=") for line in RECIPE["requirements"]["run"] if " >=" in line)
    assert bounds.pop("python") == "${{ python_min }}"
    expected = {CONDA_NAMES.get(name, name): version for name, version in lowest_versions().items()}
    assert bounds == expected


def test_the_oldest_dependencies_are_the_lower_bounds():
    pins = dict(line.split("==") for line in (ROOT / ".ci" / "oldest.txt").read_text().split())
    lowest = lowest_versions()
    assert set(pins) == set(lowest)
    assert {name: Version(pin) for name, pin in pins.items()} == {
        name: Version(version) for name, version in lowest.items()
    }


@pytest.mark.slow
@pytest.mark.parametrize(
    ("schema", "file"),
    [
        ("github-workflows", ".github/workflows/tests.yml"),
        ("github-workflows", ".github/workflows/release.yml"),
        ("readthedocs", ".readthedocs.yaml"),
        ("citation-file-format", "CITATION.cff"),
    ],
)
def test_files_keep_to_their_schema(schema, file):
    checker = [sys.executable, "-m", "check_jsonschema", "--builtin-schema", f"vendor.{schema}"]
    outcome = subprocess.run([*checker, str(ROOT / file)], capture_output=True, text=True, timeout=120)
    assert outcome.returncode == 0, outcome.stdout


@pytest.mark.skipif(shutil.which("bash") is None or shutil.which("awk") is None, reason="no bash or awk")
def test_the_page_of_a_release_has_its_own_section_of_the_changelog(tmp_path):
    workflow = yaml.safe_load((ROOT / ".github" / "workflows" / "release.yml").read_text(encoding="utf-8"))
    (script,) = [s["run"] for s in workflow["jobs"]["page"]["steps"] if "awk" in s.get("run", "")]
    earlier, later = "## 0.0.1 - before\n- B\n", "# Changelog\n## 0.1.0.1 - after\n- C\n"
    (tmp_path / "CHANGELOG.md").write_text(f"{later}## 0.1.0 - then\n- A ([how](docs/a.md))\n{earlier}")
    place = {"GITHUB_SERVER_URL": "https://host", "GITHUB_REPOSITORY": "who/what"}
    for tag, code in (("v0.1.0", 0), ("v0.2.0", 1)):
        environment = {**os.environ, **place, "GITHUB_REF_NAME": tag}
        done = subprocess.run(["bash", "-e", "-c", script], cwd=tmp_path, env=environment, check=False)
        assert done.returncode == code
        if code == 0:
            expected = "## 0.1.0 - then\n- A ([how](https://host/who/what/blob/v0.1.0/docs/a.md))\n"
            assert (tmp_path / "notes.md").read_text() == expected


def test_the_paper_cites_what_its_bibliography_holds_and_nothing_else():
    text = (ROOT / "paper" / "paper.md").read_text(encoding="utf-8")
    bibliography = (ROOT / "paper" / "paper.bib").read_text(encoding="utf-8")
    held = re.findall(r"^@\w+\{(\w+),", bibliography, re.MULTILINE)
    assert set(re.findall(r"\[@(\w+)\]", text)) == set(held)
    assert len(held) == len(set(held))
