/* Sums G(m) = sum_k w_k W(m - M x_k) at the nodes of a real grid on a line; needs grid_cells.cl, and grid_spread.cl for
 * the window.
 *
 * One work-item takes all points of a set, two at a time, in the order in which they stand. Where there are several
 * runs, the points of a bin of WIDTH cells are dealt to them in turn (`taken` counts them), and each run is summed in
 * a row of `parts` of its own; rows less a run's mean are then added up in the grid, so that the rounding of a
 * node's sum grows with the points of a run and the number of runs. WIDTH cells beyond the end are folded back.
 */
#if WIDTH == 2 * LANES /* half a window is a vector */
#define BEGIN_LINE(v, s)                                                                                     \
    REALV v##_even = LOADV(terms, 0), v##_odd = LOADV(terms, LANES);                                         \
    const REAL v##_square = s * s;
#define ADD_LINE_TERM(v, t)                                                                                  \
    v##_even = v##_even * v##_square + LOADV(terms, WIDTH * t);                                              \
    v##_odd = v##_odd * v##_square + LOADV(terms, WIDTH * t + LANES);
#if LANES == 8
#define REVERSED(v) (v).s76543210
#else
#define REVERSED(v) (v).s3210
#endif
#define ADD_LINE(by, v, s, p)                                                                                \
    {                                                                                                        \
        const REALV odd = v##_odd * s;                                                                       \
        STOREV(LOADV(p, 0) + (v##_even + odd) * by, p, 0);                                                   \
        STOREV(LOADV(p, LANES) + REVERSED(v##_even - odd) * by, p, LANES);                                   \
    }
#else
#define BEGIN_LINE BEGIN
#define ADD_LINE_TERM ADD_TERM
#define ADD_LINE(by, v, s, p)                                                                                \
    {                                                                                                        \
        MIRROR(v, s)                                                                                         \
        ADD_ROW(by, v, p);                                                                                   \
    }
#endif

static __global REAL *row_of(const uint cell, const uint runs, __global uint *taken, __global REAL *parts,
                             const uint row_length)
{
    if (runs == 1) return parts;
    const uint run = taken[cell / WIDTH];
    taken[cell / WIDTH] = run + 1 < runs ? run + 1 : 0;
    return parts + (ulong)run * row_length;
}

__kernel void line_spread(__global const TURN *turns, const uint stride, __global const REAL *weight,
                          const uint weight_stride, const uint n, __global const uint *crowds,
                          const uint most_runs, __global const REAL *means, const uint nodes,
                          const uint row_length, __constant REAL *terms, __global REAL *grids,
                          __global REAL *all_parts, __global uint *all_taken)
{
    const uint set = get_global_id(0), bins = (nodes + WIDTH - 1) / WIDTH, runs = RUNS_OF(crowds, set);
    __global const TURN *turn = turns + (ulong)set * stride;
    __global const REAL *w = weight + (ulong)set * weight_stride;
    __global REAL *grid = grids + (ulong)set * row_length;
    __global REAL *parts = runs > 1 ? all_parts + (ulong)set * most_runs * row_length : grid;
    __global uint *taken = all_taken + (ulong)set * bins;
    clear(grid, row_length);
    if (runs > 1) {
        clear(parts, (ulong)runs * row_length);
        for (uint b = 0; b < bins; b++) taken[b] = 0;
    }
    uint k = 0;
    for (; k + 1 < n; k += 2) {
        REAL place, other;
        const uint cell = cell_of(turn[k], nodes, &place), next = cell_of(turn[k + 1], nodes, &other);
        BEGIN_LINE(x, place)
        BEGIN_LINE(y, other)
        for (uint t = 1; t < TERMS; t++) { ADD_LINE_TERM(x, t) ADD_LINE_TERM(y, t) }
        __global REAL *at = row_of(cell, runs, taken, parts, row_length) + cell;
        ADD_LINE(w[k], x, place, at)
        at = row_of(next, runs, taken, parts, row_length) + next;
        ADD_LINE(w[k + 1], y, other, at)
    }
    if (k < n) {
        REAL place;
        const uint cell = cell_of(turn[k], nodes, &place);
        BEGIN_LINE(x, place)
        for (uint t = 1; t < TERMS; t++) { ADD_LINE_TERM(x, t) }
        __global REAL *at = row_of(cell, runs, taken, parts, row_length) + cell;
        ADD_LINE(w[k], x, place, at)
    }
    for (uint run = 0; run < runs; run++) fold(parts + (ulong)run * row_length, 1, row_length, nodes, row_length);
    if (runs > 1)
        for (uint run = 0; run < runs; run++) give(parts + (ulong)run * row_length, grid, row_length, means[set] / runs);
}
