/* Amplitudes F(fa, fb) and F(fa, -fb) from the tables of two groups, as a real product in tiles.
 *
 * With alpha = 2 pi fa.xa and beta = 2 pi fb.xb both follow from four sums over points: cos alpha cos beta,
 * sin alpha sin beta, sin alpha cos beta and cos alpha sin beta. F(-f) is its conjugate.
 *
 * One work-item takes `tiles_each` tiles of ROWS frequencies of the leading group and `each` frequencies of the
 * trailing one, of those within the two `bounds` of a row tile; its lanes are points. It sums SUM_POINTS points
 * a lane in registers, for one column, or for two where there are 32 registers (PAIRED), adds up the lanes
 * (lane_sums.cl), and adds up these sums in SUM, before it goes on to the next points, so that the tables of so
 * many points stay in cache. Where COMPENSATED, the rounding of the last additions is kept beside the sums.
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

#if FOLDED
#define PARTS 4
#else
#define PARTS 2
#endif
#define PAIRED (LANES * TURN_BITS == 512 && !FOLDED)

/* The sums of row r and column c, a or b. */
#define CLEAR_ONE(r, c) REALV cc##c##r = (REALV)0, ss##c##r = (REALV)0, sc##c##r = (REALV)0, cs##c##r = (REALV)0;
#define MULTIPLY_ONE(r, c)                                                                       \
    cc##c##r += ca * cb##c;                                                                      \
    ss##c##r += sa * so##c;                                                                      \
    sc##c##r += sa * co##c;                                                                      \
    cs##c##r += ca * sb##c;
#define ADD_ONE(r, c, to)                                                                        \
    add_up(cc##c##r - ss##c##r, sc##c##r + cs##c##r, cc##c##r + ss##c##r, sc##c##r - cs##c##r,   \
           (to) + r * 4 * KEPT, started);

#if PAIRED
#define EACH_COLUMN(DO, r) DO(r, a) DO(r, b)
#else
#define EACH_COLUMN(DO, r) DO(r, a)
#endif
#define CLEAR(r) EACH_COLUMN(CLEAR_ONE, r)
#define MULTIPLY(r)                                                                              \
    {                                                                                            \
        const REALV ca = LOADV(row, 2 * LANES * r), sa = LOADV(row, 2 * LANES * r + LANES);      \
        EACH_COLUMN(MULTIPLY_ONE, r)                                                             \
    }
#define ADD(r) ADD_ONE(r, a, at)
#define ADD_SECOND(r) ADD_ONE(r, b, at + 4 * ROWS * KEPT)

#if FOLDED
#define LOAD(c, p)                                                                               \
    const REALV cb##c = LOADV(p, 0), sb##c = LOADV(p, LANES);                                    \
    const REALV co##c = LOADV(p, 2 * LANES), so##c = LOADV(p, 3 * LANES);
#else
#define LOAD(c, p)                                                                               \
    const REALV cb##c = LOADV(p, 0), sb##c = LOADV(p, LANES);                                    \
    const REALV co##c = cb##c, so##c = sb##c;
#endif

#if COMPENSATED
#define KEPT 2
#else
#define KEPT 1
#endif

INLINE void add_up(const REALV a, const REALV b, const REALV c, const REALV d, __global SUM *at,
                   const uint started)
{
    const SUMS value = FOUR_SUMS(a, b, c, d);
#if COMPENSATED
    const SUMS none = (SUMS)0;
    const SUMS old = started ? LOAD_SUMS(at) : none, rest = started ? LOAD_SUMS(at + 4) : none;
    const SUMS sum = old + value;
    const SUMS part = sum - old;
    STORE_SUMS(sum, at);
    STORE_SUMS(rest + ((old - (sum - part)) + (value - part)), at + 4);
#else
    STORE_SUMS(started ? LOAD_SUMS(at) + value : value, at);
#endif
}

/* The columns first .. end of a row tile, at the points begin .. end of a slot, SUM_POINTS a lane at most.
 * Points of a tile stand `pitch` apart from those of the next tile. */
INLINE void multiply(__global const REAL *restrict leading, const ulong leading_size,
                     __global const REAL *restrict trailing, const ulong trailing_size, const uint pitch,
                     const uint begin, const uint end, const uint columns, __global SUM *restrict amplitude,
                     const uint started, const uint tiles, const uint tile, const ulong slot, const uint from,
                     const uint to)
{
    __global const REAL *row_tile = leading + slot * leading_size + ((ulong)tile * pitch + begin) * (2 * ROWS);
    __global const REAL *column_slot = trailing + slot * trailing_size + (ulong)begin * (PARTS * COLUMNS);
    __global SUM *out = amplitude + ((ulong)slot * tiles + tile) * columns * (4 * ROWS * KEPT);
    const uint steps = (end - begin) / LANES;
    for (uint j = from; j < to; j += 1 + PAIRED) {
        __global const REAL *row = row_tile;
        __global const REAL *column = column_slot
            + (ulong)(j / COLUMNS) * pitch * (PARTS * COLUMNS) + j % COLUMNS * (PARTS * LANES);
        __global SUM *at = out + (ulong)j * (4 * ROWS * KEPT);
#if PAIRED
        const uint two = j + 1 < to; /* the last column alone is multiplied twice */
        __global const REAL *second = column + (two ? (ulong)pitch * PARTS : 0);
#endif
        EACH_ROW(CLEAR)
        for (uint k = 0; k < steps; k++) {
            LOAD(a, column)
#if PAIRED
            LOAD(b, second)
            second += PARTS * LANES;
#endif
            EACH_ROW(MULTIPLY)
            row += 2 * ROWS * LANES;
            column += PARTS * COLUMNS * LANES;
        }
        EACH_ROW(ADD)
#if PAIRED
        if (two) {
            EACH_ROW(ADD_SECOND)
        }
#endif
    }
}

__kernel void product(__global const REAL *restrict leading, const ulong leading_size,
                      __global const REAL *restrict trailing, const ulong trailing_size, const uint pitch,
                      const uint length, __global const uint *bounds, const uint tiles, const uint tiles_each,
                      const uint columns, const uint each, __global SUM *restrict amplitude, const uint again)
{
#if COLUMNS == 1 /* one work-item after another takes the same columns, which then stay in cache */
    const uint block = get_global_id(0), first = get_global_id(1) * each;
#else /* a work-group's columns lie side by side */
    const uint block = get_global_id(1), first = get_global_id(0) * each;
#endif
    const uint last = (block + 1) * tiles_each < tiles ? (block + 1) * tiles_each : tiles;
    for (uint begin = 0; begin < length; begin += SUM_POINTS * LANES) {
        const uint end = length - begin < SUM_POINTS * LANES ? length : begin + SUM_POINTS * LANES;
        for (uint tile = block * tiles_each; tile < last; tile++) {
            const uint from = first < bounds[2 * tile] ? bounds[2 * tile] : first;
            const uint to = first + each > bounds[2 * tile + 1] ? bounds[2 * tile + 1] : first + each;
            multiply(leading, leading_size, trailing, trailing_size, pitch, begin, end, columns, amplitude,
                     again || begin > 0, tiles, tile, get_global_id(2), from, to);
        }
    }
}
