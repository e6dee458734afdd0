/* Sum of waves at points: sum over waves of cos 2 pi (f.x + phase).
 *
 * Points, [axis][point], and phases are turns, and frequencies are whole numbers, so f.x mod 1 is exact.
 * Frequencies are [wave][axis], negative ones as their two's complement. One work-item takes LANES points.
 * Needs vector.cl and turns.cl.
 */
__kernel void waves(__global const TURN *restrict x, const uint stride,
                    __global const TURN *restrict frequency, __global const TURN *restrict phase,
                    const uint count, __global REAL *restrict out)
{
    const uint k = get_global_id(0) * LANES;
    if (k >= stride) return;
    TURNV at[DIM];
    for (uint a = 0; a < DIM; a++)
        at[a] = LOADV_TURNS(x, (ulong)a * stride + k);
    REALV total = (REALV)0;
    for (uint j = 0; j < count; j++) {
        TURNV turn = (TURNV)phase[j];
        for (uint a = 0; a < DIM; a++)
            turn += frequency[j * DIM + a] * at[a];
        REALV cosine, sine;
        cos_sin_of_turn(turn, &cosine, &sine);
        total += cosine;
    }
    STOREV(total, out, k);
}
