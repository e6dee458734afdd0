/* Amplitudes F(fa, fb) and F(fa, -fb) from two groups' tables as a real product, tile by tile.
 *
 * With alpha = 2 pi fa.xa and beta = 2 pi fb.xb the four sums over points of cos alpha cos beta, sin sin,
 * sin cos and cos sin give both amplitudes; Hermitian symmetry gives the other two quadrants. One work-item holds
 * ROWS rows of the leading group by LANES columns of the trailing one in registers, sums SUM_POINTS points at a
 * time, and adds each such sum to the amplitudes in double where the device has it (the type SUM). Rows are
 * written out by macro, since an array of accumulators would live in memory. Tables come packed in tiles of ROWS and
 * of COLUMNS, those of a work-group (tables.cl).
 */
#if ROWS == 2
#define EACH_ROW(DO) DO(0) DO(1)
#elif ROWS == 3
#define EACH_ROW(DO) DO(0) DO(1) DO(2)
#elif ROWS == 4
#define EACH_ROW(DO) DO(0) DO(1) DO(2) DO(3)
#elif ROWS == 6
#define EACH_ROW(DO) DO(0) DO(1) DO(2) DO(3) DO(4) DO(5)
#endif

#define CLEAR(r) REALV cc##r = (REALV)0, ss##r = (REALV)0, sc##r = (REALV)0, cs##r = (REALV)0;

#define MULTIPLY(r)                                         \
    {                                                       \
        const REAL ca = row[r], sa = row[ROWS + r];         \
        cc##r += ca * cb;                                   \
        ss##r += sa * sb;                                   \
        sc##r += sa * cb;                                   \
        cs##r += ca * sb;                                   \
    }

#define ADD(r) add_up(cc##r, ss##r, sc##r, cs##r, tile + (ulong)r * stride_b, plane);

static void add_up(REALV cc, REALV ss, REALV sc, REALV cs, __global SUM *out, ulong plane)
{
    REAL part[4 * LANES];
    STOREV(cc, part, 0);
    STOREV(ss, part, LANES);
    STOREV(sc, part, 2 * LANES);
    STOREV(cs, part, 3 * LANES);
    for (int v = 0; v < LANES; v++) {
        const SUM tcc = part[v], tss = part[LANES + v], tsc = part[2 * LANES + v], tcs = part[3 * LANES + v];
        out[v] += tcc - tss;
        out[plane + v] += tsc + tcs;
        out[2 * plane + v] += tcc + tss;
        out[3 * plane + v] += tsc - tcs;
    }
}

__kernel void product(__global const REAL *restrict table_a, __global const REAL *restrict table_b,
                      const uint stride_a, const uint stride_b, __global SUM *restrict amplitude,
                      const uint points, const uint length)
{
    const uint j = get_global_id(0) * LANES;
    const uint i = get_global_id(1) * ROWS;
    if (j >= stride_b || i >= stride_a) return;
    const ulong plane = (ulong)stride_a * stride_b;
    __global SUM *tile = amplitude + (ulong)i * stride_b + j;
    __global const REAL *row = table_a + (ulong)i * length * 2;
    __global const REAL *column = table_b + (ulong)(j / COLUMNS) * length * 2 * COLUMNS + j % COLUMNS;
    for (uint first = 0; first < points; first += SUM_POINTS) {
        const uint last = first + SUM_POINTS < points ? first + SUM_POINTS : points;
        EACH_ROW(CLEAR)
        for (uint k = first; k < last; k++) {
            const REALV cb = LOADV(column, 0), sb = LOADV(column, COLUMNS);
            EACH_ROW(MULTIPLY)
            row += 2 * ROWS;
            column += 2 * COLUMNS;
        }
        EACH_ROW(ADD)
    }
}
