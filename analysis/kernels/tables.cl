/* Tables of cos and sin of 2 pi f.x for a group's frequencies and a chunk of points.
 *
 * One work-item fills LANES frequencies (global id 0) for TABLE_POINTS points (global id 1); row k of a table is
 * point k, contiguous in frequency.
 */
__kernel void tables(__global const TURN *frequency, __global const TURN *x, __global REAL *cosine,
                     __global REAL *sine, const uint stride, const uint dim, const ulong n, const ulong begin,
                     const uint points)
{
    const uint j = get_global_id(0) * LANES;
    if (j >= stride) return;
    const uint first = get_global_id(1) * TABLE_POINTS;
    const uint last = min(first + TABLE_POINTS, points);
    for (uint k = first; k < last; k++) {
        TURNV phase = (TURNV)0;
        for (uint a = 0; a < dim; a++)
            phase += LOADV_TURNS(frequency, a * stride + j) * x[a * n + begin + k];
        REALV c, s;
        cos_sin_of_turn(phase, &c, &s);
        STOREV(c, cosine, (ulong)k * stride + j);
        STOREV(s, sine, (ulong)k * stride + j);
    }
}
