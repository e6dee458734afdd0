/* Frequencies of a group of dimensions by base-(2F+1) digits (Ahmed, Ren & Wonka 2022, App. C).
 *
 * Index i in 0 .. base^DIM - 1 has digits g_0 (most significant) .. g_{DIM-1}, and f_a = g_a - F. Indices from
 * the centre up are f = 0 and one half space. One work-item decodes the j-th of them, stored as f_a mod a turn's
 * units, so that f_a * x wraps exactly; beyond count it stores f = 0.
 */
__kernel void digits(__global TURN *frequency, const ulong first, const uint count, const uint stride,
                     const uint dim, const ulong base)
{
    const uint j = get_global_id(0);
    if (j >= stride) return;
    ulong index = first + j;
    for (uint a = dim; a-- > 0;) {
        const ulong digit = index % base;
        index /= base;
        frequency[a * stride + j] = j < count ? (TURN)(digit - base / 2) : (TURN)0;
    }
}
