/* Energy and gradient of Gaussian Blue Noise by the theta function of each dimension, for boxes of few spacings.
 *
 * Per dimension theta(u) = 1 + 2 sum_{f=1}^{terms} w_f cos 2 pi f u (Ahmed, Ren & Wonka 2022, Eq. 23; printed there
 * over all f, the identity needs twice the sum over f >= 1), by Clenshaw's recurrence in cos 2 pi u, which comes
 * from the points' own cosines and sines: no exp and no cos a pair. e_k = sum_l (prod_a theta - 1), kept without
 * its mean of 1 by p <- p + q + p q, since in high dimension the mean would swallow the digits. The gradient, with
 * respect to x in box sides, leaves out one dimension at a time by prefix and suffix products.
 *
 * One work-item sums LANES points over all points.
 */
__kernel void gbn_theta(__global const REAL *cosine, __global const REAL *sine, const uint n, const uint stride,
                        __constant REAL *weight, const int terms, __global REAL *gradient,
                        __global REAL *energy)
{
    const uint k = get_global_id(0) * LANES;
    if (k >= stride) return;
    REALV ck[DIM], sk[DIM], force[DIM], total = (REALV)0;
    #pragma unroll
    for (uint a = 0; a < DIM; a++) {
        ck[a] = LOADV(cosine, a * stride + k);
        sk[a] = LOADV(sine, a * stride + k);
        force[a] = (REALV)0;
    }
    for (uint l = 0; l < n; l++) {
        REALV theta[DIM], slope[DIM], p = (REALV)0;
        #pragma unroll
        for (uint a = 0; a < DIM; a++) {
            const REAL cl = cosine[a * stride + l], sl = sine[a * stride + l];
            const REALV c = ck[a] * cl + sk[a] * sl;
            const REALV s = sk[a] * cl - ck[a] * sl;
            const REALV c2 = c + c;
            REALV b1 = (REALV)0, b2 = (REALV)0, d1 = (REALV)0, d2 = (REALV)0;
            for (int f = terms; f >= 1; f--) {
                const REAL w = weight[f];
                const REALV b = w + c2 * b1 - b2;
                const REALV d = w * (REAL)f + c2 * d1 - d2;
                b2 = b1;
                b1 = b;
                d2 = d1;
                d1 = d;
            }
            const REALV q = (REAL)2 * (c * b1 - b2);
            p += q + p * q;
            theta[a] = (REAL)1 + q;
            slope[a] = s * d1; /* times -4 pi, outside */
        }
        total += p;
        REALV before = (REALV)1;
        #pragma unroll
        for (uint a = 0; a < DIM; a++) { /* slope[a] * prod_{b<a} theta[b] */
            slope[a] *= before;
            before *= theta[a];
        }
        REALV after = (REALV)1;
        #pragma unroll
        for (uint a = DIM; a-- > 0;) {
            force[a] += slope[a] * after;
            after *= theta[a];
        }
    }
    #pragma unroll
    for (uint a = 0; a < DIM; a++)
        STOREV(force[a] * (REAL)-12.566370614359172954, gradient, a * stride + k);
    STOREV(total, energy, k);
}
