/* Power of a small cube in one launch: the sums of all slots (slot_sums.cl) and the power, one after another.
 *
 * One work-item does what the work-items of slot_sums.cl and power.cl do, with the same functions and in the same
 * order, so that the power is the same to the last bit. It is for requests whose arithmetic takes less than
 * launches do; their sets fit in one batch.
 */
__kernel void small_cube(__global const ulong *x, __global const REAL *weight, __global const SUM *norm,
                         const uint n, __global TURN *turns, __global SUM *lost, const uint stride,
                         const uint dim, const uint weight_stride,
                         __global const TURN *multiple, __global const uint *code, __global const uint *groups,
                         __global REAL *leading, __global REAL *trailing, const uint length, const uint pitch,
                         const uint splits, const uint runs, __global const uint *bounds, const uint sets,
                         const uint rows, const uint columns, const uint zero_last, __global SUM *sums, __global const SUM *gain,
                         __global SUM *out, const ulong start, const ulong set_size)
{
    const uint stride_of_sums = (columns + LANES - 1) / LANES * LANES, tiles = (rows + ROWS - 1) / ROWS;
    for (uint slot = 0; slot < sets * splits; slot++)
        sum_slot(x, n, turns, lost, weight, stride, dim, weight_stride, multiple, code, groups, leading, trailing, length, pitch,
                 splits, runs, bounds, tiles, stride_of_sums, zero_last, stride_of_sums, sums, slot);
    for (uint i = 0; i < rows; i++)
        write_power(sums, rows, 0, rows, columns, zero_last, stride_of_sums, splits, sets, norm, gain, 0, out, start,
                    set_size, i, 0, columns);
}
