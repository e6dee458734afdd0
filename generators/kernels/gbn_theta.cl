/* Energy and gradient of Gaussian Blue Noise over all pairs, by a polynomial for each dimension's theta
 * function.
 *
 * theta(u) = 1 + 2 sum_{f >= 1} w_f cos 2 pi f u (Ahmed, Ren & Wonka 2022, Eq. 23; printed there over all f,
 * the identity needs twice the sum over f >= 1) is 1 + q(c), c = cos 2 pi u, q of degree DEGREE, and u = x_k
 * - x_l: c and sin 2 pi u come from the cosines and sines of the points, so a pair needs no exp and no cos.
 *
 * e_k = sum_l (prod_a theta_a - 1): the product is kept without its mean, p <- p + q (1 + p), since in high
 * dimension the mean would swallow the digits. The slope by x_a leaves dimension a out of the product, by
 * those before it and those after it. Where FLAT, products are 1 to the precision, and only sums are left; q
 * is then in units of its first weight, which may be too small for REAL.
 *
 * One work-item sums LANES points of one set over all points of the set, in chunks of CHUNK, so that sums of
 * many float terms keep their digits. Work-items of a set: items. Point k's row of gradient is k + set *
 * stride.
 */
__kernel void gbn_theta(__global const REAL *restrict circle, const uint sets, const uint n,
                        const uint stride,
                        const uint items, __global const REAL *restrict weight,
                        __global REAL *restrict gradient,
                        __global REAL *restrict energy)
{
    const uint set = get_global_id(0) / items;
    const uint k = (get_global_id(0) - set * items) * LANES;
    if (set >= sets || k >= stride) return;
    __global const REAL *restrict points = circle + (ulong)set * n * (2 * DIM);
    REALV w[DEGREE + 1], ck[DIM], sk[DIM], forces[DIM], total = (REALV)0;
    #pragma unroll
    for (int f = 0; f <= DEGREE; f++)
        w[f] = (REALV)weight[f];
    #pragma unroll
    for (int a = 0; a < DIM; a++) {
        ck[a] = GATHER(points + (ulong)k * (2 * DIM) + 2 * a, 2 * DIM);
        sk[a] = GATHER(points + (ulong)k * (2 * DIM) + 2 * a + 1, 2 * DIM);
        forces[a] = (REALV)0;
    }
    for (uint first = 0; first < n; first += CHUNK) {
        const uint last = first + CHUNK < n ? first + CHUNK : n;
        REALV force[DIM], sum = (REALV)0;
        #pragma unroll
        for (int a = 0; a < DIM; a++)
            force[a] = (REALV)0;
        for (uint l = first; l < last; l++) {
            __global const REAL *restrict at = points + (ulong)l * (2 * DIM);
            REALV q[DIM], slope[DIM], p = (REALV)0;
            #pragma unroll
            for (int a = 0; a < DIM; a++) {
                const REALV c = ck[a] * at[2 * a] + sk[a] * at[2 * a + 1];
                const REALV s = sk[a] * at[2 * a] - ck[a] * at[2 * a + 1];
                REALV value = w[DEGREE], rise = w[DEGREE]; /* Horner's scheme for q and for dq/dc */
                #pragma unroll
                for (int f = DEGREE - 1; f >= 1; f--) {
                    value = value * c + w[f];
                    rise = rise * c + value;
                }
                q[a] = value * c + w[0];
#if FLAT
                force[a] += rise * s;
                p += q[a];
#else
                const REALV before = (REAL)1 + p;
                slope[a] = rise * s * before;
                p += q[a] * before;
#endif
            }
            sum += p;
#if !FLAT
            REALV after = (REALV)1;
            #pragma unroll
            for (int a = DIM - 1; a >= 0; a--) {
                force[a] += slope[a] * after;
                after += q[a] * after;
            }
#endif
        }
        total += sum;
        #pragma unroll
        for (int a = 0; a < DIM; a++)
            forces[a] += force[a];
    }
    __global REAL *out = gradient + ((ulong)set * stride + k) * DIM;
    #pragma unroll
    for (int a = 0; a < DIM; a++)
        SPREAD(forces[a], out + a, DIM);
    STOREV(total, energy, (ulong)set * stride + k);
}
