"""What every generator of the registry promises, asked of each in one to four dimensions."""

from __future__ import annotations

import dataclasses
import re
from typing import Any

import numpy as np
import pytest

from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.settings import specification
from gbnbench.core.torus import FloatArray
from gbnbench.generators.protocol import FAMILIES, Generator, ListedGenerator, realization_rng
from gbnbench.generators.registry import GENERATORS, find, generate

QUICK: dict[str, dict[str, Any]] = {
    "lloyd": {"iterations": 1, "method": "lloyd"},
    "capcvt": {"iterations": 10},
    "ccvt": {"samples": 16},
    "gbn": {"gradients": 20},
    "progressivegbn": {"gradients": 20},
    "oztireli": {"iterations": 3},
    "sph": {"iterations": 20},
    "kdm": {"iterations": 3},
    "electrostatic": {"iterations": 10},
    "sliced": {"iterations": 20},
    **{name: {"iterations": 4} for name in ("step", "peak", "staircase", "targeted")},
}
SIZES = (16, 15, 27)


def served() -> list[tuple[str, int, int]]:
    """Name, n and d of everything that can be made, at the first of a few small sizes."""
    cases = []
    for name in GENERATORS:
        for d in (1, 2, 3, 4):
            fits = [n for n in SIZES if find(name).refusal(n, d) is None]
            cases += [(name, fits[0], d)] if fits else []
    return cases


# Settings that go with others: a power is that of kernel=riesz, and steps are counted in one of two ways.
TOGETHER: dict[str, dict[str, Any]] = {"gbn": {"kernel": "riesz", "gradients": 320}}


def changed(generator: Generator) -> Generator:
    """The same generator with every number and switch moved off its default, where they go together."""
    values: dict[str, Any] = {}
    for field in dataclasses.fields(generator):  # type: ignore[arg-type]
        if isinstance(field.default, bool):
            values[field.name] = not field.default
        elif isinstance(field.default, int):
            values[field.name] = field.default + 1
        elif isinstance(field.default, float):
            values[field.name] = field.default * 0.75
    values |= TOGETHER.get(generator.name, {})
    return dataclasses.replace(generator, **values)  # type: ignore[type-var]


@pytest.fixture(scope="class")
def sets(name: str, n: int, d: int) -> FloatArray:
    """Two realizations of seed 5, which several tests read."""
    return generate(name, n=n, d=d, seed=5, realizations=2, **QUICK.get(name, {}))


@pytest.mark.parametrize(("name", "n", "d"), served(), scope="class")
class TestDraws:
    def test_is_points_of_the_torus(self, sets: FloatArray, name: str, n: int, d: int) -> None:
        assert sets.shape == (2, n, d)
        for x in sets:
            assert x.dtype == np.float64
            assert x.flags.c_contiguous
            assert np.all((x >= 0) & (x < 1))
            assert len(np.unique(x, axis=0)) == n

    def test_realization_depends_on_seed_and_index_alone(
        self, sets: FloatArray, name: str, n: int, d: int
    ) -> None:
        quick = QUICK.get(name, {})
        assert np.array_equal(generate(name, n=n, d=d, seed=5, **quick), sets[0])
        assert np.array_equal(find(name, **quick)(n, d, realization_rng(5, 1)), sets[1])

    def test_realizations_and_seeds_differ(self, sets: FloatArray, name: str, n: int, d: int) -> None:
        x = generate(name, n=n, d=d, seed=6, **QUICK.get(name, {}))
        for one, other in ((sets[0], sets[1]), (sets[0], x), (sets[1], x)):
            assert not np.intersect1d(one, other).size

    def test_serves_a_single_point_or_says_why_not(self, name: str, n: int, d: int) -> None:
        if find(name).refusal(1, d) is None:
            assert generate(name, n=1, d=d, **QUICK.get(name, {})).shape == (1, d)
        else:
            with pytest.raises(RefusalError, match="n"):
                generate(name, n=1, d=d)


@pytest.mark.parametrize("name", GENERATORS)
class TestGenerator:
    def test_follows_the_protocol(self, name: str) -> None:
        kind = GENERATORS[name]
        assert kind.name == name
        assert kind.summary
        assert "\n" not in kind.summary
        assert isinstance(kind(), ListedGenerator)
        assert kind.family in FAMILIES

    def test_the_dimensions_listed_are_those_it_serves(self, name: str) -> None:
        least, most = GENERATORS[name].dimensions
        for d in (1, 2, 3, 4):
            refused = [find(name).refusal(n, d) for n in (1024, 1000, 2401, 4096)]
            inside = least <= d and (most is None or d <= most)
            assert all(reason is not None and f"d={d}" in reason for reason in refused) == (not inside)

    def test_is_equal_by_its_settings(self, name: str) -> None:
        generator = GENERATORS[name]()
        assert generator == find(name)
        assert hash(generator) == hash(find(name))

    def test_settings_make_the_round_trip_through_text(self, name: str) -> None:
        for generator in (GENERATORS[name](), changed(GENERATORS[name]())):
            text = specification(generator)
            assert find(text) == generator
            assert specification(find(text)) == text
        assert specification(GENERATORS[name]()) == name

    @pytest.mark.parametrize("d", [1, 2, 3, 4, 7, 30_000])
    def test_refusal_names_what_was_asked_and_a_size_that_fits(self, name: str, d: int) -> None:
        generator = find(name)
        for n in (1, 2, 10, 1000, 2**31):
            reason = generator.refusal(n, d)
            if reason is None:
                continue
            assert f"n={n}" in reason or f"d={d}" in reason
            nearest = re.search(r"nearest is (\d+)", reason)
            if nearest and f"n={n}" in reason:
                assert generator.refusal(int(nearest.group(1)), d) is None
            with pytest.raises(RefusalError):
                generator(n, d, realization_rng(0, 0))

    def test_unknown_setting_is_refused_with_those_there_are(self, name: str) -> None:
        with pytest.raises(InputError, match=f"{name} has no setting 'nonsense'") as caught:
            find(name, nonsense=1)
        for field in dataclasses.fields(GENERATORS[name]):  # type: ignore[arg-type]
            assert f"{field.name}=" in str(caught.value)
