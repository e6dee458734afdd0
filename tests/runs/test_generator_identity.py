"""What a run folder keeps of a generator tells it from every other, files that its settings name included."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from gbnbench.cli import run
from gbnbench.core.errors import InputError
from gbnbench.generators.registry import find
from gbnbench.generators.spectral_control.deep import Deep
from gbnbench.generators.spectral_control.target_profiles import Table
from gbnbench.generators.spectral_control.targeted import Targeted
from gbnbench.runs.generator_identity import generator_identity


@pytest.mark.parametrize("kind", ["targeted", "deep"])
def test_a_file_that_a_setting_names_is_known_by_its_contents(here, kind: str) -> None:
    identities = []
    for power in ("0.1", "0.2", "0.1"):
        Path("profile.csv").write_text(f"nu,power\n0,{power}\n0.5,1\n")
        identities.append(generator_identity(find(f"{kind}[target=profile.csv]")))
    first, second, third = identities
    assert first == third != second
    assert "sha256" not in generator_identity(find(kind))


def test_sets_of_another_file_of_the_same_name_are_not_taken_up(here, capsys) -> None:
    asked = ["compare", "targeted[target=profile.csv,iterations=3]", "-n", "16", "--realizations", "1"]
    asked += ["--jobs", "1", "--quiet", "--out", "run"]
    Path("profile.csv").write_text("nu,power\n0,0.1\n2,1\n")
    assert run(asked) == 0
    Path("profile.csv").write_text("nu,power\n0,0.5\n2,1\n")
    assert run(asked) == 2
    assert "run holds a run with other settings (profile.csv of targeted" in capsys.readouterr().err


def test_settings_are_as_they_are_read_again() -> None:
    """Else a run with a table as its target would refuse its own folder."""
    identity = generator_identity(Targeted(target=Table((0.0, 2.0), (0.1, 1.0))))
    assert identity == json.loads(json.dumps(identity))
    assert identity["settings"]["target"] == {"nu": [0.0, 2.0], "power": [0.1, 1.0]}


def test_a_function_is_refused_in_words() -> None:
    for generator in (Targeted(target=abs), Deep(target=abs, edge=0.5)):
        with pytest.raises(
            InputError, match=r"target of (targeted|deep) is a \w+, of which a run folder cannot"
        ):
            generator_identity(generator)
