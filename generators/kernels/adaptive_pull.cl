/* phi = integral of T(y) G(x - y; v) dy at points of variance v, and its slopes by x and by v.
 *
 * T is sampled at several levels (attraction.py): level m at cells of `cells`, smoothed by `smoothed` already, its
 * first sample at `firsts`; level 0 serves the narrowest kernels and level m those of width resolution 2^m and more.
 * The sum over samples within `reach` standard deviations is separable: weights along each axis, at most WIDE of
 * them, and one product a sample. Points are [axis][stride]. found holds slopes by each axis, by v, and phi, each
 * [stride]. LANES values past the last one can be read.
 */
typedef struct { int first, count; REAL weight[WIDE], offset[WIDE]; } LINE;

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
        const REALV w = exp2_negative(d * d * scale);
        STOREV(lane < (REALV)(REAL)(to->count - i) ? w : (REALV)0, to->weight, i);
        STOREV(d, to->offset, i);
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
    REAL sum = 0, slope[AXES], squares = 0;
    for (int a = 0; a < AXES; a++) slope[a] = 0;
#if AXES == 3
    for (int h = 0; h < along[0].count; h++) {
        const REAL weight_h = along[0].weight[h], dz = along[0].offset[h];
        const size_t plane = (size_t)(along[0].first + h) * count[1];
#else
    {
        const REAL weight_h = 1, dz = 0;
        const size_t plane = 0;
#endif
        for (int i = 0; i < rows->count; i++) {
            __global const REAL *row = values + offsets[m] + (plane + rows->first + i) * count[AXES - 1] + columns->first;
            REALV part = (REALV)0, part_x = (REALV)0, part_xx = (REALV)0;
            for (int j = 0; j < columns->count; j += LANES) {
                const REALV d = LOADV(columns->offset, j), t = LOADV(row, j) * LOADV(columns->weight, j), td = t * d;
                part += t;
                part_x += td;
                part_xx += td * d;
            }
            const REAL weight = weight_h * rows->weight[i], dy = rows->offset[i], in_row = SUM_OF(part) * weight;
            sum += in_row;
            slope[AXES - 1] += SUM_OF(part_x) * weight;
            slope[AXES - 2] += in_row * dy;
#if AXES == 3
            slope[0] += in_row * dz;
#endif
            squares += SUM_OF(part_xx) * weight + in_row * (dy * dy + dz * dz);
        }
    }
    const REAL over = 1 / v, gauss = AXES == 3 ? (REAL)0.063493635934240969 * over * sqrt(over)
                                               : (REAL)0.15915494309189535 * over;
    const REAL unit = gauss * volume;
    for (int a = 0; a < AXES; a++) found[a * stride + k] = -unit * slope[a] * over;
    found[AXES * stride + k] = unit * ((REAL)0.5 * squares * over * over - (REAL)(AXES * 0.5) * sum * over);
    found[(AXES + 1) * stride + k] = unit * sum;
}
