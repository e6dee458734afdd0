/* Tables of cos and sin of 2 pi f.x for a group's frequencies and a chunk of points, packed for product.cl.
 *
 * Frequencies stand in tiles of some width; a tile holds, point after point, so many cosines and then as many sines,
 * so that the product reads every table from end to end. One work-item takes LANES points: it finds the cosine and
 * sine of every factor by its exact phase, then each frequency as the complex product of its factors (digits.cl),
 * which costs a tenth of a sine and cosine of its own and rounds by half a unit more. A tile is length points long,
 * a multiple of LANES; what stands there beyond the last point is never read.
 */
__kernel void tables(__global const ushort *factor, __global const TURN *multiple, __global const uint *axis,
                     const uint factors, const uint entries, __global const TURN *x, __global REAL *table,
                     const uint width, const uint stride, const ulong n, const ulong begin, const uint length)
{
    const uint k = get_global_id(0) * LANES;
    if (k >= length) return;
    REALV cosine[ENTRIES], sine[ENTRIES];
    for (uint e = 0; e < entries; e++)
        cos_sin_of_turn(multiple[e] * LOADV_TURNS(x, axis[e] * n + begin + k), &cosine[e], &sine[e]);
    uint row = 0;
    __global REAL *tile = table + (ulong)k * 2 * width;
    for (uint j = 0; j < stride; j++) {
        REALV c = (REALV)1, s = (REALV)0;
        if (factors > 0) {
            c = cosine[factor[j]];
            s = sine[factor[j]];
        }
        for (uint g = 1; g < factors; g++) {
            const uint e = factor[g * stride + j];
            const REALV t = c * cosine[e] - s * sine[e];
            s = s * cosine[e] + c * sine[e];
            c = t;
        }
        SPREAD(c, tile + row, 2 * width);
        SPREAD(s, tile + width + row, 2 * width);
        if (++row == width) {
            row = 0;
            tile += (ulong)length * 2 * width;
        }
    }
}
