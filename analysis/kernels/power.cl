/* Power |F|^2 / norm from the sums of product.cl, for a cube or for pairs of a block.
 *
 * A set has `splits` slots, whose sums are added up first. In cube_power one work-item takes `rows_each`
 * rows of the leading group and `each` frequencies of the trailing group. It writes the power at (fa, fb) and
 * (fa, -fb), and at the mirror images of both that lie in the output. Power is also divided by the gain of
 * its row. The leading half space has `half_rows` rows; this launch has `rows` of them, from first_row on.
 * The output begins at the flat index `start` of the cube. Sets stand set_size numbers apart, or are added
 * up where set_size is 0.
 */
/* Where the four sums of row i and column j stand in a slot whose rows are `stride` columns long. */
INLINE ulong place_of(const uint i, const uint j, const uint stride)
{
    return ((ulong)(i / ROWS) * stride + j / LANES * LANES) * (ROWS * ROW_SUMS / LANES) + i % ROWS * ROW_SUMS
        + 2 * (j % LANES);
}

/* One of the four sums, added up over slots. */
INLINE SUM total_of(__global const SUM *at, const ulong slot_size, const uint splits)
{
#if COMPENSATED
    at += 2 * LANES; /* the whole, behind its last part */
#endif
    SUM total = at[0];
    for (uint s = 1; s < splits; s++)
        total += at[s * slot_size];
#if COMPENSATED
    SUM rest = at[2 * LANES];
    for (uint s = 1; s < splits; s++)
        rest += at[s * slot_size + 2 * LANES];
    total += rest;
#endif
    return total;
}

/* Power at (fa, fb) and at (fa, -fb). */
INLINE void two_powers(__global const SUM *at, const ulong slot_size, const uint splits, const SUM norm,
                       SUM *same, SUM *opposite)
{
    const SUM cc = total_of(at, slot_size, splits), cs = total_of(at + 1, slot_size, splits);
    const SUM sc = total_of(at + ROW_SUMS / 2, slot_size, splits);
    const SUM ss = total_of(at + ROW_SUMS / 2 + 1, slot_size, splits);
    *same = ((cc - ss) * (cc - ss) + (sc + cs) * (sc + cs)) / norm;
    *opposite = ((cc + ss) * (cc + ss) + (sc - cs) * (sc - cs)) / norm;
}

/* The frequencies first .. end of a row, of all sets; where `zero_last`, 0 has the last column (product.cl). */
INLINE void write_power(__global const SUM *sums, const uint half_rows, const uint first_row,
                        const uint rows, const uint columns, const uint zero_last, const uint stride,
                        const uint splits, const uint sets, __global const SUM *norm, __global const SUM *gain,
                        const uint first_set, __global SUM *out, const ulong start, const ulong set_size,
                        const uint i, const uint first, const uint end)
{
    const ulong slot_size = (ulong)((rows + ROWS - 1) / ROWS) * stride * (ROWS * ROW_SUMS / LANES);
    const ulong width = 2 * (ulong)columns - 1;
    const ulong last = (2 * (ulong)half_rows - 1) * width - 1;
    const ulong centre = (half_rows - 1 + (ulong)first_row + i) * width + columns - 1;
    for (uint s = 0; s < sets; s++) {
        __global const SUM *of_set = sums + s * splits * slot_size;
        __global SUM *to = out + (first_set + s) * set_size;
        const uint add = set_size == 0 && first_set + s > 0;
        const SUM scale = norm[first_set + s] * gain[first_row + i];
        for (uint j = first; j < end; j++) {
            SUM same, opposite;
            const uint column = !zero_last ? j : j ? j - 1 : columns - 1;
            two_powers(of_set + place_of(i, column, stride), slot_size, splits, scale, &same, &opposite);
            const ulong plus = centre + j, minus = centre - j;
            const SUM there = same + (add ? to[plus - start] : 0);
            const SUM here = opposite + (add ? to[(minus < start ? last - minus : minus) - start] : 0);
            to[plus - start] = there;
            if (last - plus >= start) to[last - plus - start] = there;
            if (minus >= start) to[minus - start] = here;
            if (last - minus >= start) to[last - minus - start] = here;
        }
    }
}

__kernel void cube_power(__global const SUM *sums, __global const SUM *norm, const uint splits, const uint sets,
                         const uint first_set, const uint half_rows, const uint first_row, const uint rows,
                         const uint rows_each, const uint columns, const uint zero_last, const uint stride,
                         const uint each,
                         __global const SUM *gain, __global SUM *out, const ulong start, const ulong set_size)
{
    const uint begin = get_global_id(1) * rows_each, first = get_global_id(0) * each;
    const uint end = first + each < columns ? first + each : columns;
    for (uint i = begin; i < begin + rows_each && i < rows; i++)
        write_power(sums, half_rows, first_row, rows, columns, zero_last, stride, splits, sets, norm, gain,
                    first_set, out, start, set_size, i, first, end);
}

/* Power of a block at (fa, fb) and (fa, -fb), side by side, for the columns within the bounds of a row tile.
 * One work-item takes one row and `each` columns; sets are added up. */
__kernel void pair_power(__global const SUM *sums, __global const uint *bounds, const uint rows,
                         const uint stride, const uint each, const uint splits, const uint sets,
                         __global const SUM *norm, const uint first_set, __global SUM *out)
{
    const uint i = get_global_id(1);
    if (i >= rows) return;
    const uint tile = i / ROWS;
    uint first = get_global_id(0) * each;
    uint end = first + each;
    first = first < bounds[2 * tile] ? bounds[2 * tile] : first;
    end = end > bounds[2 * tile + 1] ? bounds[2 * tile + 1] : end;
    const ulong slot_size = (ulong)((rows + ROWS - 1) / ROWS) * stride * (ROWS * ROW_SUMS / LANES);
    for (uint s = 0; s < sets; s++) {
        __global const SUM *of_set = sums + s * splits * slot_size;
        const SUM scale = norm[first_set + s];
        for (uint j = first; j < end; j++) {
            __global SUM *to = out + ((ulong)i * stride + j) * 2;
            SUM same, opposite;
            two_powers(of_set + place_of(i, j, stride), slot_size, splits, scale, &same, &opposite);
            to[0] = first_set + s ? to[0] + same : same;
            to[1] = first_set + s ? to[1] + opposite : opposite;
        }
    }
}
