/* Amplitudes F(fa, fb) and F(fa, -fb) from the tables of two groups, as a real product in tiles.
 *
 * With alpha = 2 pi fa.xa and beta = 2 pi fb.xb both follow from four sums over points: cos alpha cos beta,
 * sin alpha sin beta, sin alpha cos beta and cos alpha sin beta. F(-f) is its conjugate.
 *
 * One work-item takes ROWS frequencies of the leading group and `each` of the trailing one, of those within
 * the two `bounds` of the row tile; its lanes are points. It sums SUM_POINTS points a lane in registers, and
 * adds up these sums in SUM. Where COMPENSATED, the rounding of those additions is kept beside the sums.
 * Rows are written out by macros, since an array of accumulators would lie in memory.
 * Layout of amplitudes: [slot][row tile][column][row][4]; that of tables stands in tables.cl.
 *
 * Where FOLDED, points are the nodes m = 0 .. M/2 of a grid, and a column has four parts (spread.cl): the
 * sums of the cosines and of the sines that were carried to m and to M - m, which are multiplied with cos
 * alpha, and their differences, which are multiplied with sin alpha.
 */
#if ROWS == 2
#define EACH_ROW(DO) DO(0) DO(1)
#elif ROWS == 3
#define EACH_ROW(DO) DO(0) DO(1) DO(2)
#elif ROWS == 4
#define EACH_ROW(DO) DO(0) DO(1) DO(2) DO(3)
#endif

#define CLEAR(r) REALV cc##r = (REALV)0, ss##r = (REALV)0, sc##r = (REALV)0, cs##r = (REALV)0;

#define MULTIPLY(r)                                                                              \
    {                                                                                            \
        const REALV ca = LOADV(row, 2 * LANES * r), sa = LOADV(row, 2 * LANES * r + LANES);      \
        cc##r += ca * cb;                                                                        \
        ss##r += sa * so;                                                                        \
        sc##r += sa * co;                                                                        \
        cs##r += ca * sb;                                                                        \
    }

#define ADD(r) add_up(SUM_OF(cc##r), SUM_OF(ss##r), SUM_OF(sc##r), SUM_OF(cs##r), at + r * 4 * KEPT, started);

#if COMPENSATED
#define KEPT 2
#else
#define KEPT 1
#endif
#if FOLDED
#define PARTS 4
#else
#define PARTS 2
#endif

static void put(__global SUM *at, const SUM value, const uint started)
{
#if COMPENSATED
    const SUM old = started ? at[0] : 0, rest = started ? at[4] : 0;
    const SUM sum = old + value;
    const SUM part = sum - old;
    at[0] = sum;
    at[4] = rest + ((old - (sum - part)) + (value - part));
#else
    at[0] = started ? at[0] + value : value;
#endif
}

static void add_up(const SUM cc, const SUM ss, const SUM sc, const SUM cs, __global SUM *at,
                   const uint started)
{
    put(at, cc - ss, started);
    put(at + 1, sc + cs, started);
    put(at + 2, cc + ss, started);
    put(at + 3, sc - cs, started);
}

/* The columns first .. end of a row tile, at the points from .. to of a slot. */
INLINE void multiply(__global const REAL *restrict leading, const ulong leading_size,
                     __global const REAL *restrict trailing, const ulong trailing_size, const uint length,
                     const uint from, const uint to, const uint columns, __global SUM *restrict amplitude,
                     const uint again, const uint tiles, const uint tile, const ulong slot, const uint first,
                     const uint end)
{
    __global const REAL *row_slot = leading + slot * leading_size;
    __global const REAL *column_slot = trailing + slot * trailing_size;
    __global SUM *out = amplitude + ((ulong)slot * tiles + tile) * columns * (4 * ROWS * KEPT);
    for (uint begin = from; begin < to; begin += SUM_POINTS * LANES) {
        const uint steps = (to - begin < SUM_POINTS * LANES ? to - begin : SUM_POINTS * LANES) / LANES;
        const uint started = again || begin > 0;
        for (uint j = first; j < end; j++) {
            __global const REAL *row = row_slot + ((ulong)tile * length + begin) * (2 * ROWS);
            __global const REAL *column = column_slot
                + ((ulong)(j / COLUMNS) * length + begin) * (PARTS * COLUMNS) + j % COLUMNS * (PARTS * LANES);
            __global SUM *at = out + (ulong)j * (4 * ROWS * KEPT);
            EACH_ROW(CLEAR)
            for (uint k = 0; k < steps; k++) {
                const REALV cb = LOADV(column, 0), sb = LOADV(column, LANES);
#if FOLDED
                const REALV co = LOADV(column, 2 * LANES), so = LOADV(column, 3 * LANES);
#else
                const REALV co = cb, so = sb;
#endif
                EACH_ROW(MULTIPLY)
                row += 2 * ROWS * LANES;
                column += PARTS * COLUMNS * LANES;
            }
            EACH_ROW(ADD)
        }
    }
}

__kernel void product(__global const REAL *restrict leading, const ulong leading_size,
                      __global const REAL *restrict trailing, const ulong trailing_size, const uint length,
                      const uint from, const uint to, __global const uint *bounds, const uint columns,
                      const uint each, __global SUM *restrict amplitude, const uint again)
{
#if COLUMNS == 1 /* one work-item after another takes the same columns, which then stay in cache */
    const uint tile = get_global_id(0), tiles = get_global_size(0);
    uint j = get_global_id(1) * each;
#else /* a work-group's columns lie side by side */
    const uint tile = get_global_id(1), tiles = get_global_size(1);
    uint j = get_global_id(0) * each;
#endif
    uint end = j + each;
    j = j < bounds[2 * tile] ? bounds[2 * tile] : j;
    end = end > bounds[2 * tile + 1] ? bounds[2 * tile + 1] : end;
    if (j < end)
        multiply(leading, leading_size, trailing, trailing_size, length, from, to, columns, amplitude, again,
                 tiles, tile, get_global_id(2), j, end);
}
