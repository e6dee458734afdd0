/* Mean and spread of power over shells of equal |f|^2, from the pairs of a block (pair_power in power.cl).
 *
 * One work-item takes every `strips`-th row. For each shell it keeps the number of frequencies of the half
 * space that it met, their mean power, and the sum of squared departures from it (Welford 1962); the host
 * merges these. A pair stands for (fa, fb) and (fa, -fb). Where fa or fb is 0 these are one frequency or
 * mirror images, and count once. DC is left out.
 */
__kernel void shells(__global const SUM *power, __global const uint *bounds, const uint rows,
                     const uint stride, __global const uint *square_a, __global const uint *square_b,
                     const uint low, const uint high, const SUM sets, __global SUM *out,
                     __global uint *counts)
{
    const uint strip = get_global_id(0);
    const uint strips = get_global_size(0);
    __global SUM *bins = out + (ulong)strip * (high - low + 1) * 2;
    __global uint *count = counts + (ulong)strip * (high - low + 1);
    for (uint i = strip; i < rows; i += strips) {
        const uint tile = i / ROWS;
        for (uint j = bounds[2 * tile]; j < bounds[2 * tile + 1]; j++) {
            const uint square = square_a[i] + square_b[j];
            if (square < low || square > high || square == 0) continue;
            __global const SUM *pair = power + ((ulong)i * stride + j) * 2;
            __global SUM *bin = bins + (ulong)(square - low) * 2;
            const uint distinct = square_a[i] > 0 && square_b[j] > 0 ? 2 : 1;
            for (uint k = 0; k < distinct; k++) {
                const SUM p = pair[k] / sets;
                const uint met = ++count[square - low];
                const SUM away = p - bin[0];
                const SUM mean = bin[0] + away / met;
                bin[0] = mean;
                bin[1] += away * (p - mean);
            }
        }
    }
}
