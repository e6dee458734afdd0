/* Power |F|^2 / norm from the amplitudes of product.cl, for a cube or for pairs of a block.
 *
 * A set has `splits` slots, whose amplitudes are added up first. In cube_power one work-item takes one row
 * of the leading group and `each` frequencies of the trailing group. It writes the power at (fa, fb) and
 * (fa, -fb), and at the mirror images of both that lie in the output. Power is also divided by the gain of
 * its row. The leading half space has `half_rows` rows; this launch has `rows` of them, from first_row on.
 * The output begins at the flat index `start` of the cube. Sets stand set_size numbers apart, or are added
 * up where set_size is 0.
 */
#if COMPENSATED
#define KEPT 2
#else
#define KEPT 1
#endif

static SUM power_of(__global const SUM *at, const ulong slot_size, const uint splits, const SUM norm)
{
    SUM re = at[0], im = at[1];
    for (uint s = 1; s < splits; s++) {
        re += at[s * slot_size];
        im += at[s * slot_size + 1];
    }
#if COMPENSATED
    SUM rest_re = at[4], rest_im = at[5];
    for (uint s = 1; s < splits; s++) {
        rest_re += at[s * slot_size + 4];
        rest_im += at[s * slot_size + 5];
    }
    re += rest_re;
    im += rest_im;
#endif
    return (re * re + im * im) / norm;
}

/* The columns first .. end of a row, of all sets. */
INLINE void write_power(__global const SUM *amplitude, const uint half_rows, const uint first_row,
                        const uint rows, const uint columns, const uint stride, const uint splits,
                        const uint sets, __global const SUM *norm, __global const SUM *gain,
                        const uint first_set, __global SUM *out, const ulong start, const ulong set_size,
                        const uint i, const uint first, const uint end)
{
    const ulong slot_size = (ulong)((rows + ROWS - 1) / ROWS) * stride * (4 * ROWS * KEPT);
    const ulong width = 2 * (ulong)columns - 1;
    const ulong last = (2 * (ulong)half_rows - 1) * width - 1;
    const ulong centre = (half_rows - 1 + (ulong)first_row + i) * width + columns - 1;
    for (uint s = 0; s < sets; s++) {
        __global const SUM *at = amplitude + s * splits * slot_size
            + (ulong)(i / ROWS) * stride * (4 * ROWS * KEPT) + i % ROWS * (4 * KEPT);
        __global SUM *to = out + (first_set + s) * set_size;
        const uint add = set_size == 0 && first_set + s > 0;
        const SUM scale = norm[first_set + s] * gain[first_row + i];
        for (uint j = first; j < end; j++) {
            __global const SUM *here_at = at + (ulong)j * (4 * ROWS * KEPT);
            const SUM same = power_of(here_at, slot_size, splits, scale);
            const SUM opposite = power_of(here_at + 2, slot_size, splits, scale);
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

__kernel void cube_power(__global const SUM *amplitude, const uint half_rows, const uint first_row,
                         const uint rows, const uint columns, const uint stride, const uint each,
                         const uint splits, const uint sets, __global const SUM *norm,
                         __global const SUM *gain, const uint first_set, __global SUM *out,
                         const ulong start, const ulong set_size)
{
    const uint i = get_global_id(1);
    const uint first = get_global_id(0) * each;
    const uint end = first + each < columns ? first + each : columns;
    if (i < rows)
        write_power(amplitude, half_rows, first_row, rows, columns, stride, splits, sets, norm, gain, first_set,
                    out, start, set_size, i, first, end);
}

/* Power of a block at (fa, fb) and (fa, -fb), side by side, for the columns within the bounds of a row tile.
 * One work-item takes one row and `each` columns; sets are added up. */
__kernel void pair_power(__global const SUM *amplitude, __global const uint *bounds, const uint rows,
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
    const ulong slot_size = (ulong)((rows + ROWS - 1) / ROWS) * stride * (4 * ROWS * KEPT);
    for (uint s = 0; s < sets; s++) {
        __global const SUM *at = amplitude + s * splits * slot_size
            + (ulong)tile * stride * (4 * ROWS * KEPT) + i % ROWS * (4 * KEPT);
        const SUM scale = norm[first_set + s];
        for (uint j = first; j < end; j++) {
            __global const SUM *here = at + (ulong)j * (4 * ROWS * KEPT);
            __global SUM *to = out + ((ulong)i * stride + j) * 2;
            const SUM same = power_of(here, slot_size, splits, scale);
            const SUM opposite = power_of(here + 2, slot_size, splits, scale);
            to[0] = first_set + s ? to[0] + same : same;
            to[1] = first_set + s ? to[1] + opposite : opposite;
        }
    }
}
