"""Every claim: its measurement by name here, its words in texts.toml, in the order of the page."""

from __future__ import annotations

import tomllib
from importlib import resources

from gbnbench.benchmarks.claims import (
    adaptive_sets,
    box,
    complexity,
    convergence,
    discrete_methods,
    equations,
    half_space,
    high_dimensions,
    integrals,
    kernel_methods,
    kernels,
    long_descent,
    periodic_kernel,
    profile,
    rival_times,
    spectra,
    steps,
)
from gbnbench.benchmarks.claims.claim import Claim, Measure

PACKAGE = "gbnbench.benchmarks.claims"

MEASURES: dict[str, Measure] = {
    "families": profile.families,
    "fpo-exponent": kernel_methods.farthest_points,
    "kernel-profiles": kernel_methods.profiles,
    "eq-19": profile.profile,
    "eq-7": profile.convention,
    "weight": profile.weight,
    "floor-kernel": kernel_methods.floors,
    "floor-bnot": profile.bnot_floor,
    "below": profile.below,
    "peak": profile.summit,
    "first-dug": convergence.dug,
    "steps-500": convergence.shape,
    "steps-more": convergence.longer,
    "slows": convergence.rate,
    "equivalence": long_descent.equivalence,
    "million": long_descent.million,
    "deterministic": long_descent.repeated,
    "hessian": long_descent.singular,
    "discrete": discrete_methods.discrete,
    "dims-faster": high_dimensions.dimensions,
    "high-d": high_dimensions.high,
    "sigma": kernels.widths,
    "alike": kernels.alike,
    "leak": kernels.leak,
    "truncation": kernels.truncated,
    "support": kernels.support,
    "nearest-image": periodic_kernel.images,
    "eq-22-23": periodic_kernel.series,
    "harmonics": periodic_kernel.harmonics,
    "profiles": periodic_kernel.flat,
    "eq-1": equations.variance,
    "eq-24": box.balance,
    "border": box.border,
    "box-cost": box.box_cost,
    "eq-47": equations.adaptive,
    "fig-8": steps.lowest,
    "freedom": steps.counted,
    "step": steps.step,
    "step-heck": steps.heck,
    "step-high-d": steps.wide,
    "peak-fades": steps.peaks,
    "line": steps.line,
    "neighbours": steps.degrees,
    "annuli": spectra.rings,
    "digits": spectra.digits,
    "random": integrals.random,
    "integration": integrals.best,
    "sigmoid": integrals.sigmoid,
    "prediction": integrals.predicted,
    "beta-alpha": integrals.exponents,
    "half-space": half_space.half_spaces,
    "owen": half_space.owen,
    "quadratic": complexity.by_points,
    "linear-d": complexity.by_dimension,
    "titan": complexity.titan,
    "large": complexity.large,
    "bnot-time": rival_times.times,
    "adaptive": adaptive_sets.adaptive,
}


def _claims() -> tuple[Claim, ...]:
    texts = tomllib.loads(resources.files(PACKAGE).joinpath("texts.toml").read_text(encoding="utf-8"))
    return tuple(
        Claim(name, measure=MEASURES[name], **{key: " ".join(text.split()) for key, text in words.items()})
        for name, words in texts.items()
    )


CLAIMS = _claims()
