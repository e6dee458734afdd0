/* Points of sets, dealt out to the bands of their grids (grid_spread.cl); needs turn_rows.cl and grid_cells.cl.
 *
 * One work-item takes a set. It writes the turns of the points (turn_rows.cl, a part of `each` points after another) and
 * counts the points of every bin. A bin is as wide as a window on each axis, the last axis fastest, so that a node
 * is reached from no more than 2^AXES bins. Where the fullest bin has more than CROWDED points, the points are to be
 * summed in several runs. Then, or where `sorted` says so, they are brought in the order of their bins, with the
 * weights if `weighted`, and each band's first point is found. `room` and `places` are for that alone. A set whose fullest
 * bin has more than `most_crowd` points is given up: it has 0 runs.
 */
__kernel void deal_points(__global const ulong *x, __global const REAL *weight, __global REAL *dealt_weight,
                          const uint weight_stride, const uint weighted, const uint sets, const uint most_crowd,
                          const uint n, const uint stride, const uint nodes, const uint bands,
                          const uint rows_a_band, const uint sorted, const uint most_runs, const uint each,
                          const uint items, __global TURN *turns, __global SUM *lost, __global uint *starts,
                          __global uint *crowds, __global uint *places, __global uint *counts, __global TURN *room)
{
    const uint set = get_global_id(0), along = (nodes + WIDTH - 1) / WIDTH;
    if (set >= sets) return;
    const ulong line = AXES == 1 ? 1 : AXES == 2 ? along : (ulong)along * along, bins = line * along;
    x += (ulong)set * n * AXES;
    turns += (ulong)set * AXES * stride;
    starts += (ulong)set * (bands + 1);
    places += (ulong)set * n;
    counts += set * bins;
    room += (ulong)set * n;
    for (uint item = 0; item < items; item++) {
        const uint end = (item + 1) * each;
        write_turns(x, n, AXES, item * each, end < stride ? end : stride, stride, turns,
                    lost + 2 * ((ulong)set * items + item));
    }

    for (ulong bin = 0; bin < bins; bin++) counts[bin] = 0;
    for (uint k = 0; k < n; k++) {
        REAL place;
        uint bin = 0;
        for (uint a = 0; a < AXES; a++)
            bin = bin * along + cell_of(turns[(ulong)a * stride + k], nodes, &place) / WIDTH;
        places[k] = bin;
        counts[bin]++;
    }
    uint crowd = 0, runs = 1;
    for (ulong bin = 0; bin < bins; bin++)
        if (counts[bin] > crowd) crowd = counts[bin];
    if (crowd > CROWDED)
        while (runs < most_runs && (ulong)(runs + 1) * (runs + 1) <= crowd) runs++;
    crowds[2 * set] = crowd;
    RUNS_OF(crowds, set) = crowd > most_crowd ? 0 : runs;
    starts[0] = 0;
    for (uint band = 1; band <= bands; band++) starts[band] = n;
    if (crowd > most_crowd) return;

    if (weighted) {
        weight += (ulong)set * weight_stride;
        dealt_weight += (ulong)set * n;
        for (uint k = 0; k < n; k++) dealt_weight[k] = weight[k];
    }
    if (AXES == 1 || !(sorted || runs > 1)) return;
    uint first = 0;
    for (ulong bin = 0; bin < bins; bin++) {
        const uint held = counts[bin];
        counts[bin] = first;
        first += held;
    }
    for (uint band = 1; band < bands; band++) starts[band] = counts[band * (rows_a_band / WIDTH) * line];
    for (uint k = 0; k < n; k++) places[k] = counts[places[k]]++;
    for (uint a = 0; a < AXES; a++) {
        __global TURN *row = turns + (ulong)a * stride;
        for (uint k = 0; k < n; k++) room[places[k]] = row[k];
        for (uint k = 0; k < n; k++) row[k] = room[k];
    }
    if (weighted)
        for (uint k = 0; k < n; k++) dealt_weight[places[k]] = weight[k];
}
