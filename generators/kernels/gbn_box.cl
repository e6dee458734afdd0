/* Pairs of a bounded domain: e_k = sum_l exp(-r^2/2), r in sigmas, and its gradient with respect to x_k in sigmas,
 * without periods (Ahmed, Ren & Wonka 2022, Sec. 4.6). The pair k = l adds 1 to the energy, nothing to the gradient.
 *
 * One work-item sums the LANES points from first[g] on over the runs [runs[2 r], runs[2 r + 1]) of its row of runs,
 * and writes slot g. Float takes positions as fixed point, 31 bits of a box side, so that differences are exact.
 */
#if DOUBLE
#define PLACE REAL
#define PLACES(p, i) LOADV(p, i)
#define APART(a, b) ((a) - (b))
#else
#define PLACE TURN
#define PLACES(p, i) LOADV_TURNS(p, i)
#define APART(a, b) TO_REALV(AS_STURNV((a) - (b)))
#endif

/* scale: sigmas in one unit of the positions. */
__kernel void gbn_box(__global const PLACE *restrict x, const uint stride, __global const uint *restrict first,
                      __global const uint *restrict runs, const uint each, const uint groups, const REAL scale,
                      __global REAL *restrict gradient, __global REAL *restrict energy)
{
    const uint g = get_global_id(0);
    if (g >= groups) return;
#if DOUBLE
    REALV at[DIM];
#else
    TURNV at[DIM];
#endif
    REALV force[DIM], total = (REALV)0;
    #pragma unroll
    for (uint a = 0; a < DIM; a++) {
        at[a] = PLACES(x, a * stride + first[g]);
        force[a] = (REALV)0;
    }
    for (uint r = g * each; r < (g + 1) * each; r++) {
        const uint last = runs[2 * r + 1];
        for (uint l = runs[2 * r]; l < last; l++) {
            REALV u[DIM], square = (REALV)0;
            #pragma unroll
            for (uint a = 0; a < DIM; a++) {
                u[a] = APART(at[a], x[a * stride + l]) * scale;
                square += u[a] * u[a];
            }
            const REALV pair = exp_negative(square * (REAL)0.5);
            total += pair;
            #pragma unroll
            for (uint a = 0; a < DIM; a++)
                force[a] -= pair * u[a];
        }
    }
    #pragma unroll
    for (uint a = 0; a < DIM; a++)
        STOREV(force[a], gradient, (a * groups + g) * LANES);
    STOREV(total, energy, g * LANES);
}
