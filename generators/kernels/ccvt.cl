/* Swaps of samples between pairs of sites at equal capacity (Balzer, Schlömer & Deussen 2009): needs vector.cl.
 *
 * offsets (sites, 2, capacity) are the samples of each site, from its place at the start of the pass: x, then
 * y. shift (sites) is how far the site has moved since, always to the centroid of its samples. A sample at o
 * of a is nearer to b, apart = b - a, by half of |o - a|^2 - |o - b|^2 = o.apart - (|b|^2 - |a|^2) / 2: its
 * gain. A swap lowers the energy by the gains of both samples.
 *
 * ccvt_swap: one work-item treats one pair out of [start, stop), in which no site comes twice. Samples that
 * may profit go to the front of their site's row, into a heap with the largest gain on top; while both tops
 * gain more than GAIN (-D) together they change sides and go behind the heaps. Both sites move to their
 * centroids, and count as changed.
 *
 * ccvt_recentre: one work-item takes one changed site: its offsets are from the centroid from now on, brought
 * back to [-1/2, 1/2] where they are longer (then changed is 2), moved is what they were shifted by, and shift
 * what still lacks to the centroid: rounding, or the effect of those brought back.
 */
#define SUM double

INLINE double gain_of(__global const double *x, __global const double *y, const int k, const double2 u)
{
    return x[k] * u.x + y[k] * u.y;
}

INLINE void exchange(__global double *x, __global double *y, const int i, const int k)
{
    const double2 held = (double2)(x[i], y[i]);
    x[i] = x[k];
    y[i] = y[k];
    x[k] = held.x;
    y[k] = held.y;
}

/* Bring the sample at i of a heap of count down to where both below it have less along u. */
INLINE void sift_down(__global double *x, __global double *y, int i, const int count, const double2 u)
{
    const double2 held = (double2)(x[i], y[i]);
    const double gain = dot(held, u);
    for (int below = 2 * i + 1; below < count; below = 2 * i + 1) {
        double larger = gain_of(x, y, below, u);
        if (below + 1 < count) {
            const double other = gain_of(x, y, below + 1, u);
            if (other > larger) {
                larger = other;
                below++;
            }
        }
        if (larger <= gain) break;
        x[i] = x[below];
        y[i] = y[below];
        i = below;
    }
    x[i] = held.x;
    y[i] = held.y;
}

/* Largest component along u of a row. */
INLINE double farthest(__global const double *x, __global const double *y, const int capacity, const double2 u)
{
    double most = -1e300;
    int k = 0;
#if LANES > 1
    if (capacity >= 2 * LANES) {
        REALV even = -1e300, odd = -1e300; /* two of them, so that one need not wait for the other */
        for (; k + 2 * LANES <= capacity; k += 2 * LANES) {
            even = fmax(even, LOADV(x, k) * u.x + LOADV(y, k) * u.y);
            odd = fmax(odd, LOADV(x, k + LANES) * u.x + LOADV(y, k + LANES) * u.y);
        }
        REAL each[LANES];
        STOREV(fmax(even, odd), each, 0);
        for (int lane = 0; lane < LANES; lane++) most = fmax(most, each[lane]);
    }
#endif
    for (; k < capacity; k++) most = fmax(most, gain_of(x, y, k, u));
    return most;
}

/* Put those of a row with more than bound along u first, in a heap; how many they are. */
INLINE int heap_of(__global double *x, __global double *y, const int capacity, const double2 u, const double bound)
{
    int count = 0;
    for (int k = 0; k < capacity; k += LANES) {
        const int stop = min(k + LANES, capacity);
#if LANES > 1
        if (k + LANES <= capacity && !any(LOADV(x, k) * u.x + LOADV(y, k) * u.y > bound)) continue;
#endif
        for (int i = k; i < stop; i++)
            if (gain_of(x, y, i, u) > bound) exchange(x, y, i, count++);
    }
    for (int i = count / 2 - 1; i >= 0; i--) sift_down(x, y, i, count, u);
    return count;
}

__kernel void ccvt_swap(const int start, const int stop, const int capacity, __global const int2 *pairs,
                        __global const double2 *between, __global double *offsets, __global double2 *shift,
                        __global int *changed)
{
    const int pair = start + get_global_id(0);
    if (pair >= stop) return;
    const int a = pairs[pair].x, b = pairs[pair].y;
    const double2 apart = between[pair] + shift[b] - shift[a];
    __global double *ax = offsets + (size_t)a * 2 * capacity, *ay = ax + capacity;
    __global double *bx = offsets + (size_t)b * 2 * capacity, *by = bx + capacity;
    /* What the components along apart of both samples have to exceed together. */
    const double bar = dot(apart, apart) + dot(shift[a] - shift[b], apart) + GAIN;
    const double from_a = farthest(ax, ay, capacity, apart), from_b = farthest(bx, by, capacity, -apart);
    if (!(from_a + from_b > bar)) return;

    int of_a = heap_of(ax, ay, capacity, apart, bar - from_b);
    int of_b = heap_of(bx, by, capacity, -apart, bar - from_a);
    double2 sum_a = (double2)(0.0, 0.0), sum_b = (double2)(0.0, 0.0);
    while (of_a > 0 && of_b > 0) {
        if (!(gain_of(ax, ay, 0, apart) + gain_of(bx, by, 0, -apart) > bar)) break;
        exchange(ax, ay, 0, --of_a);
        exchange(bx, by, 0, --of_b);
        sift_down(ax, ay, 0, of_a, apart);
        sift_down(bx, by, 0, of_b, -apart);
        const double2 old_a = (double2)(ax[of_a], ay[of_a]), old_b = (double2)(bx[of_b], by[of_b]);
        const double2 new_a = old_b + between[pair], new_b = old_a - between[pair];
        ax[of_a] = new_a.x;
        ay[of_a] = new_a.y;
        bx[of_b] = new_b.x;
        by[of_b] = new_b.y;
        sum_a += new_a - old_a;
        sum_b += new_b - old_b;
    }
    shift[a] += sum_a / capacity;
    shift[b] += sum_b / capacity;
    changed[a] = changed[b] = 1;
}

__kernel void ccvt_recentre(const int sites, const int capacity, __global double *offsets,
                            __global double2 *shift, __global int *changed, __global double2 *moved,
                            __global double *radius)
{
    const int site = get_global_id(0);
    if (site >= sites || !changed[site]) return;
    __global double *x = offsets + (size_t)site * 2 * capacity, *y = x + capacity;
    const double2 centroid = shift[site];
    double2 sum = (double2)(0.0, 0.0);
    double widest = 0.0;
    int k = 0;
#if LANES > 1
    REALV sum_x = 0.0, sum_y = 0.0, squares = 0.0;
    for (; k + LANES <= capacity; k += LANES) {
        const REALV ox = LOADV(x, k) - centroid.x, oy = LOADV(y, k) - centroid.y;
        STOREV(ox, x, k);
        STOREV(oy, y, k);
        sum_x += ox;
        sum_y += oy;
        squares = fmax(squares, ox * ox + oy * oy);
    }
    REAL each[LANES];
    STOREV(squares, each, 0);
    for (int lane = 0; lane < LANES; lane++) widest = fmax(widest, each[lane]);
    sum = (double2)(SUM_OF(sum_x), SUM_OF(sum_y));
#endif
    for (; k < capacity; k++) {
        const double2 o = (double2)(x[k], y[k]) - centroid;
        x[k] = o.x;
        y[k] = o.y;
        sum += o;
        widest = fmax(widest, dot(o, o));
    }
    int turned = 0;
    if (widest > 0.25) {
        sum = (double2)(0.0, 0.0);
        widest = 0.0;
        for (k = 0; k < capacity; k++) {
            const double2 o = (double2)(x[k], y[k]), turns = rint(o);
            turned |= turns.x != 0.0 || turns.y != 0.0;
            x[k] = o.x - turns.x;
            y[k] = o.y - turns.y;
            sum += o - turns;
            widest = fmax(widest, dot(o - turns, o - turns));
        }
    }
    radius[site] = sqrt(widest);
    moved[site] = centroid;
    shift[site] = sum / capacity;
    changed[site] = 1 + turned;
}
