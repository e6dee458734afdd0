/* Amplitudes F(fa, fb) and F(fa, -fb) from two groups' tables as a real product, tile by tile.
 *
 * With alpha = 2 pi fa.xa and beta = 2 pi fb.xb the four sums over points of cos alpha cos beta, sin sin,
 * sin cos and cos sin give both amplitudes; Hermitian symmetry gives the other two quadrants. One work-item takes
 * ROWS frequencies of the leading group with `each` of the trailing one, no others than those between the row tile's
 * two `bounds`; its lanes are points. It sums SUM_POINTS points a lane in registers, and adds such sums in SUM, with
 * their rounding kept beside them where COMPENSATED. Rows are written out by macro, since an array of accumulators
 * would live in memory. Layout of amplitudes: [slot][row tile][column][row][4], of tables see tables.cl.
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
        ss##r += sa * sb;                                                                        \
        sc##r += sa * cb;                                                                        \
        cs##r += ca * sb;                                                                        \
    }

#define ADD(r) add_up(SUM_OF(cc##r), SUM_OF(ss##r), SUM_OF(sc##r), SUM_OF(cs##r), at + r * 4 * KEPT, started);

#if COMPENSATED
#define KEPT 2
#else
#define KEPT 1
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

static void add_up(const SUM cc, const SUM ss, const SUM sc, const SUM cs, __global SUM *at, const uint started)
{
    put(at, cc - ss, started);
    put(at + 1, sc + cs, started);
    put(at + 2, cc + ss, started);
    put(at + 3, sc - cs, started);
}

__kernel void product(__global const REAL *restrict table, const ulong offset, const ulong slot_size,
                      const uint length, __global const uint *bounds, const uint columns, const uint each,
                      __global SUM *restrict amplitude, const uint again)
{
    const uint tile = get_global_id(1), tiles = get_global_size(1);
    uint j = get_global_id(0) * each;
    uint end = j + each;
    j = j < bounds[2 * tile] ? bounds[2 * tile] : j;
    end = end > bounds[2 * tile + 1] ? bounds[2 * tile + 1] : end;
    if (j >= end) return;
    const uint first = j;
    __global const REAL *slot = table + get_global_id(2) * slot_size;
    __global SUM *out = amplitude + ((ulong)get_global_id(2) * tiles + tile) * columns * (4 * ROWS * KEPT);
    for (uint begin = 0; begin < length; begin += SUM_POINTS * LANES) {
        const uint steps = (length - begin < SUM_POINTS * LANES ? length - begin : SUM_POINTS * LANES) / LANES;
        const uint started = again || begin > 0;
        for (j = first; j < end; j++) {
            __global const REAL *row = slot + ((ulong)tile * length + begin) * (2 * ROWS);
            __global const REAL *column = slot + offset
                + ((ulong)(j / COLUMNS) * length + begin) * (2 * COLUMNS) + j % COLUMNS * (2 * LANES);
            __global SUM *at = out + (ulong)j * (4 * ROWS * KEPT);
            EACH_ROW(CLEAR)
            for (uint k = 0; k < steps; k++) {
                const REALV cb = LOADV(column, 0), sb = LOADV(column, LANES);
                EACH_ROW(MULTIPLY)
                row += 2 * ROWS * LANES;
                column += 2 * COLUMNS * LANES;
            }
            EACH_ROW(ADD)
        }
    }
}
