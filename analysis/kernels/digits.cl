/* Pairs of table entries for the frequencies of two groups, by digits (Ahmed, Ren & Wonka 2022, App. C).
 *
 * Index i of a group has digits g_0 (most significant) .. g_{axes-1} of bases 2 F_a + 1, so that
 * f_a = g_a - F_a. Digits before the axis `at` make the leading entry of the pair, and digits behind it the
 * trailing one. The axis `at` itself is B h + l with B = 2 fine + 1; h goes to the leading entry, and l,
 * |l| <= fine, to the trailing one.
 *
 * One work-item decodes one frequency. It writes its leading entry, counted from the centre, and its
 * trailing one. Frequencies come in order from the centre up (f = 0, then one half space), or as listed.
 * `groups` holds for each group its number of frequencies, its number of axes, `at`, `fine`, and whether it
 * is listed.
 */
#define FIELDS 5

__kernel void digits(__global uint *code, __global const uint *groups, __global const uint *largest,
                     __global const ulong *listed)
{
    uint j = get_global_id(0);
    __global const uint *group = groups;
    __global uint *out = code + j;
    if (j >= group[0]) {
        j -= group[0];
        largest += group[1];
        listed += group[4] ? group[0] : 0;
        group += FIELDS;
        if (j >= group[0]) return;
    }
    const uint axes = group[1], at = group[2], fine = group[3];
    ulong index = j;
    if (group[4]) {
        index = listed[j];
    } else {
        ulong size = 1;
        for (uint a = 0; a < axes; a++)
            size *= 2 * largest[a] + 1;
        index += size / 2;
    }
    const uint split = 2 * fine + 1;
    uint lead = 0, trail = 0, lead_size = 1, trail_size = 1;
    for (uint a = axes; a-- > 0;) {
        const uint base = 2 * largest[a] + 1;
        const uint digit = index % base;
        index /= base;
        if (a > at) {
            trail += digit * trail_size;
            trail_size *= base;
        } else if (a < at) {
            lead += digit * lead_size;
            lead_size *= base;
        } else {
            const uint coarse = (largest[a] - fine + split - 1) / split;
            const uint shifted = digit + fine + coarse * split - largest[a];
            trail += shifted % split * trail_size;
            lead = shifted / split;
            lead_size = 2 * coarse + 1;
        }
    }
    *out = (lead - lead_size / 2) << 16 | trail;
}
