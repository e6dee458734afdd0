/* Energy and gradient of Gaussian Blue Noise by the nearest image of each pair, for boxes of at least twice the
 * cut-off: e_k = sum_l exp(-r^2/2), r in sigmas, and its gradient with respect to x_k (Ahmed, Ren & Wonka 2022,
 * Eq. 18). The pair k = l adds 1 to the energy and nothing to the gradient.
 *
 * Points come ordered so that neighbours in space are near in memory; boxes hold the centre and half width of each
 * run of BOX points. One work-item sums LANES points over every box that comes within the cut-off.
 */
#if DOUBLE
#define NEAREST 6755399441055744.0 /* 1.5 * 2^52: adding and subtracting it rounds to an integer */
#else
#define NEAREST 12582912.0f
#endif
#define COORDINATE(x, a, k) (x)[(a) * stride + (k)]

/* One work-item bounds one run of BOX points on the torus: widths are taken around its first point. */
__kernel void boxes(__global const REAL *x, const uint n, const uint stride, __global REAL *box, const uint count)
{
    const uint b = get_global_id(0);
    if (b >= count) return;
    const uint first = b * BOX, last = min(first + BOX, n);
    #pragma unroll
    for (uint a = 0; a < DIM; a++) {
        const REAL origin = COORDINATE(x, a, first);
        REAL low = 0, high = 0;
        for (uint k = first + 1; k < last; k++) {
            REAL u = COORDINATE(x, a, k) - origin;
            u -= rint(u);
            low = min(low, u);
            high = max(high, u);
        }
        box[(2 * a) * count + b] = origin + (REAL)0.5 * (low + high);
        box[(2 * a + 1) * count + b] = (REAL)0.5 * (high - low);
    }
}

/* scale is the box's side in sigmas, reach the cut-off in sides. */
__kernel void gbn_nearest(__global const REAL *x, const uint n, const uint stride, __global const REAL *box,
                         const uint count, const REAL scale, const REAL reach, __global REAL *gradient,
                         __global REAL *energy)
{
    const uint k = get_global_id(0) * LANES;
    if (k >= stride) return;
    REALV at[DIM], force[DIM], total = (REALV)0;
    #pragma unroll
    for (uint a = 0; a < DIM; a++) {
        at[a] = LOADV(x, a * stride + k);
        force[a] = (REALV)0;
    }
    const uint own = k / BOX;
    for (uint b = 0; b < count; b++) {
        REAL gap2 = 0;
        #pragma unroll
        for (uint a = 0; a < DIM; a++) {
            REAL apart = box[(2 * a) * count + b] - box[(2 * a) * count + own];
            apart -= (apart + NEAREST) - NEAREST;
            apart = (apart < 0 ? -apart : apart) - box[(2 * a + 1) * count + b] - box[(2 * a + 1) * count + own];
            gap2 += apart > 0 ? apart * apart : (REAL)0;
        }
        if (gap2 > reach * reach) continue;
        const uint last = min((b + 1) * BOX, n);
        for (uint l = b * BOX; l < last; l++) {
            REALV u[DIM], half_square = (REALV)0;
            #pragma unroll
            for (uint a = 0; a < DIM; a++) {
                u[a] = at[a] - COORDINATE(x, a, l);
                u[a] = (u[a] - ((u[a] + NEAREST) - NEAREST)) * scale;
                half_square += u[a] * u[a];
            }
            const REALV g = exp_negative(half_square * (REAL)0.5);
            total += g;
            #pragma unroll
            for (uint a = 0; a < DIM; a++)
                force[a] -= g * u[a];
        }
    }
    #pragma unroll
    for (uint a = 0; a < DIM; a++)
        STOREV(force[a], gradient, a * stride + k);
    STOREV(total, energy, k);
}
