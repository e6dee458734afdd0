"""All measures of one source: spectra, curves, pictures and scalars with standard errors."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeVar

from numpy.typing import ArrayLike, NDArray

from gbnbench.analysis.mean_curves import mean_rdf, mean_valence
from gbnbench.analysis.measuring_plan import MeasuringPlan
from gbnbench.analysis.outcomes import Arrays
from gbnbench.analysis.piece_measures import Progress, measure_piece
from gbnbench.analysis.radial.border_warning import border_warnings
from gbnbench.analysis.scalars import Scalars
from gbnbench.core.errors import RefusalError
from gbnbench.core.results.measures import Measures
from gbnbench.core.results.radial import RadialPower
from gbnbench.core.results.spectrum import Spectrum
from gbnbench.core.sides import as_sides
from gbnbench.core.torus import FloatArray, as_realizations
from gbnbench.opencl import use_device

if TYPE_CHECKING:
    import pandas as pd

Result = TypeVar("Result")


@dataclass(frozen=True)
class Analysis:
    """Everything measured of the sets of one source.

    Attributes
    ----------
    spectrum : Spectrum
        Mean over the realizations.
    radial : RadialPower
        Its exact shells; where the sides are unequal, neighbouring ones are pooled (``box_shells.pooled``).
    anisotropy : DataFrame
        A row a ring: frequency, nu, anisotropy_db, psa_db.
    rdf : DataFrame or None
        Columns r, g; None where it is undefined.
    valence : DataFrame or None
        Columns degree, share; None where it is undefined.
    zone_plate : (pixels, pixels) float64 or None
        Of the first set; None for d != 2.
    measures : Measures
        The scalars.
    warnings : tuple of str
        What to know before trusting a number.
    """

    spectrum: Spectrum
    radial: RadialPower
    anisotropy: pd.DataFrame
    rdf: pd.DataFrame | None
    valence: pd.DataFrame | None
    zone_plate: FloatArray | None
    measures: Measures
    warnings: tuple[str, ...]


@dataclass(frozen=True)
class AnalysisArrays:
    """An ``Analysis`` whose curves are not tables yet, as a process measures it that does not load pandas."""

    spectrum: Spectrum
    radial: RadialPower
    anisotropy: dict[str, NDArray[Any]]
    rdf: dict[str, NDArray[Any]] | None
    valence: dict[str, NDArray[Any]] | None
    zone_plate: FloatArray | None
    measures: Measures
    warnings: tuple[str, ...]

    def analysis(self) -> Analysis:
        """Return it with tables."""
        import pandas as pd

        tables = {
            "anisotropy": pd.DataFrame(self.anisotropy),
            "rdf": None if self.rdf is None else pd.DataFrame(self.rdf),
            "valence": None if self.valence is None else pd.DataFrame(self.valence),
        }
        return Analysis(**{**vars(self), **tables})


def measures(
    x: ArrayLike,
    fmax: int | None = None,
    *,
    sides: ArrayLike | None = None,
    progress: Progress | None = None,
    device: str | None = None,
) -> Measures:
    """Compute every scalar measure of one or several sets.

    Parameters
    ----------
    x : (n, d) or (realizations, n, d) array_like
        Points on the unit torus. Spatial measures and evacuated energy are means over the sets, the others
        are of the mean spectrum.
    fmax : int, optional
        Largest harmonic on each axis, or |k| for unequal sides; by default as far as nu = 2, or as affordable
        (``default_fmax``). Where a cube of frequencies is not, as in d = 20, exact shells are taken as far as
        they go.
    sides : (d,) array_like, optional
        Lengths of the torus's sides in any unit, whose ratios count; a cube if not given. Lengths and |k| are
        then those of the rectangle or box, in units of its volume^(1/d); discrepancies do not change.
    progress : callable, optional
        Called with the name of a stage and the share of it that is done, of sets of more than 2^20 points.
    device : str, optional
        Part of the name of the OpenCL device, or its position, as in ``GBNBENCH_DEVICE``, which it overrides.

    Returns
    -------
    Measures
        Every name of ``DEFINITIONS``; nan where undefined, with the reason in ``reasons``. ``standard_error``
        is over realizations: the standard deviation of the mean, or the jackknife's where the measure is of
        the mean spectrum (for the peak, a maximum, that errs on the large side).

    Raises
    ------
    InputError
        If x is not points of the unit torus, fmax is no harmonic that can be evaluated, or sides are not d
        lengths.
    DeviceError
        If a device is named and fits none or several.

    Notes
    -----
    ``gbnbench.analysis.measure_definitions.DEFINITIONS`` says what each measure is and whose definition it
    follows; formulas stand with the functions of ``gbnbench.analysis.radial`` and ``.spatial``.

    Sets of more than a million points are measured in parts, and may stay in their file:
    ``measures(numpy.load(FILE, mmap_mode="r"))``. ``gbnbench.analysis.measuring_cost`` tells beforehand what
    that takes, and what is left out.

    Examples
    --------
    >>> import gbnbench
    >>> m = measures(gbnbench.generate("jittered", n=64, seed=1, realizations=4))
    >>> 0 < m["noise_floor"] < 1 and m.standard_error["noise_floor"] > 0
    True
    >>> measures(gbnbench.generate("random", n=64, d=3, seed=1)).reasons["psi6"]
    'psi6 is defined in the plane; got d=3'

    The hexagonal lattice is the lattice it is in a rectangle of sqrt(3) by 1:

    >>> m = measures([[0.0, 0.0], [0.5, 0.5]], sides=(3**0.5, 1))
    >>> round(m["psi6"], 9), round(m["min_distance"], 9)
    (1.0, 1.0)
    """
    points = as_realizations(x)
    with use_device(device):
        plan = _plan(points, fmax, sides, curves=False)
        return Scalars(plan, _pieces(points, plan, progress)).measures()


def analyse(x: ArrayLike, fmax: int | None = None, sides: ArrayLike | None = None) -> Analysis:
    """Measure everything of one or several sets, curves and pictures included.

    Parameters
    ----------
    x : (n, d) or (realizations, n, d) array_like
        Points on the unit torus.
    fmax : int, optional
        Largest harmonic on each axis, or |k| for unequal sides; by default that of ``measures``.
    sides : (d,) array_like, optional
        Lengths of the torus's sides, whose ratios count; a cube if not given.

    Returns
    -------
    Analysis
        None stands for each curve or picture that means nothing for these sets.

    Raises
    ------
    InputError
        As ``measures``.
    """
    return analyse_to_arrays(x, fmax, sides).analysis()


def analyse_to_arrays(
    x: ArrayLike, fmax: int | None = None, sides: ArrayLike | None = None
) -> AnalysisArrays:
    """Measure what ``analyse`` does, without loading pandas.

    Parameters, and what is raised, are those of ``analyse``.
    """
    points = as_realizations(x)
    plan = _plan(points, fmax, sides)
    return merged_analysis(plan, _pieces(points, plan))


def merged_analysis(plan: MeasuringPlan, pieces: Sequence[Arrays]) -> AnalysisArrays:
    """Put together everything that was measured of the pieces of a source.

    Parameters
    ----------
    plan : MeasuringPlan
        Of the source.
    pieces : sequence of mapping
        As ``measure_piece`` returns them, all, in the order of the sets.

    Returns
    -------
    AnalysisArrays
        The same bits wherever and whenever the pieces were made.
    """
    scalars = Scalars(plan, pieces)
    return AnalysisArrays(
        spectrum=scalars.spectrum,
        radial=scalars.radial,
        anisotropy=scalars.anisotropy(),
        rdf=_unless_refused(lambda: mean_rdf(scalars.outcomes("rdf"), plan.realizations)),
        valence=_unless_refused(lambda: mean_valence(scalars.outcomes("valence"), plan.realizations)),
        zone_plate=scalars.zone_plate(),
        measures=scalars.measures(),
        warnings=border_warnings(scalars.spectrum, scalars.radial),
    )


def _plan(
    points: FloatArray, fmax: int | None, sides: ArrayLike | None, *, curves: bool = True
) -> MeasuringPlan:
    realizations, n, d = points.shape
    return MeasuringPlan(n, d, realizations, fmax, as_sides(sides, d), curves)


def _pieces(
    points: FloatArray, plan: MeasuringPlan, progress: Progress | None = None
) -> list[dict[str, NDArray[Any]]]:
    return [measure_piece(points[k : k + count], plan, k, progress) for k, count in plan.pieces]


def _unless_refused(compute: Callable[[], Result]) -> Result | None:
    """Return the result, or None where the measure means nothing for these sets."""
    try:
        return compute()
    except RefusalError:
        return None
