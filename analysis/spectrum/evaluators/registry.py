"""Registry of the evaluators of power.

An evaluator is added by one line here. The plan asks each of them, in this order.
"""

from __future__ import annotations

from typing import Literal

from gbnbench.analysis.spectrum.evaluators.cube_product import CubeProduct
from gbnbench.analysis.spectrum.evaluators.direct_sum import DirectSum
from gbnbench.analysis.spectrum.evaluators.gridded.evaluator import GriddedProduct
from gbnbench.analysis.spectrum.evaluators.nufft.evaluator import NonuniformFFT
from gbnbench.analysis.spectrum.evaluators.numpy_product.evaluator import NumpyProduct
from gbnbench.analysis.spectrum.evaluators.protocol import Evaluator
from gbnbench.analysis.spectrum.evaluators.shell_product import ShellProduct

Method = Literal["product", "gridded", "direct", "shells", "numpy", "nufft"]

EVALUATORS: tuple[type[Evaluator], ...] = (
    CubeProduct,
    GriddedProduct,
    DirectSum,
    ShellProduct,
    NumpyProduct,
    NonuniformFFT,
)


def title_of(method: str) -> str:
    """Return a method's name in sentences and tables, such as "two-group product" for "product"."""
    return {kind.method: kind.title for kind in EVALUATORS}[method]
