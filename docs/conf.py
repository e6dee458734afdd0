"""Sphinx: the pages and the reference, from docstrings and from the command itself, as one site."""

import logging
import os
import re
import sys
import tempfile
from pathlib import Path

from numpydoc import xref
from sphinx.application import Sphinx

sys.path.insert(0, str(Path(__file__).parent / "extensions"))

from gbnbench import __version__

project = "gbnbench"
author = "the gbnbench authors"
project_copyright = "the gbnbench authors, MIT licence"
version = release = __version__

extensions = [
    "formulas",
    "modules",
    "myst_nb",
    "numpydoc",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx_click",
    "sphinx_gallery.gen_gallery",
]
# The tutorial's kernel serves this build alone: that its sockets are not encrypted is no news.
_IPYTHON = tempfile.TemporaryDirectory()
_PROFILE = Path(_IPYTHON.name, "profile_default")
_PROFILE.mkdir()
(_PROFILE / "ipython_kernel_config.py").write_text("c.IPKernelApp.log_level = 'ERROR'\n")
os.environ["IPYTHONDIR"] = _IPYTHON.name

smartquotes = False  # two hyphens before an option are two hyphens
exclude_patterns = ["extensions", "examples", "gallery/*.ipynb", "sg_execution_times.rst"]

# The examples run in every build, and one that fails ends it. What other packages log there is no warning.
for package in ("MDAnalysis", "freud"):
    logging.getLogger(package).setLevel(logging.ERROR)
sphinx_gallery_conf = {
    "examples_dirs": ["examples"],
    "gallery_dirs": ["gallery"],
    "abort_on_example_error": True,
    "capture_repr": (),
    "download_all_examples": False,
    "min_reported_time": 3600,
    "show_memory": False,
    "show_signature": False,
    "write_computation_times": False,
}

myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 3
nb_execution_mode = "force"
nb_execution_raise_on_error = True
nb_execution_timeout = 300
nb_merge_streams = True

# Types are said in docstrings, with shapes, and nowhere else: "(n, d) or (realizations, n, d) float64" is set
# as it stands. Only the names below become links.
autodoc_typehints = "none"
autodoc_member_order = "bysource"
autodoc_preserve_defaults = True
autodoc_default_options = {"members": True, "special-members": "__call__"}
autosummary_generate = False
numpydoc_show_class_members = False
numpydoc_xref_param_type = True
numpydoc_xref_ignore = "all"
xref.DEFAULT_LINKS.clear()  # these lead to other projects' sites
numpydoc_xref_aliases = {
    "DeviceError": "gbnbench.core.errors.DeviceError",
    "FormatError": "gbnbench.core.errors.FormatError",
    "GbnbenchError": "gbnbench.GbnbenchError",
    "InputError": "gbnbench.core.errors.InputError",
    "Measures": "gbnbench.core.results.measures.Measures",
    "SpectrumPlan": "gbnbench.SpectrumPlan",
    "RadialPower": "gbnbench.core.results.radial.RadialPower",
    "RefusalError": "gbnbench.core.errors.RefusalError",
    "ShellSpectrum": "gbnbench.ShellSpectrum",
    "Spectrum": "gbnbench.Spectrum",
    "Monitor": "gbnbench.generators.monitor.Monitor",
}
nitpicky = True
toc_object_entries_show_parents = "hide"

html_theme = "furo"
html_title = f"gbnbench {release}"
html_math_renderer = "drawings"
html_static_path = ["static"]
html_css_files = ["pages.css"]
html_show_sphinx = False


def _escape_bars(lines: list[str]) -> None:
    """Let |f| be what it says in plain text, not reStructuredText's mark of a substitution."""
    for k, line in enumerate(lines):
        if not line.lstrip().startswith((">>>", "...")):
            parts = re.split(r"(``.*?``)", line)
            lines[k] = "".join(part if i % 2 else part.replace("|", r"\|") for i, part in enumerate(parts))


def _set_examples(lines: list[str]) -> None:
    """Set the paragraphs that the command's help keeps as they are, sphinx-click's line blocks, as code."""
    for k in range(len(lines) - 1, -1, -1):
        lines[k] = re.sub(r"(?:Posix|Windows)Path\('(.*?)'\)", r"\1", lines[k])
        if lines[k].startswith("| "):
            lines[k] = "   " + lines[k][2:]
            if k == 0 or not lines[k - 1].startswith("| "):
                lines[k:k] = ["", ".. code-block:: text", ""]


def _is_imported(what: str, member: object) -> bool | None:
    """Whether a module has a member from elsewhere: True leaves it out before its docstring is looked at."""
    return True if what == "module" and not getattr(member, "__module__", "").startswith("gbnbench") else None


def _signature(what: str, signature: str | None) -> tuple[str, None] | None:
    """Leave out what a protocol is called with, which says nothing."""
    return ("", None) if what == "class" and signature == "(*args, **kwargs)" else None


def _lead_out(app: Sphinx, docname: str, content: list[str]) -> None:
    """Make of a link out of this folder, which leads on in the repository, the file; to a folder, text."""
    place = Path(app.env.doc2path(docname)).parent

    def given(link: re.Match[str]) -> str:
        if (place / link[2]).is_dir():
            return link[1]
        return f"[{link[1]}](path:{link[2]})" if link[2].endswith(".md") else link[0]

    content[0] = re.sub(r"(?<!!)\[([^\]]*)\]\((\.\./[^)#\s]*)(?:#[^)]*)?\)", given, content[0])


def setup(app: Sphinx) -> None:
    """Hold docstrings and the command's help to plain text, and the contents to the pages there are."""
    app.connect("source-read", _lead_out)
    app.connect("autodoc-skip-member", lambda *event: _is_imported(event[1], event[3]))
    app.connect("autodoc-process-signature", lambda *event: _signature(event[1], event[5]))
    # After numpydoc, whose sections are reStructuredText by then.
    app.connect("autodoc-process-docstring", lambda *event: _escape_bars(event[-1]), priority=900)
    for part in ("description", "options", "arguments", "epilog"):
        app.connect(f"sphinx-click-process-{part}", lambda *event: _set_examples(event[-1]), priority=400)
        app.connect(f"sphinx-click-process-{part}", lambda *event: _escape_bars(event[-1]))
