/* Sums of Gaussians at places: sum over sources l of w_l exp(-r^2 / 2 v_l).
 *
 * Sources lie as in core/neighbour_grid.py: [axis][stride], relative to `corner`, sorted by levels of their variance,
 * within a level by cells in rows along the last axis. Places are [axis][places]; a work-item sums for `chunk` of
 * them. LANES sources past the last one can be read.
 */
__kernel void kernel_sums(const uint places, const uint chunk, __global const REAL *at, const uint stride,
                          __global const REAL *sources, __global const REAL *weights,
                          __global const REAL *variances, const uint levels, __global const REAL *sides,
                          __global const REAL *widest, __global const int *counts, __global const uint *offsets,
                          __global const uint *starts, const REAL reach, __global REAL *found)
{
    REAL numbers[LANES];
    for (int i = 0; i < LANES; i++) numbers[i] = i;
    const REALV lane = LOADV(numbers, 0);
    const uint begin = get_global_id(0) * chunk, end = begin + chunk < places ? begin + chunk : places;
    __global const REAL *last_axis = sources + (AXES - 1) * stride;
    for (uint k = begin; k < end; k++) {
        REAL here[AXES];
        for (int a = 0; a < AXES; a++) here[a] = at[a * places + k];
        const REAL x = here[AXES - 1], y = here[AXES - 2];
        SUM total = 0;
        for (uint m = 0; m < levels; m++) {
            const REAL side = sides[m], per_side = 1 / side, square = reach * reach * widest[m], r = sqrt(square);
            __global const int *count = counts + AXES * m;
            int low[AXES], high[AXES];
            for (int a = 0; a < AXES - 1; a++) {
                low[a] = here[a] > r ? (int)((here[a] - r) * per_side) : 0;
                high[a] = here[a] + r < 0 ? -1 : (int)((here[a] + r) * per_side);
                high[a] = high[a] < count[a] ? high[a] : count[a] - 1;
            }
#if AXES == 3
            for (int p = low[0]; p <= high[0]; p++) {
                const REAL from_p = p * side, above = from_p - here[0], below = here[0] - from_p - side;
                const REAL gap_p = above > 0 ? above : below > 0 ? below : (REAL)0;
                const REAL left_p = square - gap_p * gap_p;
#else
            {
                const int p = 0;
                const REAL left_p = square;
#endif
                for (int q = low[AXES - 2]; q <= high[AXES - 2]; q++) {
                    const REAL from_q = q * side, above = from_q - y, below = y - from_q - side;
                    const REAL gap_q = above > 0 ? above : below > 0 ? below : (REAL)0;
                    const REAL left = left_p - gap_q * gap_q;
                    if (left <= 0) continue;
                    const REAL chord = sqrt(left);
                    const int c0 = x > chord ? (int)((x - chord) * per_side) : 0;
                    const int c = x + chord < 0 ? -1 : (int)((x + chord) * per_side);
                    const int c1 = c < count[AXES - 1] ? c : count[AXES - 1] - 1;
                    if (c1 < c0) continue;
                    __global const uint *row = starts + offsets[m] + (size_t)(p * count[AXES - 2] + q) * count[AXES - 1];
                    const uint from = row[c0], to = row[c1 + 1];
                    REALV part = (REALV)0;
                    for (uint l = from; l < to; l += LANES) {
                        const REALV dx = x - LOADV(last_axis, l), dy = y - LOADV(sources + (AXES - 2) * stride, l);
                        REALV r2 = dx * dx + dy * dy;
#if AXES == 3
                        const REALV dz = here[0] - LOADV(sources, l);
                        r2 += dz * dz;
#endif
                        const REALV g = exp2_negative((REAL)-0.72134752044448170368 * r2 / LOADV(variances, l));
                        part += lane < (REALV)(REAL)(to - l) ? g * LOADV(weights, l) : (REALV)0;
                    }
                    total += SUM_OF(part);
                }
            }
        }
        found[k] = total;
    }
}
