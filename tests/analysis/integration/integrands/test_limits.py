"""Lists of frequencies that would be too long are refused with their length."""

from __future__ import annotations

import pytest

from gbnbench.analysis.integration.integrands.limits import check_count
from gbnbench.core.errors import RefusalError


def test_a_list_too_long_is_refused_with_its_length() -> None:
    with pytest.raises(
        RefusalError, match=r"a ball in d=3 has 5000000 frequencies, .* leave out a larger share"
    ):
        check_count("a ball", 3, 5_000_000)
