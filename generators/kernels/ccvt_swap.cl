/* Swaps of samples between pairs of sites at equal capacity (Balzer, Schlömer & Deussen 2009). Needs vector.cl.
 *
 * offsets (sites, 2, capacity) are the samples of each site, from its place at the start of the pass: x, then
 * y. shift (sites) is how far the site has moved since, always to the centroid of its samples. A sample at o
 * of a is nearer to b, apart = b - a, by half of |o - a|^2 - |o - b|^2 = o.apart - (|b|^2 - |a|^2) / 2: its
 * gain. A swap lowers the energy by the gains of both samples.
 *
 * CHUNK (-D) samples at a time have a box: boxes (sites, 4, chunks) are the least x, the greatest x, the
 * least y, the greatest y. A chunk whose box has no corner beyond what is sought is passed over unread.
 *
 * ccvt_swap: one work-item treats one pair out of [start, stop), in which no site comes twice. The indices of
 * samples that may profit make a heap (sites, capacity) with the largest gain on top; while both tops gain
 * more than GAIN (-D) together they change sides. Both sites move to their centroids, and count as changed.
 */
/* Not fmax and fmin: PoCL calls functions for those of vectors, at ten times the time. */
#define LARGER(a, b) ((a) > (b) ? (a) : (b))
#define SMALLER(a, b) ((a) < (b) ? (a) : (b))

typedef struct {
    __global double *x, *y; /* samples */
    __global double *boxes; /* of the chunks */
    __global int *heap;
    double2 u; /* gains are components along it */
} Row;

INLINE Row row_of(const int site, const double2 u, const int capacity, const int chunks,
                  __global double *offsets, __global double *boxes, __global int *heaps)
{
    Row row;
    row.x = offsets + (size_t)site * 2 * capacity;
    row.y = row.x + capacity;
    row.boxes = boxes + (size_t)site * 4 * chunks;
    row.heap = heaps + (size_t)site * capacity;
    row.u = u;
    return row;
}

INLINE double gain_of(const Row row, const int k) { return row.x[k] * row.u.x + row.y[k] * row.u.y; }

/* Largest gain of a chunk. */
INLINE double farthest_in(const Row row, const int chunk, const int capacity)
{
    double most = -1e300;
    int k = chunk * CHUNK;
    const int stop = min(k + CHUNK, capacity);
#if LANES > 1
    if (k + LANES <= stop) {
        REALV lanes = LOADV(row.x, k) * row.u.x + LOADV(row.y, k) * row.u.y;
        for (k += LANES; k + LANES <= stop; k += LANES) {
            const REALV more = LOADV(row.x, k) * row.u.x + LOADV(row.y, k) * row.u.y;
            lanes = LARGER(lanes, more);
        }
        REAL each[LANES];
        STOREV(lanes, each, 0);
        for (int lane = 0; lane < LANES; lane++) most = LARGER(most, each[lane]);
    }
#endif
    for (; k < stop; k++) {
        const double more = gain_of(row, k);
        most = LARGER(most, more);
    }
    return most;
}

/* The corners of the boxes that are farthest along u. */
#define CORNERS(row) \
    __global const double *corner_x = row.boxes + (row.u.x > 0.0 ? chunks : 0); \
    __global const double *corner_y = row.boxes + (row.u.y > 0.0 ? 3 : 2) * chunks;
#define CORNER(row, chunk) (corner_x[chunk] * row.u.x + corner_y[chunk] * row.u.y)

/* Largest gain of a row: of the chunk that promises most, then of those that promise more than was found. */
INLINE double farthest(const Row row, const int capacity, const int chunks)
{
    CORNERS(row)
    int first = 0;
    double promise = -1e300;
    for (int chunk = 0; chunk < chunks; chunk++) {
        const double corner = CORNER(row, chunk);
        if (corner > promise) {
            promise = corner;
            first = chunk;
        }
    }
    double most = farthest_in(row, first, capacity);
    for (int chunk = 0; chunk < chunks; chunk++)
        if (chunk != first && CORNER(row, chunk) > most) {
            const double more = farthest_in(row, chunk, capacity);
            most = LARGER(most, more);
        }
    return most;
}

/* Bring the index at i of a heap of count down to where both below it gain less. */
INLINE void sift_down(const Row row, int i, const int count)
{
    const int held = row.heap[i];
    const double gain = gain_of(row, held);
    for (int below = 2 * i + 1; below < count; below = 2 * i + 1) {
        double larger = gain_of(row, row.heap[below]);
        if (below + 1 < count) {
            const double other = gain_of(row, row.heap[below + 1]);
            if (other > larger) {
                larger = other;
                below++;
            }
        }
        if (larger <= gain) break;
        row.heap[i] = row.heap[below];
        i = below;
    }
    row.heap[i] = held;
}

/* Put the indices of samples that gain more than bound into the heap; how many they are. */
INLINE int fill_heap(const Row row, const int capacity, const int chunks, const double bound)
{
    CORNERS(row)
    int count = 0;
    for (int chunk = 0; chunk < chunks; chunk++) {
        if (!(CORNER(row, chunk) > bound) || !(farthest_in(row, chunk, capacity) > bound)) continue;
        const int stop = min((chunk + 1) * CHUNK, capacity);
        for (int k = chunk * CHUNK; k < stop; k++)
            if (gain_of(row, k) > bound) row.heap[count++] = k;
    }
    for (int i = count / 2 - 1; i >= 0; i--) sift_down(row, i, count);
    return count;
}

/* Take the top off a heap of count. */
INLINE int pop(const Row row, const int count)
{
    const int top = row.heap[0];
    row.heap[0] = row.heap[count - 1];
    if (count > 1) sift_down(row, 0, count - 1);
    return top;
}

INLINE void put(const Row row, const int k, const double2 sample, const int chunks)
{
    __global double *box = row.boxes + k / CHUNK;
    row.x[k] = sample.x;
    row.y[k] = sample.y;
    box[0] = SMALLER(box[0], sample.x);
    box[chunks] = LARGER(box[chunks], sample.x);
    box[2 * chunks] = SMALLER(box[2 * chunks], sample.y);
    box[3 * chunks] = LARGER(box[3 * chunks], sample.y);
}

__kernel void ccvt_swap(const int start, const int stop, const int capacity, const int chunks,
                        __global const int2 *pairs, __global const double2 *between, __global double *offsets,
                        __global double *boxes, __global int *heaps, __global double2 *shift,
                        __global int *changed)
{
    const int pair = start + get_global_id(0);
    if (pair >= stop) return;
    const int a = pairs[pair].x, b = pairs[pair].y;
    const double2 way = between[pair], apart = way + shift[b] - shift[a];
    const Row of_a = row_of(a, apart, capacity, chunks, offsets, boxes, heaps);
    const Row of_b = row_of(b, -apart, capacity, chunks, offsets, boxes, heaps);
    /* What the components along apart of both samples have to exceed together. */
    const double bar = dot(apart, apart) + dot(shift[a] - shift[b], apart) + GAIN;
    const double from_a = farthest(of_a, capacity, chunks), from_b = farthest(of_b, capacity, chunks);
    if (!(from_a + from_b > bar)) return;

    int left_a = fill_heap(of_a, capacity, chunks, bar - from_b);
    int left_b = fill_heap(of_b, capacity, chunks, bar - from_a);
    double2 sum = (double2)(0.0, 0.0);
    int swaps = 0;
    while (left_a > 0 && left_b > 0) {
        if (!(gain_of(of_a, of_a.heap[0]) + gain_of(of_b, of_b.heap[0]) > bar)) break;
        const int k = pop(of_a, left_a--), l = pop(of_b, left_b--);
        const double2 from = (double2)(of_a.x[k], of_a.y[k]), to = (double2)(of_b.x[l], of_b.y[l]);
        put(of_a, k, to + way, chunks);
        put(of_b, l, from - way, chunks);
        sum += to + way - from;
        swaps++;
    }
    shift[a] += sum / capacity;
    shift[b] -= sum / capacity;
    if (swaps > 0) changed[a] = changed[b] = 1;
}
