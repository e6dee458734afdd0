/* Tables of cos and sin of 2 pi f.x for a group's frequencies and a chunk of points, packed for product.cl.
 *
 * Frequencies stand in tiles of some width; a tile holds, point after point, so many cosines and then as many sines,
 * so that the product reads every table from end to end. One work-item fills LANES frequencies (global id 0) for
 * TABLE_POINTS points (global id 1). The width is COLUMNS for the trailing group and ROWS for the leading one.
 */
__kernel void tables(__global const TURN *frequency, __global const TURN *x, __global REAL *table,
                     const uint width, const uint stride, const uint dim, const ulong n, const ulong begin,
                     const uint points)
{
    const uint j = get_global_id(0) * LANES;
    if (j >= stride) return;
    const uint first = get_global_id(1) * TABLE_POINTS;
    const uint last = first + TABLE_POINTS < points ? first + TABLE_POINTS : points;
    ulong place[LANES]; /* of each lane's cosine for point 0; found once, since division is slow */
    for (uint v = 0; v < LANES; v++)
        place[v] = (ulong)((j + v) / width) * points * 2 * width + (j + v) % width;
    const bool together = width % LANES == 0;
    for (uint k = first; k < last; k++) {
        TURNV phase = (TURNV)0;
        for (uint a = 0; a < dim; a++)
            phase += LOADV_TURNS(frequency, a * stride + j) * x[a * n + begin + k];
        REALV c, s;
        cos_sin_of_turn(phase, &c, &s);
        __global REAL *row = table + (ulong)k * 2 * width;
        if (together) {
            STOREV(c, row, place[0]);
            STOREV(s, row, place[0] + width);
        } else {
            REAL part[2 * LANES];
            STOREV(c, part, 0);
            STOREV(s, part, LANES);
            for (uint v = 0; v < LANES; v++) {
                row[place[v]] = part[v];
                row[place[v] + width] = part[LANES + v];
            }
        }
    }
}
