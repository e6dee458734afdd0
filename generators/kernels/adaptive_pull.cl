/* phi = integral of T(y) G(x - y; v) dy at points of variance v, and its slopes by x and by v.
 *
 * T is sampled at several levels (attraction.py): level m at cells of `cells`, smoothed by `smoothed` already, its
 * first sample at `firsts`; level 0 serves the narrowest kernels and level m those of width resolution 2^m and more.
 * The sum over samples within `reach` standard deviations is separable: weights along each axis, at most WIDE of
 * them, and one product a sample. Points are [axis][stride]. found holds slopes by each axis, by v, and phi, each
 * [stride]. LANES values past the last one can be read.
 */
typedef struct { int first, count; REAL weight[WIDE], by_offset[WIDE], by_square[WIDE]; } LINE; /* w, w d, w d^2 */

INLINE void line(LINE *to, const REAL x, const REAL first, const REAL cell, const int count, const REAL v, const REAL reach)
{
    const REAL at = (x - first) / cell, far = reach * sqrt(v) / cell;
    const int low = at > far ? (int)(at - far) + 1 : 0, most = (int)(at + far);
    const int high = most < count ? most : count - 1;
    to->first = low;
    to->count = high - low + 1 > WIDE ? WIDE : high - low + 1;
    REAL numbers[LANES];
    for (int i = 0; i < LANES; i++) numbers[i] = i;
    const REALV lane = LOADV(numbers, 0);
    const REAL scale = (REAL)-0.72134752044448170368 / v; /* -log2(e) / 2 */
    for (int i = 0; i < to->count; i += LANES) {
        const REALV d = (at - (REALV)(REAL)(low + i) - lane) * cell;
        const REALV w = lane < (REALV)(REAL)(to->count - i) ? exp2_negative(d * d * scale) : (REALV)0, wd = w * d;
        STOREV(w, to->weight, i);
        STOREV(wd, to->by_offset, i);
        STOREV(wd * d, to->by_square, i);
    }
}

__kernel void adaptive_pull(const uint points, const uint stride, __global const REAL *x, __global const REAL *variances,
                            const uint levels, __global const REAL *cells, __global const REAL *smoothed,
                            __global const REAL *firsts, __global const int *counts, __global const ulong *offsets,
                            __global const REAL *values, const REAL resolution, const REAL reach, __global REAL *found)
{
    const uint k = get_global_id(0);
    if (k >= points) return;
    const REAL s = sqrt(variances[k]);
    uint m = 0;
    while (m + 1 < levels && s >= resolution * (2u << m)) m++;
    const REAL v = variances[k] - smoothed[m];
    __global const int *count = counts + AXES * m;
    LINE along[AXES];
    REAL volume = 1;
    for (int a = 0; a < AXES; a++) {
        line(along + a, x[a * stride + k], firsts[AXES * m + a], cells[AXES * m + a], count[a], v, reach);
        volume *= cells[AXES * m + a];
    }
    const LINE *columns = along + AXES - 1, *rows = along + AXES - 2;
    REALV sum = (REALV)0, sum_x = (REALV)0, sum_y = (REALV)0, sum_z = (REALV)0, squares = (REALV)0;
#if AXES == 3
    for (int h = 0; h < along[0].count; h++) {
        const REAL w_h = along[0].weight[h], wz = along[0].by_offset[h], wzz = along[0].by_square[h];
        const size_t plane = (size_t)(along[0].first + h) * count[1];
#else
    {
        const REAL w_h = 1, wz = 0, wzz = 0;
        const size_t plane = 0;
#endif
        for (int i = 0; i < rows->count; i++) {
            __global const REAL *row = values + offsets[m] + (plane + rows->first + i) * count[AXES - 1] + columns->first;
            REALV part = (REALV)0, part_x = (REALV)0, part_xx = (REALV)0;
            for (int j = 0; j < columns->count; j += LANES) {
                const REALV t = LOADV(row, j);
                part += t * LOADV(columns->weight, j);
                part_x += t * LOADV(columns->by_offset, j);
                part_xx += t * LOADV(columns->by_square, j);
            }
            const REAL w_i = rows->weight[i], w = w_h * w_i;
            sum += part * w;
            sum_x += part_x * w;
            sum_y += part * (w_h * rows->by_offset[i]);
#if AXES == 3
            sum_z += part * (wz * w_i);
#endif
            squares += part_xx * w + part * (w_h * rows->by_square[i] + wzz * w_i);
        }
    }
    const REAL over = 1 / v, gauss = AXES == 3 ? (REAL)0.063493635934240969 * over * sqrt(over)
                                               : (REAL)0.15915494309189535 * over;
    const REAL unit = gauss * volume;
#if AXES == 3
    found[k] = -unit * SUM_OF(sum_z) * over;
#endif
    found[(AXES - 2) * stride + k] = -unit * SUM_OF(sum_y) * over;
    found[(AXES - 1) * stride + k] = -unit * SUM_OF(sum_x) * over;
    found[AXES * stride + k] = unit * ((REAL)0.5 * SUM_OF(squares) * over * over - (REAL)(AXES * 0.5) * SUM_OF(sum) * over);
    found[(AXES + 1) * stride + k] = unit * SUM_OF(sum);
}
