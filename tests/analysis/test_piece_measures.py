"""Sources measured by pieces: the same bits in whatever order they are made, and errors of grouped sets."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gbnbench.analysis.measures import analyse_to_arrays, merged_analysis
from gbnbench.analysis.measuring_plan import MeasuringPlan
from gbnbench.analysis.outcomes import values_of
from gbnbench.analysis.piece_measures import measure_piece
from gbnbench.analysis.radial.anisotropy import anisotropy_db
from gbnbench.analysis.realization_pieces import GROUPS, POINTS, group_size, kept_groups, piece_size, pieces
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.analysis.spectrum.shells import exact_shells
from gbnbench.analysis.standard_errors import jackknife
from gbnbench.core.errors import RefusalError
from gbnbench.io import data_files


@pytest.mark.parametrize("n", [1, 100, 4096, 4097, 10**7])
@pytest.mark.parametrize("realizations", [1, 16, 17, 64, 65, 1000, 100_000])
def test_pieces_cover_the_sets_in_order_and_hold_whole_groups_or_parts_of_one(n: int, realizations: int):
    cut = pieces(n, realizations)
    assert [k for first, count in cut[:99] for k in range(first, first + count)] == list(
        range(min(realizations, sum(count for _, count in cut[:99])))
    )
    assert sum(count for _, count in cut) == realizations
    size, group = piece_size(n), group_size(realizations)
    assert size == 1 or size * n <= POINTS
    assert size % group == 0 or group % size == 0
    assert realizations <= group * kept_groups(realizations) < realizations + group
    assert kept_groups(realizations) <= GROUPS


@pytest.mark.slow
def test_pieces_made_backwards_and_read_from_files_give_the_bits_of_the_whole(tmp_path):
    x = np.random.default_rng(1).random((150, 64, 2))
    plan = MeasuringPlan(64, 2, 150)
    kept = {}
    for first, count in reversed(plan.pieces):
        path = tmp_path / f"{first}.npz"
        path.write_bytes(data_files.to_npz(**measure_piece(x[first : first + count], plan, first)))
        kept[first] = data_files.read_npz(path)
    merged, whole = merged_analysis(plan, [kept[first] for first in sorted(kept)]), analyse_to_arrays(x)
    assert repr(merged.measures) == repr(whole.measures)
    assert merged.spectrum.power.tobytes() == whole.spectrum.power.tobytes()
    assert merged.radial.power.tobytes() == whole.radial.power.tobytes()
    for name in ("rdf", "valence"):
        for column, values in getattr(merged, name).items():
            assert values.tobytes() == getattr(whole, name)[column].tobytes()
    assert merged.zone_plate.tobytes() == whole.zone_plate.tobytes()
    # Independently: one mean over all sets.
    together = periodogram(x, whole.spectrum.fmax)
    np.testing.assert_allclose(whole.spectrum.power, together.power, rtol=1e-12)


@pytest.mark.parametrize("sets", [40, 150])
def test_the_error_of_anisotropy_is_that_of_leaving_out_groups(sets):
    x = np.random.default_rng(2).random((sets, 24, 2))
    found = analyse_to_arrays(x).measures
    fmax, group, spacing = 10, group_size(sets), 24**-0.5
    shells = exact_shells(fmax, 2)
    powers = np.array([periodogram(one, fmax).power for one in x])
    left_out = [
        anisotropy_db(np.delete(powers, np.s_[k : k + group], 0).mean(axis=0), shells, sets - group, spacing)
        for k in range(0, sets - group + 1, group)
    ]
    error = (sets - group) / math.sqrt(group * sets) * np.std(left_out, ddof=1)
    assert found.standard_error["anisotropy_db"] == pytest.approx(error, rel=1e-9)
    assert found["anisotropy_db"] == pytest.approx(
        anisotropy_db(powers.mean(axis=0), shells, sets, spacing), rel=1e-9
    )


def test_the_jackknife_over_groups_of_a_mean_is_the_error_of_their_means():
    values = np.random.default_rng(3).random(40)
    groups = values.reshape(8, 5).sum(axis=1)
    others = [[(values.sum() - total) / 35] for total in groups]
    ((_, error),) = jackknife([values.mean()], others, 40, 5)
    assert error == pytest.approx(np.std(groups / 5, ddof=1) / math.sqrt(8), rel=1e-12)


@pytest.mark.slow
def test_a_refusal_in_one_piece_is_that_of_the_source():
    x = np.random.default_rng(4).random((40, 12, 2))
    x[35, 3] = x[35, 7]
    found = analyse_to_arrays(x)
    assert "coincide" in found.measures.reasons["psi6"]
    assert found.valence is None
    assert found.measures["min_distance"] == pytest.approx(
        np.mean([analyse_to_arrays(one).measures["min_distance"] for one in x])
    )


@pytest.mark.slow
def test_frequencies_beyond_the_cube_are_evaluated_by_every_piece_or_by_none():
    x = np.random.default_rng(5).random((18, 100, 7))
    plan = MeasuringPlan(100, 7, 18, curves=False)
    made = [measure_piece(x[first : first + count], plan, first) for first, count in plan.pieces]
    assert len({frozenset(piece) for piece in made}) == 1
    with pytest.raises(RefusalError, match="plane"):
        values_of([piece["psa"] for piece in made])
