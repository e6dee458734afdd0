"""Words for the room within which a figure agrees, and for how many agree."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence

from gbnbench.core.number_text import number
from gbnbench.verification.published_figure import KINDS
from gbnbench.verification.verify import Verified


def values(one: Verified) -> tuple[str, str]:
    """Write ours and what agrees, in digits that tell the two bounds apart.

    Parameters
    ----------
    one : Verified
        A figure beside ours.

    Returns
    -------
    ours, agrees_if : str
        Such as ``"0.739"`` and ``"0.712 to 0.803"``; ``"0.930605 ± 1e-6"`` where three digits would not tell
        the bounds apart; ``"exactly 0"`` of whole numbers; one side alone is ``"at most 0.006"``.
    """
    figure, ours = one.figure, one.ours
    if figure.whole:
        least, most = math.ceil(figure.low), math.floor(figure.high)
        shown = f"{ours:.0f}" if ours.is_integer() else number(ours)
        return shown, f"exactly {least}" if least == most else f"{least} to {most}"
    if math.isinf(figure.low):
        return number(ours), f"at most {number(figure.high)}"
    if math.isinf(figure.high):
        return number(ours), f"at least {number(figure.low)}"
    if number(figure.low) != number(figure.high):
        return number(ours), f"{number(figure.low)} to {number(figure.high)}"
    middle, half = (figure.low + figure.high) / 2, (figure.high - figure.low) / 2
    digits = math.ceil(math.log10(abs(middle) / half)) + 1  # to see where within the room ours is
    return _short(ours, digits), f"{_short(middle, digits)} ± {_short(half, 1)}"


def _short(value: float, digits: int) -> str:
    return re.sub(r"e-0*", "e-", f"{value:.{digits}g}")


def agreeing(found: Sequence[Verified]) -> str:
    """Say how many figures of each kind agree.

    Parameters
    ----------
    found : sequence of Verified
        At least one.

    Returns
    -------
    str
        Such as ``"Published figure: 22 of 22 agree; theory: 30 of 30."``
    """
    told = []
    for kind in KINDS:
        of_kind = [one for one in found if one.figure.kind == kind]
        if of_kind:
            told.append(f"{kind}: {sum(one.agrees for one in of_kind)} of {len(of_kind)} agree")
    text = "; ".join(told)
    return f"{text[0].upper()}{text[1:]}."
