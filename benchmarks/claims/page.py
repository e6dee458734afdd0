"""docs/claims.md, from the measured table and the texts: every number on it is one of the table's.

python -m gbnbench.benchmarks.claims.page benchmarks/results/claims/claims.csv docs/claims.md
"""

from __future__ import annotations

import math
import re
import sys
from collections.abc import Iterator, Sequence
from importlib import resources
from pathlib import Path

from gbnbench.benchmarks.claims.claim import BESIDE, VERDICTS, Claim, verdict
from gbnbench.benchmarks.claims.registry import CLAIMS
from gbnbench.benchmarks.claims.run import Table, read
from gbnbench.core.atomic_write import write_whole
from gbnbench.core.errors import InputError
from gbnbench.core.prose_lines import paragraph

HEAD = "head.md"  # how the page begins, a count of verdicts left to be filled in
CRITERIA = "criteria.md"  # how it ends: a list that names claims, which become links
PACKAGE = "gbnbench.benchmarks.claims"
PLACEHOLDER = re.compile(r"\{([A-Za-z0-9.\-]+)\}")


def number(text: str) -> str:
    """Return a cell of the table as the page shows it: three digits."""
    value = float(text)
    return f"{value:.3g}" if math.isfinite(value) else ""


def cell(text: str) -> str:
    """Return words as a table's cell takes them."""
    return text.replace("|", "\\|")


def filled(claim: Claim, table: Table) -> str:
    """Return a claim's note with the measured numbers in it.

    Parameters
    ----------
    claim : Claim
        The claim.
    table : Table
        The measured rows.

    Returns
    -------
    str

    Raises
    ------
    InputError
        If the note names a row that the table does not have.
    """

    def measured(match: re.Match[str]) -> str:
        name = match[1]
        other, _, row = name.partition(".")
        for owner, wanted in ((claim.name, name), (other, row)):
            for cells in table.get(owner, ()):
                if cells["row"] == wanted:
                    return number(cells["measured"])
        raise InputError(f"the note of {claim.name} names {name!r}; no such row was measured")

    return PLACEHOLDER.sub(measured, claim.note)


def of_claim(name: str, table: Table) -> str:
    """Return a claim's verdict, or say that it was not measured.

    Parameters
    ----------
    name : str
        The claim's name.
    table : Table
        The measured rows.

    Returns
    -------
    str
    """
    return verdict(cells["holds"] for cells in table[name]) if name in table else "not measured"


def line(cells: dict[str, str]) -> str:
    """Return one row of a claim's table."""
    value = number(cells["measured"])
    if value and number(cells["standard_error"]):
        value += f" ± {float(cells['standard_error']):.1g}"
    size = ", ".join(
        f"{letter} = {int(cells[name]):,}" for letter, name in (("n", "n"), ("d", "d")) if cells[name] != "0"
    )
    sets = f"{cells['sets']} x " if cells["sets"] != "0" else ""
    holds = "" if cells["holds"] == BESIDE else cells["holds"]
    return f"| {cell(cells['quantity'])} | {cell(cells['paper'])} | {value} | {sets}{size} | {holds} |"


def section(claim: Claim, table: Table) -> Iterator[str]:
    """Yield the lines of the page that are about one claim.

    Parameters
    ----------
    claim : Claim
        The claim.
    table : Table
        The measured rows.

    Returns
    -------
    iterator of str
    """
    yield f"### `{claim.name}`: {of_claim(claim.name, table)}\n"
    yield paragraph(f"{claim.says} ({claim.place})", "> ") + "\n"
    if claim.name in table:
        yield "| measured | paper | value | sets | holds |"
        yield "|---|---|--:|---|---|"
        yield from (line(cells) for cells in table[claim.name])
        yield ""
        if claim.note:
            yield paragraph(filled(claim, table)) + "\n"


def page(table: Table) -> str:
    """Return the whole page."""
    verdicts = [of_claim(claim.name, table) for claim in CLAIMS]
    words = {"yes": "hold", "partly": "hold in part", "no": "do not", VERDICTS[-1]: "cannot be tried here"}
    counts = f"Of {len(CLAIMS)}, " + ", ".join(f"{verdicts.count(v)} {words[v]}" for v in VERDICTS)
    lines = [
        _text(HEAD).format(counts=counts),
        "| claim | place | the paper states | holds |",
        "|---|---|---|---|",
    ]
    lines += [
        f"| [`{claim.name}`](#{anchor(claim, found)}) | {claim.place} | {cell(claim.says)} | {found} |"
        for claim, found in zip(CLAIMS, verdicts, strict=True)
    ]
    subject = ""
    for claim in CLAIMS:
        if claim.subject != subject:
            subject = claim.subject
            lines.append(f"\n## {subject}\n")
        lines += section(claim, table)
    links = {
        claim.name: f"[`{claim.name}`](#{anchor(claim, found)})"
        for claim, found in zip(CLAIMS, verdicts, strict=True)
    }
    lines.append(re.sub(r"^- `([^`]+)`", lambda match: f"- {links[match[1]]}", _text(CRITERIA), flags=re.M))
    return "\n".join(lines).rstrip() + "\n"


def _text(name: str) -> str:
    return resources.files(PACKAGE).joinpath(name).read_text(encoding="utf-8")


def anchor(claim: Claim, found: str) -> str:
    """Return the address that a heading gets: in lower case, its marks left out.

    Parameters
    ----------
    claim : Claim
        The claim.
    found : str
        Its verdict, which stands in the heading.

    Returns
    -------
    str
    """
    return f"{claim.name}-{found.replace(' ', '-')}"


def main(arguments: Sequence[str]) -> None:
    """Write the page of one table."""
    source, target = map(Path, arguments)
    write_whole(target, page(read(source)).encode())


if __name__ == "__main__":
    main(sys.argv[1:])
