"""Generators of installed packages: found lazily; what cannot be used is told with its package."""

from __future__ import annotations

import pickle
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import gbnbench
from gbnbench.cli import run
from gbnbench.core.errors import GbnbenchError, InputError
from gbnbench.generators.registry import GENERATORS, find, generator_names
from gbnbench.generators.third_parties.discovery import provenance, third_parties

CLASS = """
from dataclasses import dataclass
from typing import ClassVar

@dataclass(frozen=True)
class Half:
    '''Uniform points of a part of the torus.

    Parameters
    ----------
    side : float
        Share of each side.
    '''

    name: ClassVar[str] = {name!r}
    summary: ClassVar[str] = "uniform points of a part of the torus"
    side: float = 0.5

    def refusal(self, n, d):
        return None

    def __call__(self, n, d, rng):
        return self.side * rng.random((n, d))
"""


def told_of(member: str, value: str) -> str:
    """Write the class with one member more."""
    return CLASS.format(name="half").replace(
        "    side: float", f"    {member}: ClassVar[object] = {value}\n    side: float"
    )


def test_a_class_is_known_by_its_name(install) -> None:
    install("halves_a", CLASS.format(name="half"), "half = halves_a:Half")
    assert generator_names() == [*GENERATORS, "half"]
    assert "halves_a" not in sys.modules, "names are listed without an import"
    x = gbnbench.generate("half[side=0.25]", n=5, seed=1, realizations=2)
    assert np.array_equal(x, 0.25 * gbnbench.generate("random", n=5, seed=1, realizations=2))
    generator = find("half")
    assert pickle.loads(pickle.dumps(generator)) == generator  # noqa: S301 - our own
    assert provenance(type(generator)) == {"class": "halves_a.Half", "package": "halves_a 2.1"}
    table = gbnbench.generator_table().set_index("name")
    assert table.loc["half", ["family", "domain", "origin"]].tolist() == ["", "", "halves_a 2.1"]
    assert np.isnan(table.cpu_seconds["half"])


@pytest.mark.parametrize(
    ("text", "entry", "said"),
    [
        (CLASS.format(name="gbn"), "gbn = {0}:Half", "gbnbench has one of that name"),
        (CLASS.format(name="other"), "half = {0}:Half", "Half must have the name under which it is offered"),
        ("import no_such_module", "half = {0}:Half", "ModuleNotFoundError: No module named 'no_such_module'"),
        ("raise SystemExit('bye')", "half = {0}:Half", "its import failed: SystemExit: bye"),
        ("Hal = 1", "half = {0}:Half", "AttributeError: module '{0}' has no attribute 'Half'"),
        ("Half = 1", "half = {0}:Half", "it must be a class; got int"),
        ("class Half: name = 'half'", "half = {0}:Half", "Half must be a frozen dataclass of its settings"),
        (CLASS.format(name="half").replace("refusal", "refuse"), "half = {0}:Half", "Half lacks refusal"),
        (CLASS.format(name="half").replace("__call__", "call"), "half = {0}:Half", "Half lacks __call__"),
        (CLASS.format(name="half").replace("= 0.5", ""), "half = {0}:Half", "each setting needs a default"),
        (CLASS.format(name="half").replace("side:", "seed:"), "half = {0}:Half", "Half has seed: rename it"),
        (
            CLASS.format(name="half").replace("side:", "family:"),
            "half = {0}:Half",
            "Half has family: rename it",
        ),
        (CLASS.format(name="half").replace("side: float", "side: list"), "half = {0}:Half", "Half has side"),
        (
            CLASS.format(name="half").replace("side: float", "side: 'No'"),
            "half = {0}:Half",
            "'No' is not defined",
        ),
        (told_of("dimensions", "(1,)"), "half = {0}:Half", "dimensions of Half must be (least, most)"),
        (
            told_of("dimensions", "(3, 2)"),
            "half = {0}:Half",
            "and >= 1, most None where there is no end; got (3, 2)",
        ),
        (told_of("family", "3"), "half = {0}:Half", "family of Half must be one line of text; got 3"),
        (told_of("toroidal", "'no'"), "half = {0}:Half", "toroidal of Half must be True or False; got 'no'"),
        (told_of("reference", "'a\\nb'"), "half = {0}:Half", "reference of Half must be one line of text"),
    ],
)
def test_what_cannot_be_used_is_told_and_costs_only_itself(
    install,
    request: pytest.FixtureRequest,
    capsys: pytest.CaptureFixture[str],
    text: str,
    entry: str,
    said: str,
) -> None:
    module = f"broken_{abs(hash(request.node.name))}"
    install("halves_b", CLASS.format(name="sound"), "sound = halves_b:Half")
    install(module, text, entry.format(module))
    found, faults = third_parties(GENERATORS)
    assert list(found) == ["sound"]
    (fault,) = faults
    name = entry.partition(" ")[0]
    assert fault.startswith(f"generator {name!r} of the package {module} 2.1 cannot be used: ")
    assert said.format(module) in fault
    with pytest.warns(UserWarning, match=f"the package {module} 2.1"):
        assert "sound" in set(gbnbench.generator_table().name)
    assert run(["generators"]) == 0
    out, err = capsys.readouterr()
    assert "halves_b 2.1" in out
    assert err == f"gbnbench: warning: {fault}\n"
    if name not in GENERATORS:
        with pytest.raises(InputError, match=f"the package {module} 2.1 cannot be used"):
            gbnbench.generate(name, n=4)


@pytest.mark.parametrize(
    ("was", "now", "said"),
    [
        (
            "return None",
            "return 1 / 0 == n",
            r"refusal\(n=4, d=2\) failed: ZeroDivisionError: .* line \d+\)$",
        ),
        ("return None", "raise SystemExit", r"refusal\(n=4, d=2\) failed: SystemExit \("),
        ("return None", "return n < 9", r"refusal\(n, d\) must return a reason or None; got True$"),
        (
            "return self",
            "return n.none * self",
            r"drawing n=4, d=2 failed: AttributeError: 'int' .* line \d+\)",
        ),
        ("return self", "import no_such_module; return self", "ModuleNotFoundError: No module named"),
        (
            "    def refusal",
            "    def __post_init__(self):\n        raise OSError('no')\n\n    def refusal",
            r"making it failed: OSError: no \(faulty_\d+\.py, line 20\)",
        ),
    ],
)
def test_what_it_raises_is_told_with_its_package(
    install, tmp_path: Path, capsys: pytest.CaptureFixture[str], was: str, now: str, said: str
) -> None:
    module = f"faulty_{abs(hash(now))}"
    install(module, CLASS.format(name="half").replace(was, now), f"half = {module}:Half")
    said = rf"generator 'half' of the package {module} 2\.1: .*{said}"
    with pytest.raises(GbnbenchError, match=said):
        gbnbench.generate("half", n=4)
    assert run(["generate", "half", "-n", "4", "-o", str(tmp_path / "x.txt")]) == 2
    out, err = capsys.readouterr()
    assert err.startswith(f"gbnbench: error: generator 'half' of the package {module} 2.1: ")
    assert "Traceback" not in out + err


def test_a_reason_of_several_lines_is_told_in_one(install) -> None:
    reason = "return 'n must be even;\\n  nearest is 4'"
    install(
        "wordy_halves", CLASS.format(name="half").replace("return None", reason), "half = wordy_halves:Half"
    )
    with pytest.raises(GbnbenchError, match=r"^n must be even; nearest is 4$"):
        gbnbench.generate("half", n=5)


def test_of_two_packages_with_one_name_the_first_is_taken(install) -> None:
    install("halves_d", CLASS.format(name="half"), "half = halves_d:Half")
    install("halves_c", CLASS.format(name="half"), "half = halves_c:Half")
    found, (fault,) = third_parties(GENERATORS)
    assert found["half"].origin == "halves_c 2.1"
    assert fault.endswith("halves_d 2.1 cannot be used: halves_c 2.1 has one of that name")
    assert type(find("half")) is found["half"].kind


def test_gbnbenchs_own_are_found_without_a_search_of_packages() -> None:
    script = (
        "import sys, importlib.metadata as m\n"
        "def never(**_): raise AssertionError('searched')\n"
        "m.entry_points = never\n"
        "import gbnbench; gbnbench.generate('random', n=4)\n"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
