"""Generators by name: documented streams, settings in the name, and mistakes named."""

from __future__ import annotations

import inspect
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
import pytest

from gbnbench.core.errors import DeviceError, InputError, RefusalError
from gbnbench.core.torus import FloatArray
from gbnbench.generators.kind_check import RESERVED
from gbnbench.generators.registry import find, generate
from gbnbench.generators.voronoi.lloyd import Lloyd


def test_random_is_numpys_stream_of_the_documented_seed() -> None:
    expected = [
        np.random.default_rng(np.random.SeedSequence(7, spawn_key=(k,))).random((5, 3)) for k in range(4)
    ]
    assert np.array_equal(generate("random", n=5, d=3, seed=7, realizations=4), expected)


def test_name_may_hold_settings() -> None:
    text = generate("lloyd[iterations=3]", n=9, tolerance="0")
    assert np.array_equal(text, generate("lloyd", n=9, iterations=3, tolerance=0.0))
    assert find(" lloyd [ iterations = 3 ] ") == Lloyd(iterations=3)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"name": "jitered", "n": 4}, "did you mean 'jittered'.*there are random, grid"),
        ({"name": "no-such-thing", "n": 4}, "no generator is named 'no-such-thing'; there are random"),
        ({"name": "lloyd[iterations=3]", "n": 4, "iterations": 4}, "a setting must come once"),
        ({"name": "lloyd[iterations=-3]", "n": 4}, r"iterations must lie in \[0, 1000000\]; got -3"),
        (
            {"name": "lloyd", "n": 4, "itrations": 4},
            "did you mean 'iterations'.*iterations=none, tolerance=0.001",
        ),
        ({"name": "random", "n": 0}, "n must be a whole number >= 1; got 0"),
        ({"name": "random", "n": 4.5}, "n must be a whole number >= 1; got 4.5"),
        ({"name": "random", "n": True}, "n must be a whole number >= 1; got True"),
        ({"name": "random", "n": 4, "d": 0}, "d must be a whole number >= 1; got 0"),
        ({"name": "random", "n": 4, "seed": -1}, "seed must be a whole number >= 0; got -1"),
        ({"name": "random", "n": 4, "realizations": 0}, "realizations must be a whole number >= 1; got 0"),
    ],
)
def test_wrong_arguments_are_named(arguments: dict[str, Any], message: str) -> None:
    with pytest.raises(InputError, match=message):
        generate(**arguments)


def test_refusal_is_the_generators_own() -> None:
    with pytest.raises(
        RefusalError, match=r"n must be m\*\*2 for a jittered grid; got n=1000, nearest is 1024"
    ):
        generate("jittered", n=1000)


def test_numpy_integers_are_integers() -> None:
    n, d = np.array([6, 2])
    assert generate("random", n=n, d=d, seed=np.uint32(3), realizations=np.int8(2)).shape == (2, 6, 2)


@dataclass(frozen=True)
class Drawn:
    """A generator of somebody's own: points scaled by a setting, or whatever else is to be tried."""

    name: ClassVar[str] = "drawn"
    summary: ClassVar[str] = "uniform points of a part of the torus"
    side: float = 0.5

    def refusal(self, n: int, d: int) -> str | None:
        return None if d <= 3 else f"d must be at most 3; got d={d}"

    def __call__(self, n: int, d: int, rng: np.random.Generator) -> FloatArray:
        return self.side * rng.random((n, d))


@dataclass(frozen=True)
class TooMany(Drawn):
    def __call__(self, n: int, d: int, rng: np.random.Generator) -> FloatArray:
        return rng.random((n + 1, d))


class Thawed:
    name, summary, refusal, __call__ = "thawed", "no dataclass", Drawn.refusal, Drawn.__call__


def test_an_instance_draws_from_the_streams_that_a_name_does() -> None:
    uniform = generate("random", n=5, d=3, seed=7, realizations=4)
    assert np.array_equal(generate(Drawn(0.25), n=5, d=3, seed=7, realizations=4), 0.25 * uniform)
    assert np.array_equal(generate(find("random"), n=5, d=3, seed=7), uniform[0])


@pytest.mark.parametrize(
    ("generator", "settings", "message"),
    [
        (Drawn, {}, r"must be an instance; got the class: write Drawn\(\)"),
        (Drawn(), {"side": 0.1}, r"has its settings already: write Drawn\(side=...\)"),
        (3, {}, "must be text such as.*; got int"),
        (Thawed(), {}, "must be a frozen dataclass of its settings; Thawed is none"),
        (Drawn(side=2.0), {}, r"drawn drew no point set: points must lie in \[0, 1\)"),
        (TooMany(), {}, r"drawn drew an array of shape \(5, 2\) for n=4, d=2"),
    ],
)
def test_an_instance_that_is_no_generator_is_refused(
    generator: Any, settings: dict[str, Any], message: str
) -> None:
    with pytest.raises(InputError, match=message):
        generate(generator, n=4, seed=1, **settings)


def test_an_instance_may_refuse() -> None:
    with pytest.raises(RefusalError, match="d must be at most 3; got d=4"):
        generate(Drawn(), n=4, d=4)


def test_no_setting_is_named_as_a_keyword_of_generate():
    assert set(inspect.signature(generate).parameters) == RESERVED

    @dataclass(frozen=True)
    class Seeded:
        name: ClassVar[str] = "seeded"
        summary: ClassVar[str] = "a generator with a seed of its own"
        seed: int = 0

        def refusal(self, n, d):
            return None

        def __call__(self, n, d, rng):
            return rng.random((n, d))

    with pytest.raises(InputError, match=r"must not be named as a keyword of generate; Seeded has seed"):
        generate(Seeded(), n=4)


def test_a_device_that_is_not_there_is_an_error_before_anything_is_drawn():
    with pytest.raises(DeviceError, match="no such device"):
        generate("random", n=4, device="no such device")
