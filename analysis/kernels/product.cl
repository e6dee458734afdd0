/* Amplitudes F(fa, fb) and F(fa, -fb) from two groups' tables as a real product, tile by tile.
 *
 * With alpha = 2 pi fa.xa and beta = 2 pi fb.xb the four sums over points of cos alpha cos beta, sin sin,
 * sin cos and cos sin give both amplitudes; Hermitian symmetry gives the other two quadrants. One work-item holds
 * ROWS rows of the leading group by LANES columns of the trailing one in registers, sums SUM_POINTS points at a
 * time, and adds each such sum to the amplitudes in double where the device has it (the type SUM).
 */
__kernel void product(__global const REAL *cos_a, __global const REAL *sin_a, const uint stride_a,
                      __global const REAL *cos_b, __global const REAL *sin_b, const uint stride_b,
                      __global SUM *amplitude, const uint points)
{
    const uint j = get_global_id(0) * LANES;
    const uint i = get_global_id(1) * ROWS;
    if (j >= stride_b || i >= stride_a) return;
    const ulong plane = (ulong)stride_a * stride_b;
    for (uint first = 0; first < points; first += SUM_POINTS) {
        const uint last = min(first + SUM_POINTS, points);
        REALV cc[ROWS], ss[ROWS], sc[ROWS], cs[ROWS];
        for (int r = 0; r < ROWS; r++)
            cc[r] = ss[r] = sc[r] = cs[r] = (REALV)0;
        for (uint k = first; k < last; k++) {
            const REALV cb = LOADV(cos_b, (ulong)k * stride_b + j);
            const REALV sb = LOADV(sin_b, (ulong)k * stride_b + j);
            for (int r = 0; r < ROWS; r++) {
                const REAL ca = cos_a[(ulong)k * stride_a + i + r];
                const REAL sa = sin_a[(ulong)k * stride_a + i + r];
                cc[r] += ca * cb;
                ss[r] += sa * sb;
                sc[r] += sa * cb;
                cs[r] += ca * sb;
            }
        }
        for (int r = 0; r < ROWS; r++) {
            REAL part[4 * LANES];
            STOREV(cc[r], part, 0);
            STOREV(ss[r], part, LANES);
            STOREV(sc[r], part, 2 * LANES);
            STOREV(cs[r], part, 3 * LANES);
            __global SUM *out = amplitude + (ulong)(i + r) * stride_b + j;
            for (int v = 0; v < LANES; v++) {
                const SUM tcc = part[v], tss = part[LANES + v], tsc = part[2 * LANES + v], tcs = part[3 * LANES + v];
                out[v] += tcc - tss;
                out[plane + v] += tsc + tcs;
                out[2 * plane + v] += tcc + tss;
                out[3 * plane + v] += tsc - tcs;
            }
        }
    }
}
