"""The directive ``modules``: a section for each module whose name matches, written from its docstrings.

``.. modules:: gbnbench.generators.* gbnbench.studies.comparison`` finds modules by name, in the order
given, so that a new one is in the reference as soon as its file is there.
"""

from __future__ import annotations

import fnmatch
import pkgutil
from functools import cache

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

import gbnbench


@cache
def _all() -> tuple[str, ...]:
    """Names of every module and package of gbnbench, in order; packages end with a dot."""
    found = pkgutil.walk_packages(gbnbench.__path__, "gbnbench.")
    return tuple(sorted(module.name + "." * module.ispkg for module in found))


def _matches(name: str, pattern: str) -> bool:
    """Whether each part between dots matches; a star reaches over no dot, and packages must be named."""
    parts, patterns = name.rstrip(".").split("."), pattern.split(".")
    if name.endswith("."):
        return parts == patterns
    return len(parts) == len(patterns) and all(map(fnmatch.fnmatchcase, parts, patterns))


class Modules(SphinxDirective):
    """Sections of modules; ``:exclude:`` names members, ``:without:`` modules that stand elsewhere."""

    required_arguments = 1
    final_argument_whitespace = True
    option_spec = {"exclude": str, "without": str}  # noqa: RUF012

    def run(self) -> list[nodes.Node]:
        """Write the sections and parse them."""
        without = self.options.get("without", "").split()
        names = [
            name.rstrip(".")
            for pattern in self.arguments[0].split()
            for name in _all()
            if _matches(name, pattern) and name not in without
        ]
        exclude = self.options.get("exclude", "")
        lines = []
        for name in dict.fromkeys(names):
            lines += [name, "-" * len(name), "", f".. automodule:: {name}"]
            lines += [f"   :exclude-members: {exclude}"] if exclude else []
            lines.append("")
        return self.parse_text_to_nodes("\n".join(lines), allow_section_headings=True)


def setup(app: Sphinx) -> dict[str, bool]:
    """Add the directive."""
    app.add_directive("modules", Modules)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
