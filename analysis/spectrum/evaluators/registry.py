"""Registry of the evaluators of power.

An evaluator is one module of this package, or a subpackage with a module ``evaluator``, and one word in
``Method`` brings it in. The plan asks each of them, in the order of the words.
"""

from __future__ import annotations

from importlib import import_module
from pkgutil import iter_modules
from typing import Literal, get_args

from gbnbench.analysis.spectrum.evaluators.protocol import Evaluator

Method = Literal["product", "gridded", "direct", "shells", "numpy", "nufft", "fft"]

_PACKAGE = __name__.rpartition(".")[0]


def _by_method() -> dict[str, type[Evaluator]]:
    """Import the package's modules, and find the evaluator of each method among their classes."""
    found: dict[str, type[Evaluator]] = {}
    for module in iter_modules(import_module(_PACKAGE).__path__, f"{_PACKAGE}."):
        name = f"{module.name}.evaluator" if module.ispkg else module.name
        if name == __name__:
            continue
        for kind in vars(import_module(name)).values():
            if isinstance(kind, type) and issubclass(kind, Evaluator) and "method" in vars(kind):
                found[kind.method] = kind
    return found


_FOUND = _by_method()
EVALUATORS: tuple[type[Evaluator], ...] = tuple(_FOUND[method] for method in get_args(Method))


def title_of(method: str) -> str:
    """Return a method's name in sentences and tables, such as "two-group product" for "product"."""
    return {kind.method: kind.title for kind in EVALUATORS}[method]
