/* The sums of product.cl for one slot of points after another, in one launch for a CPU.
 *
 * One work-item takes `each` slots. It takes the points of a slot in `runs`, whose turns (turn_rows.cl) and tables
 * (tables.cl) it makes and multiplies at once, with the same functions as the kernels there. It has tables of its own, so small that they
 * stay in the second cache of its core; of the trailing tables all rows are multiplied with `columns_each` columns
 * before the next.
 */
INLINE void sum_slot(__global const ulong *x, const uint n, __global TURN *turns, __global SUM *lost,
                     __global const REAL *weight, const uint stride, const uint dim, const uint weight_stride,
                     __global const TURN *multiple, __global const uint *code, __global const uint *groups,
                     __global REAL *leading, __global REAL *trailing, const uint length, const uint pitch,
                     const uint splits, const uint runs, __global const uint *bounds, const uint tiles,
                     const uint columns, const uint zero_last, const uint columns_each, __global SUM *sums,
                     const uint slot)
{
    const uint set = slot / splits, of_a_run = (length + SUM_POINTS - 1) / SUM_POINTS;
    for (uint run = 0; run < runs; run++) {
        const uint item = run * splits + slot % splits;
        write_turns(x + (ulong)set * n * dim, n, dim, item * length, (item + 1) * length, stride,
                    turns + (ulong)set * dim * stride, lost + ((ulong)set * runs * splits + item) * 2);
        for (uint which = 0; which < 2; which++) /* one copy of the entries, which may take much of a stack */
            for (uint k = 0; k < length; k += LANES)
                tabulate(turns, weight, stride, dim, weight_stride, multiple, code, groups, leading, 0, trailing, 0,
                         run * splits * length, length, pitch, splits, k, which, slot);
        for (uint first = 0; first < columns; first += columns_each) {
            for (uint tile = 0; tile < tiles; tile++) {
                const uint last = first + columns_each, low = bounds[2 * tile], high = bounds[2 * tile + 1];
                multiply(leading, 0, trailing, 0, pitch, length, columns, zero_last,
                         sums + (ulong)slot * tiles * columns * (ROWS * ROW_SUMS / LANES),
                         run * of_a_run, runs * of_a_run, tiles, tile, 0,
                         first < low ? low : first, last > high ? high : last);
            }
        }
    }
}

__kernel void slot_sums(__global const ulong *x, __global const REAL *weight, const uint slots, const uint n,
                        __global TURN *turns, __global SUM *lost, const uint stride, const uint dim,
                        const uint weight_stride, __global const TURN *multiple,
                        __global const uint *code, __global const uint *groups, __global REAL *leading,
                        const ulong leading_size, __global REAL *trailing, const ulong trailing_size,
                        const uint length, const uint pitch, const uint splits, const uint runs,
                        __global const uint *bounds, const uint tiles, const uint columns,
                        const uint zero_last, const uint columns_each, __global SUM *sums, const uint each)
{
    const uint item = get_global_id(0);
    const uint end = (item + 1) * each < slots ? (item + 1) * each : slots;
    for (uint slot = item * each; slot < end; slot++)
        sum_slot(x, n, turns, lost, weight, stride, dim, weight_stride, multiple, code, groups, leading + item * leading_size,
                 trailing + item * trailing_size, length, pitch, splits, runs, bounds, tiles, columns, zero_last,
                 columns_each, sums, slot);
}
