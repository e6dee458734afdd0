"""The templates of reports in HTML, and the words and filters that they share."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from importlib import resources
from typing import Any

from jinja2 import Environment, FunctionLoader, StrictUndefined
from markupsafe import Markup

from gbnbench.analysis.measure_definitions import Definition
from gbnbench.core.number_text import NOTHING
from gbnbench.reports import style
from gbnbench.reports.comparison import spectrum, valence
from gbnbench.reports.comparison.table import MARKS, Cell


def template_environment(columns: Sequence[Definition]) -> Environment:
    """Make what renders the templates beside this module; every text in them is escaped.

    Parameters
    ----------
    columns : sequence of Definition
        Of the table of measures.

    Returns
    -------
    jinja2.Environment
    """
    folder = resources.files("gbnbench.reports.html")
    environment = Environment(
        loader=FunctionLoader(lambda name: folder.joinpath(name).read_text(encoding="utf-8")),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.globals.update(
        script=_script,
        columns=columns,
        marks=MARKS,
        nothing=NOTHING,
        dashes=style.DASHES,
        ceiling=f"{spectrum.CEILING:g}",
        degree_colours=valence.DEGREE_COLOURS,
        degree_names=valence.DEGREE_NAMES,
    )
    environment.tests["nan"] = math.isnan
    environment.filters["json_data"] = json_data
    environment.filters["script_number"] = _script_number
    environment.filters["scaled_error"] = _scaled_error
    return environment


def json_data(value: Any) -> Markup:
    """Write JSON for a ``<script>`` element, which no name of a source can close.

    Parameters
    ----------
    value : object
        JSON-ready, without nan.

    Returns
    -------
    Markup
        Every <, > and & in it is written as its number.
    """
    text = json.dumps(value, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    for sign in "<>&\u2028\u2029":
        text = text.replace(sign, f"\\u{ord(sign):04x}")
    return Markup(text)  # noqa: S704 - all that could end the element is gone


def _script(name: str) -> Markup:
    """Return a script beside this module as it stands."""
    return Markup(resources.files("gbnbench.reports.html").joinpath(name).read_text(encoding="utf-8").strip())  # noqa: S704


def _script_number(value: float) -> str:
    """Write a number so that the page's script reads it back."""
    return f"{value!r}" if math.isfinite(value) else ("1e999" if value > 0 else "-1e999")


def _scaled_error(cell: Cell) -> str:
    """Write the standard error with the power of ten of its value."""
    _, mark, exponent = cell.text.partition("e")
    return f"{cell.error_text}e{exponent}" if mark else cell.error_text
