/* Sums G(m) = sum_k w_k prod_a W(m_a - M_a x_ka) at the nodes of a real grid on AXES axes, 2 or 3; line_spread.cl
 * takes one axis, with the window of these. Needs grid_cells.cl.
 *
 * W is the window (kaiser_bessel.py) on WIDTH cells, given in each cell as an even and an odd polynomial of the
 * place less 1/2: the values of the lower cells are their sums, those of the upper ones, mirrored, their differences.
 * Strengths are real, so the grid is.
 *
 * A band is the nodes first_row .. end_row of the first axis (all, if there is only one axis) of one set.
 * It takes the points of its own band and of the band before, whose windows reach into its own. Where there are
 * several runs (deal_points.cl), each takes every runs-th point and is summed in `part`, which is then added to
 * `grid`, so that the rounding of a node's sum grows with the points of a run and the number of runs. The mean of a
 * run, a share of the set's, is left out then: it is part of no frequency but 0, and would be most of what is
 * rounded. The last axes have WIDTH cells beyond the end, which are folded back. Points are [set][axis][stride];
 * band b of a set holds those from starts[b] on.
 */
#define REAL4 JOIN(REAL, 4)
#define LOAD4(p) ((REAL4)((p)[0], (p)[1], (p)[2], (p)[3]))
#define STORE4(v, p) do { const REAL4 kept = (v); (p)[0] = kept.s0; (p)[1] = kept.s1; (p)[2] = kept.s2; \
    (p)[3] = kept.s3; } while (0)
#define ADD4(v, p) STORE4(LOAD4(p) + (v), p)

/* Values of the window at the WIDTH cells around a place, as REAL4 named v0 .. v3 (v0, v1 where WIDTH is 8): begun
 * with the highest terms, a term at a time, and mirrored. Two windows side by side take less than one after the other.
 */
#if WIDTH == 16
#define BEGIN(v, s)                                                                                          \
    REAL4 v##0 = LOAD4(terms), v##1 = LOAD4(terms + 4), v##2 = LOAD4(terms + 8), v##3 = LOAD4(terms + 12);   \
    const REAL v##_square = s * s;
#define ADD_TERM(v, t)                                                                                       \
    v##0 = v##0 * v##_square + LOAD4(terms + 16 * t);                                                        \
    v##1 = v##1 * v##_square + LOAD4(terms + 16 * t + 4);                                                    \
    v##2 = v##2 * v##_square + LOAD4(terms + 16 * t + 8);                                                    \
    v##3 = v##3 * v##_square + LOAD4(terms + 16 * t + 12);
#define MIRROR(v, s)                                                                                         \
    {                                                                                                        \
        const REAL4 even0 = v##0, even1 = v##1, odd0 = v##2, odd1 = v##3;                                    \
        v##0 = even0 + odd0 * s;                                                                             \
        v##1 = even1 + odd1 * s;                                                                             \
        v##2 = (even1 - odd1 * s).s3210;                                                                     \
        v##3 = (even0 - odd0 * s).s3210;                                                                     \
    }
#define TO_ARRAY(v, p) STORE4(v##0, p); STORE4(v##1, p + 4); STORE4(v##2, p + 8); STORE4(v##3, p + 12)
#define FROM_ARRAY(v, p) \
    const REAL4 v##0 = LOAD4(p), v##1 = LOAD4(p + 4), v##2 = LOAD4(p + 8), v##3 = LOAD4(p + 12)
#define SCALED(v, by, w) const REAL4 v##0 = by * w##0, v##1 = by * w##1, v##2 = by * w##2, v##3 = by * w##3
#define ADD_ROW(by, v, p) ADD4(by * v##0, p); ADD4(by * v##1, p + 4); ADD4(by * v##2, p + 8); ADD4(by * v##3, p + 12)
#else
#define BEGIN(v, s)                                                                                          \
    REAL4 v##0 = LOAD4(terms), v##1 = LOAD4(terms + 4);                                                      \
    const REAL v##_square = s * s;
#define ADD_TERM(v, t)                                                                                       \
    v##0 = v##0 * v##_square + LOAD4(terms + 8 * t);                                                         \
    v##1 = v##1 * v##_square + LOAD4(terms + 8 * t + 4);
#define MIRROR(v, s)                                                                                         \
    {                                                                                                        \
        const REAL4 even = v##0, odd = v##1;                                                                 \
        v##0 = even + odd * s;                                                                               \
        v##1 = (even - odd * s).s3210;                                                                       \
    }
#define TO_ARRAY(v, p) STORE4(v##0, p); STORE4(v##1, p + 4)
#define FROM_ARRAY(v, p) const REAL4 v##0 = LOAD4(p), v##1 = LOAD4(p + 4)
#define SCALED(v, by, w) const REAL4 v##0 = by * w##0, v##1 = by * w##1
#define ADD_ROW(by, v, p) ADD4(by * v##0, p); ADD4(by * v##1, p + 4)
#endif

#define WINDOW(v, s)                                                                                         \
    BEGIN(v, s)                                                                                              \
    for (uint t = 1; t < TERMS; t++) { ADD_TERM(v, t) }                                                      \
    MIRROR(v, s)
#define TWO_WINDOWS(v, s, w, r)                                                                              \
    BEGIN(v, s)                                                                                              \
    BEGIN(w, r)                                                                                              \
    for (uint t = 1; t < TERMS; t++) { ADD_TERM(v, t) ADD_TERM(w, t) }                                       \
    MIRROR(v, s)                                                                                             \
    MIRROR(w, r)

/* Rows of the first axis that a point adds to: those of its window that the band has. */
#define ROWS_WITHIN(u)                                                                                       \
    const int row = (int)cell - shift;                                                                       \
    const uint from = row < (int)first_row ? first_row - row : 0;                                            \
    const uint to = row + WIDTH > (int)end_row ? end_row - row : WIDTH;                                      \
    for (uint u = from; u < to; u++)

static void clear(__global REAL *at, const ulong count)
{
    for (ulong i = 0; i < count; i += 4) STORE4((REAL4)0, at + i);
}

/* The cells beyond the ends of the last axes are added to those at their beginnings. */
static void fold(__global REAL *at, const uint rows, const ulong plane, const uint nodes, const uint row_length)
{
    const ulong lines = rows * plane / row_length;
    for (ulong line = 0; line < lines; line++)
        for (uint j = 0; j < WIDTH; j++) at[line * row_length + j] += at[line * row_length + nodes + j];
#if AXES == 3
    for (uint row = 0; row < rows; row++)
        for (uint i = 0; i < WIDTH; i++)
            for (uint j = 0; j < nodes; j += 4) {
                __global REAL *to = at + row * plane + (ulong)i * row_length + j;
                ADD4(LOAD4(to + (ulong)nodes * row_length), to);
            }
#endif
}

/* `part` less `mean` is added to `sum`, and cleared */
static void give(__global REAL *restrict part, __global REAL *restrict sum, const ulong count, const REAL mean)
{
    for (ulong i = 0; i < count; i += 4) {
        ADD4(LOAD4(part + i) - mean, sum + i);
        STORE4((REAL4)0, part + i);
    }
}

#if AXES == 3
/* A group of points, neighbours for the most part, is added plane by plane, so that a plane stays in the first cache. */
#define GROUP 32
INLINE void add_group(REAL (*values)[3 * WIDTH], const int *planes, const ulong *places, const uint held,
                      __global REAL *into, const ulong plane, const uint row_length, const uint first_row,
                      const uint end_row)
{
    int low = end_row, high = first_row;
    for (uint g = 0; g < held; g++) {
        if (planes[g] < low) low = planes[g];
        if (planes[g] + WIDTH > high) high = planes[g] + WIDTH;
    }
    if (low < (int)first_row) low = first_row;
    if (high > (int)end_row) high = end_row;
    for (int row = low; row < high; row++)
        for (uint g = 0; g < held; g++) {
            const int u = row - planes[g];
            if (u < 0 || u >= WIDTH) continue;
            const REAL *middle = values[g] + WIDTH;
            FROM_ARRAY(x, (values[g] + 2 * WIDTH));
            SCALED(y, values[g][u], x);
            __global REAL *at = into + (row - first_row) * plane + places[g];
            for (uint v = 0; v < WIDTH; v++, at += row_length) {
                const REAL by = middle[v];
                ADD_ROW(by, y, at);
            }
        }
}
#endif

#if AXES > 1
/* Carries the points of a set to a band of its grid: `grid`, which is cleared, with `part` beside it for runs. */
static void spread_band(const uint set, const uint band, __global const TURN *turns, const uint stride,
                        __global const REAL *weight, const uint weight_stride, __global const uint *starts,
                        const uint bands, const uint runs, const REAL mean_of_set, const uint nodes,
                        const uint rows_a_band, const uint row_length, __constant REAL *terms,
                        __global REAL *grid, __global REAL *part)
{
    const uint first_row = band * rows_a_band;
    const uint end_row = first_row + rows_a_band < nodes ? first_row + rows_a_band : nodes;
    const ulong plane = AXES == 3 ? (ulong)(nodes + WIDTH) * row_length : row_length;
    const ulong count = (end_row - first_row) * plane;
    const REAL mean = mean_of_set / runs;
    __global const uint *start = starts + set * (bands + 1);
    __global REAL *into = runs > 1 ? part : grid;
#if AXES == 3
    REAL values[GROUP][3 * WIDTH];
    int planes[GROUP];
    ulong places[GROUP];
    uint held = 0;
#endif
    clear(grid, count);
    if (runs > 1) clear(into, count);
    for (uint run = 0; run < runs; run++) {
        for (uint before = 0; before < 2; before++) {
            const uint from_band = (band + (before ? bands - 1 : 0)) % bands;
            const int shift = before && band == 0 ? (int)nodes : 0;
            for (uint k = start[from_band] + run; k < start[from_band + 1]; k += runs) {
                __global const TURN *turn = turns + (ulong)set * AXES * stride + k;
                REAL place;
                const uint cell = cell_of(turn[0], nodes, &place);
                if (before && (int)cell - shift + WIDTH <= (int)first_row) continue;
                const REAL w = weight[(ulong)set * weight_stride + k];
#if AXES == 2
                REAL leading[WIDTH], along;
                const uint column = cell_of(turn[stride], nodes, &along);
                TWO_WINDOWS(v, place, y, along)
                TO_ARRAY(v, leading);
                SCALED(x, w, y);
                ROWS_WITHIN(u) {
                    __global REAL *at = into + (row + u - first_row) * plane + column;
                    const REAL by = leading[u];
                    ADD_ROW(by, x, at);
                }
#else
                {
                    WINDOW(v, place)
                    TO_ARRAY(v, values[held]);
                }
                const uint line = cell_of(turn[stride], nodes, &place);
                {
                    WINDOW(v, place)
                    TO_ARRAY(v, (values[held] + WIDTH));
                }
                const uint column = cell_of(turn[2 * stride], nodes, &place);
                WINDOW(v, place)
                SCALED(x, w, v);
                TO_ARRAY(x, (values[held] + 2 * WIDTH));
                planes[held] = (int)cell - shift;
                places[held] = (ulong)line * row_length + column;
                if (++held == GROUP) {
                    add_group(values, planes, places, held, into, plane, row_length, first_row, end_row);
                    held = 0;
                }
#endif
            }
#if AXES == 3
            add_group(values, planes, places, held, into, plane, row_length, first_row, end_row);
            held = 0;
#endif
        }
        if (runs > 1) {
            fold(into, end_row - first_row, plane, nodes, row_length);
            give(into, grid, count, mean);
        }
    }
    if (runs == 1) fold(grid, end_row - first_row, plane, nodes, row_length);
}

__kernel void grid_spread(__global const TURN *turns, const uint stride, __global const REAL *weight,
                          const uint weight_stride, __global const uint *starts, const uint bands,
                          __global const uint *crowds, __global const REAL *means, const uint nodes,
                          const uint rows_a_band, const uint row_length, __constant REAL *terms,
                          __global REAL *grids, __global REAL *parts, const ulong grid_size)
{
    const uint band = get_global_id(0), set = get_global_id(1);
    const ulong plane = AXES == 3 ? (ulong)(nodes + WIDTH) * row_length : row_length;
    const ulong begin = set * grid_size + band * rows_a_band * plane;
    spread_band(set, band, turns, stride, weight, weight_stride, starts, bands, RUNS_OF(crowds, set), means[set],
                nodes, rows_a_band, row_length, terms, grids + begin, parts + begin);
}
#endif
