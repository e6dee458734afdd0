/* Sums over points of the products of two groups' tables, from which the amplitudes F(fa, fb) and F(fa, -fb) follow.
 *
 * With alpha = 2 pi fa.xa and beta = 2 pi fb.xb these are four: cos alpha cos beta, cos alpha sin beta, sin alpha
 * cos beta and sin alpha sin beta (power.cl). F(-f) is its conjugate.
 *
 * One work-item takes `tiles_each` tiles of ROWS frequencies of the leading group and `each` frequencies of the
 * trailing one, of those within the two `bounds` of a row tile. LANES of these make a block, whose cosines and
 * sines alternate in two vectors. The rows' cosines and sines are single numbers, each multiplied with both
 * vectors, or with the first one alone where that holds all columns of the last block. SUM_POINTS points are
 * summed in registers, and these sums are added up (register_sums.cl) before the next points.
 * Rows are written out by macros, since an array of accumulators would lie in memory.
 * Layout of the sums: [slot][row tile][block][row][what register_sums.cl has of a row and a block];
 * that of tables stands in tables.cl.
 *
 * Where FOLDED, points are the nodes m = 0 .. M/2 of a grid, and a block has four vectors (spread.cl): the
 * sums of the cosines and of the sines that were carried to m and to M - m, which are multiplied with cos
 * alpha, and their differences, which are multiplied with sin alpha.
 */
#if ROWS == 3
#define EACH_ROW(DO) DO(0) DO(1) DO(2)
#elif ROWS == 4
#define EACH_ROW(DO) DO(0) DO(1) DO(2) DO(3)
#elif ROWS == 6
#define EACH_ROW(DO) DO(0) DO(1) DO(2) DO(3) DO(4) DO(5)
#endif

#if FOLDED
#define PARTS 4
#define LOAD_FIRST const REALV e1 = LOADV(column, 0), o1 = LOADV(column, 2 * LANES);
#define LOAD_SECOND const REALV e2 = LOADV(column, LANES), o2 = LOADV(column, 3 * LANES);
#else
#define PARTS 2
#define LOAD_FIRST const REALV e1 = LOADV(column, 0), o1 = e1;
#define LOAD_SECOND const REALV e2 = LOADV(column, LANES), o2 = e2;
#endif

/* The sums of row r: of its cosine (c) and sine (s) with the first and the second vector. */
#define CLEAR(r) REALV c1##r = (REALV)0, s1##r = (REALV)0, c2##r = (REALV)0, s2##r = (REALV)0;
#define BY_FIRST(r)                                                                              \
    {                                                                                            \
        const REALV c = (REALV)(row[2 * LANES * r]), s = (REALV)(row[2 * LANES * r + LANES]);    \
        c1##r += c * e1;                                                                         \
        s1##r += s * o1;                                                                         \
    }
#define BY_BOTH(r)                                                                               \
    {                                                                                            \
        const REALV c = (REALV)(row[2 * LANES * r]), s = (REALV)(row[2 * LANES * r + LANES]);    \
        c1##r += c * e1;                                                                         \
        c2##r += c * e2;                                                                         \
        s1##r += s * o1;                                                                         \
        s2##r += s * o2;                                                                         \
    }
#define ADD_FIRST(r)                                                                             \
    add_up(c1##r, at + r * ROW_SUMS, started, whole);                                            \
    add_up(s1##r, at + r * ROW_SUMS + ROW_SUMS / 2, started, whole);
#define ADD_SECOND(r)                                                                            \
    add_up(c2##r, at + r * ROW_SUMS + LANES, started, whole);                                    \
    add_up(s2##r, at + r * ROW_SUMS + ROW_SUMS / 2 + LANES, started, whole);

#if LANES > 2 && !FOLDED
/* The frequency 0 of the trailing group has the cosine 1 and the sine 0, so that its sums are those of the rows
 * themselves. Where `zero_last`, it stands alone behind the last whole or half block, and vectors of points are
 * added up. */
#define CLEAR_TOTAL(r) REALV tc##r = (REALV)0, ts##r = (REALV)0;
#define TOTAL(r)                                                                                 \
    tc##r += LOADV(points, 2 * LANES * r);                                                       \
    ts##r += LOADV(points, 2 * LANES * r + LANES);
#define ADD_TOTAL(r)                                                                             \
    add_zero(lanes_summed(tc##r), at + r * ROW_SUMS, started, whole);                            \
    add_zero(lanes_summed(ts##r), at + r * ROW_SUMS + ROW_SUMS / 2, started, whole);

/* The sums with the frequency 0 over the points begin .. end of a row tile. */
INLINE void add_totals(__global const REAL *restrict points, const uint begin, const uint end,
                       __global SUM *at, const uint started, const uint whole)
{
    EACH_ROW(CLEAR_TOTAL)
    for (uint k = begin; k < end; k += LANES) {
        EACH_ROW(TOTAL)
        points += 2 * ROWS * LANES;
    }
    EACH_ROW(ADD_TOTAL)
}
#endif

/* SUM_POINTS points of a block or what is left of them, LANES of which stand side by side in the rows' table. */
#define EACH_POINT(LOADS, MULTIPLY)                                                              \
    for (uint k = begin; k < end; k += LANES) {                                                  \
        for (uint l = 0; l < LANES; l++) {                                                       \
            LOADS                                                                                \
            EACH_ROW(MULTIPLY)                                                                   \
            row++;                                                                               \
            column += PARTS * COLUMNS * LANES;                                                   \
        }                                                                                        \
        row += (2 * ROWS - 1) * LANES;                                                           \
    }

/* The columns from .. to of a row tile, from a whole block on, at `length` points of a slot. Points of a tile stand
 * `pitch` apart from those of the next tile. Of `all` register sums that a slot will have it has `done`. */
INLINE void multiply(__global const REAL *restrict leading, const ulong leading_size,
                     __global const REAL *restrict trailing, const ulong trailing_size, const uint pitch,
                     const uint length, const uint columns, const uint zero_last, __global SUM *restrict sums,
                     const uint done, const uint all, const uint tiles, const uint tile, const ulong slot,
                     const uint from, const uint to)
{
    __global const REAL *row_tile = leading + slot * leading_size + (ulong)tile * pitch * (2 * ROWS);
    __global const REAL *columns_of_slot = trailing + slot * trailing_size;
    __global SUM *out = sums + ((ulong)slot * tiles + tile) * columns * (ROWS * ROW_SUMS / LANES);
    for (uint block = from / LANES; block * LANES < to; block++) {
        __global const REAL *row = row_tile;
        __global const REAL *column = columns_of_slot
            + (ulong)(block / COLUMNS) * pitch * (PARTS * COLUMNS * LANES) + block % COLUMNS * (PARTS * LANES);
        __global SUM *at = out + (ulong)block * (ROWS * ROW_SUMS);
        for (uint begin = 0; begin < length; begin += SUM_POINTS) {
            const uint end = length - begin < SUM_POINTS ? length : begin + SUM_POINTS;
            const uint before = done + begin / SUM_POINTS;
#if COMPENSATED
            const uint started = before % PART_SUMS, ends = started + 1 == PART_SUMS || before + 1 == all;
            const uint whole = ends ? 1 + (before >= PART_SUMS) : 0;
#else
            const uint started = before, whole = 0;
#endif
#if LANES > 2 && !FOLDED
            const uint left = to - block * LANES;
            const uint apart = zero_last && (left == 1 || left == LANES / 2 + 1);
            if (apart)
                add_totals(row_tile + (ulong)begin * (2 * ROWS), begin, end, at + 2 * (left - 1), started, whole);
            if (apart && left == 1) continue;
#else
            const uint apart = 0;
#endif
            EACH_ROW(CLEAR)
#if LANES > 1
            if (block * LANES + LANES / 2 + apart >= to) {
                EACH_POINT(LOAD_FIRST, BY_FIRST)
                EACH_ROW(ADD_FIRST)
                continue;
            }
#endif
            EACH_POINT(LOAD_FIRST LOAD_SECOND, BY_BOTH)
            EACH_ROW(ADD_FIRST)
            EACH_ROW(ADD_SECOND)
        }
    }
}

__kernel void product(__global const REAL *restrict leading, const ulong leading_size,
                      __global const REAL *restrict trailing, const ulong trailing_size, const uint pitch,
                      const uint length, __global const uint *bounds, const uint tiles, const uint tiles_each,
                      const uint columns, const uint zero_last, const uint each, __global SUM *restrict sums,
                      const uint done, const uint all)
{
#if COLUMNS == 1 /* one work-item after another takes the same columns, which then stay in cache */
    const uint item = get_global_id(0), first = get_global_id(1) * each;
#else /* a work-group's columns lie side by side */
    const uint item = get_global_id(1), first = get_global_id(0) * each;
#endif
    const uint last = (item + 1) * tiles_each < tiles ? (item + 1) * tiles_each : tiles;
    for (uint tile = item * tiles_each; tile < last; tile++) {
        const uint from = first < bounds[2 * tile] ? bounds[2 * tile] : first;
        const uint to = first + each > bounds[2 * tile + 1] ? bounds[2 * tile + 1] : first + each;
        multiply(leading, leading_size, trailing, trailing_size, pitch, length, columns, zero_last, sums, done, all,
                 tiles, tile, get_global_id(2), from, to);
    }
}
