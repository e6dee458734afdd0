"""Progress within a set of generators that may take seconds, and that it changes nothing in the set."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.core.errors import InputError, RefusalError
from gbnbench.generators.monitor import Monitor, Trace
from gbnbench.generators.registry import GENERATORS, find, generate
from gbnbench.generators.set_by_set import SetBySet

QUICK = {
    "bluenets": "bluenets[iterations=5]",
    "latinmaximin": "latinmaximin[steps=3]",
    "sliced": "sliced[iterations=20]",
    "progressivegbn": "progressivegbn[gradients=5]",
    "electrostatic": "electrostatic[iterations=5]",
    "kdm": "kdm[iterations=3]",
    "lloyd": "lloyd[iterations=5]",
    "capcvt": "capcvt[iterations=5]",
    "sph": "sph[iterations=5]",
    "oztireli": "oztireli[iterations=2]",
    "bnot": "bnot[alternations=2]",
    "fpo": "fpo[target=0.7]",
    "ccvt": "ccvt[samples=64]",
    "voidcluster": "voidcluster",
    "bridson": "bridson",
    "bestcandidate": "bestcandidate",
    "darts": "darts",
    "maximalpoisson": "maximalpoisson",
    "elimination": "elimination",
}


def test_every_one_of_them_is_tried() -> None:
    assert {name for name, kind in GENERATORS.items() if issubclass(kind, SetBySet)} == set(QUICK)


@pytest.mark.parametrize("name", QUICK.values())
def test_progress_is_told_within_a_set(name: str) -> None:
    told: list[tuple[int, int, str]] = []
    x = generate(name, n=64, realizations=2, seed=1, monitor=Monitor(lambda *said: told.append(said)))
    done = [steps for steps, _, _ in told]
    assert done == sorted(done)
    assert len(set(done)) > 4
    assert told[-1][:2] == (2000, 2000)
    assert {words.split(", ")[1] for _, _, words in told} == {"set 1", "set 2"}
    np.testing.assert_array_equal(x, generate(name, n=64, realizations=2, seed=1))


def test_a_trace_is_refused_and_so_are_sets_that_cannot_be() -> None:
    with pytest.raises(InputError, match="kdm has no trace"):
        generate("kdm", n=10, monitor=Monitor(trace=Trace()))
    with pytest.raises(RefusalError, match="nearest is 3"):
        find("kdm")(10, 4, np.random.default_rng(0))
