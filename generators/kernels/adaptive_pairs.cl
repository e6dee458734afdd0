/* Sums over neighbours of Gaussians of variance v_k + v_l: G = (2 pi w)^(-AXES / 2) exp(-r^2 / 2 w), w = v_k + v_l,
 * their slopes by x_k, and by v_k (Ahmed, Ren & Wonka 2022, Eq. 28 to 32). The pair k = l counts.
 *
 * Sources are [axis][stride], relative to the lower corner of the box that holds them, sorted by levels of their
 * variance, within a level by cells in rows along the last axis; a level's cells have sides of their own, so that the
 * neighbours of a point are a few runs of sources in each level. A work-item sums for `chunk` targets, which are
 * numbers of sources. found holds slopes by each axis, by v, and sums, each [targets]. LANES sources past the
 * last one can be read.
 */
__kernel void adaptive_pairs(const uint targets, const uint chunk, __global const uint *target, const uint stride,
                             __global const REAL *at, __global const REAL *variances, const uint levels,
                             __global const REAL *sides, __global const REAL *widest, __global const int *counts,
                             __global const uint *offsets, __global const uint *starts, const REAL reach,
                             __global REAL *found)
{
    REAL numbers[LANES];
    for (int i = 0; i < LANES; i++) numbers[i] = i;
    const REALV lane = LOADV(numbers, 0);
    const uint begin = get_global_id(0) * chunk, end = begin + chunk < targets ? begin + chunk : targets;
    __global const REAL *last_axis = at + (AXES - 1) * stride;
    for (uint k = begin; k < end; k++) {
        const uint own = target[k];
        REAL here[AXES];
        for (int a = 0; a < AXES; a++) here[a] = at[a * stride + own];
        const REAL v = variances[own], x = here[AXES - 1];
        REALV total = (REALV)0, by_v = (REALV)0, slope_x = (REALV)0, slope_y = (REALV)0;
#if AXES == 3
        REALV slope_z = (REALV)0;
#endif
        for (uint m = 0; m < levels; m++) {
            const REAL side = sides[m], per_side = 1 / side, r2_most = reach * reach * (v + widest[m]), r = sqrt(r2_most);
            __global const int *count = counts + AXES * m;
            int low[AXES], high[AXES];
            for (int a = 0; a < AXES - 1; a++) {
                low[a] = here[a] > r ? (int)((here[a] - r) * per_side) : 0;
                high[a] = (int)((here[a] + r) * per_side);
                high[a] = high[a] < count[a] ? high[a] : count[a] - 1;
            }
#if AXES == 3
            for (int p = low[0]; p <= high[0]; p++) {
                const REAL from_p = p * side, gap_p = here[0] < from_p ? from_p - here[0]
                                                      : here[0] > from_p + side ? here[0] - from_p - side : (REAL)0;
                const REAL left_p = r2_most - gap_p * gap_p;
#else
            {
                const int p = 0;
                const REAL left_p = r2_most;
#endif
                for (int q = low[AXES - 2]; q <= high[AXES - 2]; q++) {
                    const REAL from_q = q * side, y = here[AXES - 2];
                    const REAL gap_q = y < from_q ? from_q - y : y > from_q + side ? y - from_q - side : (REAL)0;
                    const REAL left = left_p - gap_q * gap_q;
                    if (left <= 0) continue;
                    const REAL chord = sqrt(left);
                    const int c0 = x > chord ? (int)((x - chord) * per_side) : 0, c = (int)((x + chord) * per_side);
                    const int c1 = c < count[AXES - 1] ? c : count[AXES - 1] - 1;
                    if (c1 < c0) continue;
                    __global const uint *row = starts + offsets[m] + (size_t)(p * count[AXES - 2] + q) * count[AXES - 1];
                    const uint from = row[c0], to = row[c1 + 1];
                    for (uint l = from; l < to; l += LANES) {
                        const REALV dx = x - LOADV(last_axis, l), dy = y - LOADV(at + (AXES - 2) * stride, l);
                        REALV r2 = dx * dx + dy * dy;
#if AXES == 3
                        const REALV dz = here[0] - LOADV(at, l);
                        r2 += dz * dz;
#endif
                        const REALV over = (REAL)1 / (v + LOADV(variances, l)), half_r2 = (REAL)0.5 * r2 * over;
                        REALV g = exp2_negative(half_r2 * (REAL)-1.4426950408889634074) * over;
#if AXES == 3
                        g *= sqrt(over);
#endif
                        g = lane < (REALV)(REAL)(to - l) ? g : (REALV)0;
                        const REALV force = g * over;
                        total += g;
                        by_v += force * (half_r2 - (REAL)(AXES * 0.5));
                        slope_x -= force * dx;
                        slope_y -= force * dy;
#if AXES == 3
                        slope_z -= force * dz;
#endif
                    }
                }
            }
        }
        const REAL unit = AXES == 3 ? (REAL)0.063493635934240969 : (REAL)0.15915494309189535; /* (2 pi)^(-AXES/2) */
#if AXES == 3
        found[k] = unit * SUM_OF(slope_z);
#endif
        found[(AXES - 2) * targets + k] = unit * SUM_OF(slope_y);
        found[(AXES - 1) * targets + k] = unit * SUM_OF(slope_x);
        found[AXES * targets + k] = unit * SUM_OF(by_v);
        found[(AXES + 1) * targets + k] = unit * SUM_OF(total);
    }
}
