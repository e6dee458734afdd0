/* Frequencies of a group of dimensions by base-(2F+1) digits (Ahmed, Ren & Wonka 2022, App. C), as factors.
 *
 * Index i in 0 .. base^DIM - 1 has digits g_0 (most significant) .. g_{DIM-1}, and f_a = g_a - F. Indices from the
 * centre up are f = 0 and one half space. exp(i f.x) is the product over dimensions of a coarse and a fine factor,
 * g = split h + l; where split is 1 there is no fine one. One work-item decodes the j-th index into the entries of
 * tables.cl's list that are its factors; beyond count it repeats the first, f = 0.
 */
__kernel void digits(__global ushort *factor, __global const uint *split, __global const int *coarse,
                     __global const int *fine, const ulong first, const uint count, const uint stride,
                     const uint dim, const ulong base)
{
    const uint j = get_global_id(0);
    if (j >= stride) return;
    ulong index = first + (j < count ? j : 0);
    uint slot = 0;
    for (uint a = dim; a-- > 0;) {
        const uint digit = index % base;
        index /= base;
        factor[slot++ * stride + j] = coarse[a] + digit / split[a];
        if (split[a] > 1) factor[slot++ * stride + j] = fine[a] + digit % split[a];
    }
}
