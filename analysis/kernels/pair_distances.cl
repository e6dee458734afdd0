/* Counts pairs of points on a torus by their distance, in bins of equal width.
 *
 * A work-item takes `rows` points of x one after the other and meets each with `ranges` windows of the columns,
 * LANES at a time; `windows` holds their ends, [range][begins, ends][point]. x and the columns are [axis][point] in
 * shares of a side. A distance d falls in the bin (uint)(d * per_length + edge); all that lie beyond fall in the last
 * of its bins + 1 counts, which no other work-item touches.
 *
 * WHOLE, 3 * 2^51, added and subtracted, rounds a difference to whole sides: rint is a call on PoCL. Less 1 where
 * that rounded upwards, a bin plus WHOLE has its number in its low bits: lanes are not converted one by one. In
 * double alone. Needs vector.cl.
 */
__kernel void pair_distances(__global const REAL *restrict x, __global const REAL *restrict columns,
                             __global const REAL *restrict sides, __global const uint *restrict windows,
                             const uint n, const uint stride, const uint ranges, const uint rows,
                             const REAL per_length, const REAL edge, const uint bins, __global uint *restrict counts)
{
    const uint item = get_global_id(0), first = item * rows;
    const uint last = first + rows < n ? first + rows : n;
    __global uint *const own = counts + (ulong)item * (bins + 1);
    for (uint b = 0; b <= bins; b++)
        own[b] = 0;
    for (uint i = first; i < last; i++)
        for (uint k = 0; k < ranges; k++) {
            const uint end = windows[(ulong)(2 * k + 1) * n + i];
            for (uint j = windows[(ulong)(2 * k) * n + i]; j < end; j += LANES) {
                REALV squared = (REALV)0;
                for (uint a = 0; a < DIM; a++) {
                    REALV step = x[(ulong)a * n + i] - LOADV(columns, (ulong)a * stride + j);
                    step = (step - ((step + (REALV)WHOLE) - (REALV)WHOLE)) * sides[a];
                    squared += step * step;
                }
                const REALV bin = sqrt(squared) * per_length + edge;
                const REALV near = bin < (REALV)bins ? bin : (REALV)bins;
                const REALV whole = near + (REALV)WHOLE;
                REAL lane[LANES];
                STOREV(whole - (REALV)WHOLE > near ? whole - (REALV)1 : whole, lane, 0);
                if (end - j >= LANES)
                    for (uint l = 0; l < LANES; l++)
                        own[(uint)as_ulong(lane[l])]++;
                else
                    for (uint l = 0; l < end - j; l++)
                        own[(uint)as_ulong(lane[l])]++;
            }
        }
}
