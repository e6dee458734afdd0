/* Sites moved to the centroids of their samples after a pass of ccvt_swap.cl, whose words these are.
 *
 * One work-item takes one changed site: its offsets are from the centroid from now on, brought back to
 * [-1/2, 1/2] where they are longer (then changed is 2), moved is what they were shifted by, and shift what
 * still lacks to the centroid: rounding, or the effect of those brought back. Boxes and radius are anew.
 */
#define SUM double

__kernel void ccvt_recentre(const int sites, const int capacity, const int chunks, __global double *offsets,
                            __global double *boxes, __global double2 *shift, __global int *changed,
                            __global double2 *moved, __global double *radius)
{
    const int site = get_global_id(0);
    if (site >= sites || !changed[site]) return;
    __global double *x = offsets + (size_t)site * 2 * capacity, *y = x + capacity;
    __global double *box = boxes + (size_t)site * 4 * chunks;
    const double2 centroid = shift[site];
    double2 sum = (double2)(0.0, 0.0);
    double widest = 0.0;
    int turned = 0;
    for (int chunk = 0; chunk < chunks; chunk++) {
        int k = chunk * CHUNK;
        const int stop = min(k + CHUNK, capacity);
        double least_x = 1e300, least_y = 1e300, most_x = -1e300, most_y = -1e300;
#if LANES > 1
        REALV sum_x = 0.0, sum_y = 0.0, squares = 0.0;
        REALV low_x = 1e300, low_y = 1e300, high_x = -1e300, high_y = -1e300;
        for (; k + LANES <= stop; k += LANES) {
            const REALV ox = LOADV(x, k) - centroid.x, oy = LOADV(y, k) - centroid.y;
            STOREV(ox, x, k);
            STOREV(oy, y, k);
            sum_x += ox;
            sum_y += oy;
            const REALV square = ox * ox + oy * oy;
            squares = LARGER(squares, square);
            low_x = SMALLER(low_x, ox);
            low_y = SMALLER(low_y, oy);
            high_x = LARGER(high_x, ox);
            high_y = LARGER(high_y, oy);
        }
        REAL each[5 * LANES];
        STOREV(squares, each, 0);
        STOREV(low_x, each, LANES);
        STOREV(low_y, each, 2 * LANES);
        STOREV(high_x, each, 3 * LANES);
        STOREV(high_y, each, 4 * LANES);
        for (int lane = 0; lane < LANES; lane++) {
            widest = LARGER(widest, each[lane]);
            least_x = SMALLER(least_x, each[LANES + lane]);
            least_y = SMALLER(least_y, each[2 * LANES + lane]);
            most_x = LARGER(most_x, each[3 * LANES + lane]);
            most_y = LARGER(most_y, each[4 * LANES + lane]);
        }
        sum += (double2)(SUM_OF(sum_x), SUM_OF(sum_y));
#endif
        for (; k < stop; k++) {
            const double2 o = (double2)(x[k], y[k]) - centroid;
            const double square = o.x * o.x + o.y * o.y;
            x[k] = o.x;
            y[k] = o.y;
            sum += o;
            widest = LARGER(widest, square);
            least_x = SMALLER(least_x, o.x);
            least_y = SMALLER(least_y, o.y);
            most_x = LARGER(most_x, o.x);
            most_y = LARGER(most_y, o.y);
        }
        if (least_x < -0.5 || least_y < -0.5 || most_x > 0.5 || most_y > 0.5) {
            for (k = chunk * CHUNK; k < stop; k++) {
                const double2 o = (double2)(x[k], y[k]), turns = rint(o);
                turned |= turns.x != 0.0 || turns.y != 0.0;
                x[k] = o.x - turns.x;
                y[k] = o.y - turns.y;
                sum -= turns;
            }
            least_x = least_y = -0.5;
            most_x = most_y = 0.5;
        }
        box[chunk] = least_x;
        box[chunks + chunk] = most_x;
        box[2 * chunks + chunk] = least_y;
        box[3 * chunks + chunk] = most_y;
    }
    radius[site] = sqrt(widest);
    moved[site] = centroid;
    shift[site] = sum / capacity;
    changed[site] = 1 + turned;
}
