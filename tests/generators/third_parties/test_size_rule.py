"""Rules of numbers of points: just the numbers that keep one pass, and the nearest that does is named."""

from __future__ import annotations

import re

import pytest

from gbnbench.generators.third_parties.size_rule import SizeRule, size_refusal

RULES: dict[SizeRule, set[int]] = {
    "any": set(range(1, 300)),
    "m**d": {m**3 for m in range(1, 8)},
    "2**m": {2**m for m in range(10)},
    (5, 17, 290): {5, 17, 290},
}


@pytest.mark.parametrize("rule", RULES)
def test_just_what_keeps_the_rule_passes(rule: SizeRule) -> None:
    sizes = RULES[rule]
    for n in range(1, 300):
        reason = size_refusal(rule, "mine", n, 3)
        assert (reason is None) == (n in sizes)
        if reason is not None:
            found = re.search(r"; got n=(\d+), nearest is (\d+)$", reason)
            assert found is not None
            assert int(found[1]) == n
            assert abs(int(found[2]) - n) == min(abs(size - n) for size in sizes)
