/* Power of a small cube in one launch: the tables, the product and the power one after another.
 *
 * One work-item does what the work-items of tables.cl, product.cl and power.cl do, with the same functions and
 * in the same order, so that the power is the same to the last bit. It is for requests whose arithmetic takes
 * less than launches do; their points fit in one launch, and their sets in one batch.
 */
__kernel void small_cube(__global const TURN *x, __global const REAL *weight, __global const SUM *norm,
                         const uint stride, const uint dim, const uint weight_stride,
                         __global const TURN *multiple, __global const uint *code, __global const uint *groups,
                         __global REAL *leading, const ulong leading_size, __global REAL *trailing,
                         const ulong trailing_size, const uint length, const uint pitch, const uint splits, const uint sets,
                         const uint rows, const uint columns, __global SUM *amplitude,
                         __global const SUM *gain, __global SUM *out, const ulong start, const ulong set_size)
{
    const uint tiles = (rows + ROWS - 1) / ROWS;
    for (uint slot = 0; slot < sets * splits; slot++) {
        for (uint which = 0; which < 2; which++)
            for (uint k = 0; k < length; k += LANES)
                tabulate(x, weight, stride, dim, weight_stride, multiple, code, groups, leading, leading_size,
                         trailing, trailing_size, 0, length, pitch, splits, k, which, slot);
        for (uint begin = 0; begin < length; begin += SUM_POINTS * LANES) {
            const uint end = length - begin < SUM_POINTS * LANES ? length : begin + SUM_POINTS * LANES;
            for (uint tile = 0; tile < tiles; tile++)
                multiply(leading, leading_size, trailing, trailing_size, pitch, begin, end, columns, amplitude,
                         begin > 0, tiles, tile, slot, 0, columns);
        }
    }
    for (uint i = 0; i < rows; i++)
        write_power(amplitude, rows, 0, rows, columns, columns, splits, sets, norm, gain, 0, out, start, set_size,
                    i, 0, columns);
}
