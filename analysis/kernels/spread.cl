/* Sums G_m(g) = sum_k w_k W(m - M x_k0) exp(-2 pi i g.x_k') at the nodes m of a grid of M on the first axis.
 *
 * W is the window (kaiser_bessel.py), g and x' are frequencies and coordinates on the other axes, whose
 * cosines and sines tables.cl made. One work-item takes LANES neighbouring nodes of one set. It takes up to
 * RUN neighbouring points at a time, of those whose window reaches its nodes, and evaluates the window
 * there. Then it adds the cosines and sines of these points, times the window, to its nodes: NODES nodes and
 * LANES frequencies side by side.
 *
 * Points are sorted by cell, and `starts` holds the first point of each cell. A launch takes the `length`
 * points from `begin` on; where `fresh`, the sums begin at 0. Where KEPT_SUMS, the rounding of the sums is
 * kept beside them.
 * Layout of points: [LANES frequencies][point][cos, sin][lane]; of nodes: [COLUMNS frequencies][LANES nodes][frequency]
 * [cos, sin][lane].
 */
#define RUN SUM_POINTS
#define NOT_YET 0xffffffffu
#if LANES < 4
#define NODES LANES
#else
#define NODES 4
#endif

#if NODES == 4
#define EACH_NODE(DO) DO(0) DO(1) DO(2) DO(3)
#elif NODES == 2
#define EACH_NODE(DO) DO(0) DO(1)
#else
#define EACH_NODE(DO) DO(0)
#endif

#define CLEAR(m) REALV c##m = (REALV)0, s##m = (REALV)0;
#define TAKE(m) \
    {                                                                 \
        const REAL by = values[h * LANES + first + m];                \
        c##m += by * cosines;                                         \
        s##m += by * sines;                                           \
    }
#define GIVE(m) add_up(c##m, s##m, grid, rest, first + m, node, nodes, j, columns);

static void put(__global REAL *to, __global REAL *rest, const REAL value)
{
    const REAL old = *to;
    const REAL sum = old + value;
#if KEPT_SUMS
    const REAL part = sum - old;
    *rest += (old - (sum - part)) + (value - part);
#endif
    *to = sum;
}

static void add_up(const REALV cosines, const REALV sines, __global REAL *grid, __global REAL *rest,
                   const uint lane, const uint node, const uint nodes, const uint j, const uint columns)
{
    REAL c[LANES], s[LANES];
    STOREV(cosines, c, 0);
    STOREV(sines, s, 0);
    for (uint l = 0; l < LANES && j + l < columns; l++) {
        const ulong to = ((ulong)((j + l) / COLUMNS) * nodes * COLUMNS + (ulong)node * COLUMNS
                          + (j + l) % COLUMNS * LANES) * 2 + lane;
        put(grid + to, rest + to, c[l]);
        put(grid + to + LANES, rest + to + LANES, s[l]);
    }
}

__kernel void spread(__global const REAL *restrict table, const ulong slot_size, const uint begin,
                     const uint length, const uint columns, __global const REAL *place,
                     __global const uint *starts, __global const REAL *coefficients, const uint stride,
                     const uint nodes, const uint first_node, __global const REAL *weight,
                     const uint weight_stride, __global REAL *restrict out, __global REAL *restrict kept,
                     const ulong grid_size, const uint groups, const uint fresh)
{
    if (get_global_id(0) >= groups) return;
    const uint node = (first_node + get_global_id(0) * LANES) % nodes;
    const uint set = get_global_id(1);
    __global const REAL *slot = table + set * slot_size;
    __global REAL *grid = out + set * grid_size;
    __global REAL *rest = kept + set * grid_size;
    __global const uint *start = starts + (ulong)set * (nodes + 1);
    const uint row = WIDTH + 2 * LANES;
    REAL values[RUN * LANES];
    uint held = 0, first_held = 0;
    /* points low .. high of those held reach each NODES of the nodes; NOT_YET before either is met */
    uint low[LANES / NODES], high[LANES / NODES];
    for (uint q = 0; q < LANES / NODES; q++)
        low[q] = high[q] = NOT_YET;
    if (fresh) {
        for (uint j = 0; j < columns; j++) {
            const ulong to = ((ulong)(j / COLUMNS) * nodes * COLUMNS + (ulong)node * COLUMNS
                              + j % COLUMNS * LANES) * 2;
            STOREV((REALV)0, grid + to, 0);
            STOREV((REALV)0, grid + to, LANES);
            STOREV((REALV)0, rest + to, 0);
            STOREV((REALV)0, rest + to, LANES);
        }
    }
    /* from the first cell that reaches the first node to the last that reaches the last, and one step more */
    for (uint step = 0; step < WIDTH + LANES; step++) {
        const uint cell = (node + nodes + step - WIDTH / 2) % nodes;
        const uint last = step == WIDTH + LANES - 1;
        for (uint q = 0; q < LANES / NODES; q++) {
            if (step == q * NODES) low[q] = held;
            if (step == q * NODES + WIDTH + NODES - 1) high[q] = held;
        }
        uint k = start[cell], end = start[cell + 1];
        k = k < begin ? begin : k;
        end = end > begin + length ? begin + length : end;
        if (last) k = end;
        /* the window's cell at the first node is WIDTH - 1 - step; LANES zeros stand on either side */
        __global const REAL *of = coefficients + (WIDTH - 1 + LANES - step);
        while (k < end || (last && held > 0)) {
            if (held == 0) first_held = k;
            while (k < end && held < RUN && k == first_held + held) {
                const REAL s = place[(ulong)set * stride + k] - (REAL)0.5;
                REALV value = LOADV(of, 0);
                for (uint p = 1; p <= DEGREE; p++)
                    value = value * s + LOADV(of, p * row);
                value *= weight[(ulong)set * weight_stride + k];
                STOREV(value, values, held * LANES);
                held++;
                k++;
            }
            if (k == end && held < RUN && !last) break;
            for (uint j = 0; j < columns; j += LANES) {
                __global const REAL *column = slot + ((ulong)j * length + (first_held - begin) * LANES) * 2;
                for (uint first = 0; first < LANES; first += NODES) {
                    const uint to = high[first / NODES] < held ? high[first / NODES] : held;
                    if (low[first / NODES] >= to) continue;
                    EACH_NODE(CLEAR)
                    for (uint h = low[first / NODES]; h < to; h++) {
                        __global const REAL *at = column + h * (2 * LANES);
                        const REALV cosines = LOADV(at, 0), sines = LOADV(at, LANES);
                        EACH_NODE(TAKE)
                    }
                    EACH_NODE(GIVE)
                }
            }
            held = 0;
            for (uint q = 0; q < LANES / NODES; q++) {
                low[q] = low[q] == NOT_YET ? NOT_YET : 0;
                high[q] = high[q] == NOT_YET ? NOT_YET : 0;
            }
        }
    }
}

/* Sums and differences of the numbers at nodes m and M - m, m = 0 .. M/2, for product.cl where FOLDED.
 * One work-item takes one frequency; layout [COLUMNS blocks][node][block][sum, difference][LANES frequencies]
 * [cos, sin]. */
__kernel void fold(__global const REAL *restrict grid, const ulong grid_size,
                   __global const REAL *restrict kept, const uint nodes, const uint columns,
                   const uint length, __global REAL *restrict out, const ulong out_size)
{
    const uint j = get_global_id(0);
    if (j >= columns) return;
    const ulong column = get_global_id(1) * grid_size
        + ((ulong)(j / COLUMNS) * nodes * COLUMNS + j % COLUMNS * LANES) * 2;
    __global REAL *to = out + get_global_id(1) * out_size
        + (ulong)(j / (COLUMNS * LANES)) * length * (4 * COLUMNS * LANES)
        + j / LANES % COLUMNS * (4 * LANES) + 2 * (j % LANES);
    for (uint m = 0; m < length; m++) {
        const uint alone = 2 * m % nodes == 0, mirror = alone ? m : nodes - m;
        const ulong here = column + (ulong)(m / LANES) * (2 * LANES * COLUMNS) + m % LANES;
        const ulong there = column + (ulong)(mirror / LANES) * (2 * LANES * COLUMNS) + mirror % LANES;
        const ulong at = (ulong)m * (4 * LANES * COLUMNS);
        for (uint part = 0; part < 2; part++) {
            REAL a = 0, b = 0;
            if (2 * m <= nodes) {
                a = grid[here + part * LANES];
                b = alone ? 0 : grid[there + part * LANES];
#if KEPT_SUMS
                a += kept[here + part * LANES];
                b += alone ? 0 : kept[there + part * LANES];
#endif
            }
            to[at + part] = a + b;
            to[at + 2 * LANES + part] = a - b;
        }
    }
}
