/* Coordinates as rows of fixed-point turns, rounded to the nearest with ties to even, and how far they were rounded.
 *
 * A coordinate in [0, 1) comes as the bits of its double and is shifted to where the turn's bits stand, so that
 * devices without double have the same turns. Denormals count as 0. What is lost is measured in units of the last
 * bit of a turn: the sum of its absolute values and that of its squares. Beyond the last point rows are 0.
 */
#if LANES == 1
#define BITSV ulong
#define EVERY_BITS(p, step) ((p)[0])
#define TO_TURNV JOIN(convert_, TURN)
#else
#define BITSV JOIN(ulong, LANES)
#define EVERY_BITS(p, step) ((BITSV)(EVERY(p, 0, step)))
#define TO_TURNV JOIN(convert_, TURNV)
#endif
#define ONE_TURN 1011 /* a coordinate is digits * 2^(exponent - 1075), a turn of 64 bits has the unit 2^-64 */

/* The turns of LANES coordinates, and by how many units of its last bit each was rounded. */
INLINE TURNV turns_of(const BITSV bits, REALV *away)
{
    const BITSV none = (BITSV)0, one_turn = (BITSV)ONE_TURN, most = (BITSV)63, exponent = bits >> (ulong)52;
    const BITSV digits = exponent == none ? none : (bits & (ulong)0xfffffffffffff) | (ulong)0x10000000000000;
    const BITSV up = exponent > one_turn ? exponent - one_turn : none;
    BITSV down = exponent < one_turn ? one_turn - exponent : none;
    down = down < most ? down : most; /* by which nothing is left, and less than half a unit is lost */
    BITSV whole = (digits << up) >> down, below = (digits << (ulong)1) << (most - down);
#if DOUBLE
    const BITSV odd = whole & (ulong)1, half_unit = (BITSV)0x8000000000000000;
    *away = real_of_turn(AS_STURNV(below)) * (REAL)5.421010862427522e-20; /* 2^-64 */
    return whole + (below + odd > half_unit ? (BITSV)1 : none);
#else
    whole |= below == none ? none : (BITSV)1;
    *away = TO_REALV(AS_STURNV(TO_TURNV(whole))) * (REAL)2.3283064365386963e-10f; /* 2^-32 */
    return TO_TURNV((whole + (ulong)0x7fffffff + (whole >> (ulong)32 & (ulong)1)) >> (ulong)32);
#endif
}

/* The points from `begin` to `end`, multiples of LANES, of a set of n; what they were rounded is written to `lost`. */
INLINE void write_turns(__global const ulong *x, const uint n, const uint dim, const uint begin, const uint end,
                        const uint stride, __global TURN *rows, __global SUM *lost)
{
    REALV absolute = (REALV)0, square = (REALV)0;
    for (uint k = begin; k < end; k += LANES) {
        for (uint a = 0; a < dim; a++) {
            BITSV bits = (BITSV)0;
            if (k + LANES <= n) {
                bits = EVERY_BITS(x + (ulong)k * dim + a, dim);
            } else {
                ulong some[LANES];
                for (uint l = 0; l < LANES; l++)
                    some[l] = k + l < n ? x[(ulong)(k + l) * dim + a] : 0;
                bits = EVERY_BITS(some, 1);
            }
            REALV away;
            STOREV_TURNS(turns_of(bits, &away), rows, (ulong)a * stride + k);
            absolute += fabs(away);
            square += away * away;
        }
    }
    lost[0] = SUM_OF(absolute);
    lost[1] = SUM_OF(square);
}

/* One work-item takes `each` points of a set. */
__kernel void turn_rows(__global const ulong *x, const uint sets, const uint n, const uint dim, const uint stride,
                        const uint each, const uint items, __global TURN *rows, __global SUM *lost)
{
    const uint item = get_global_id(0), begin = item * each, set = get_global_id(1);
    if (set >= sets || begin >= stride) return;
    write_turns(x + (ulong)set * n * dim, n, dim, begin, begin + each < stride ? begin + each : stride, stride,
                rows + (ulong)set * dim * stride, lost + ((ulong)set * items + item) * 2);
}
