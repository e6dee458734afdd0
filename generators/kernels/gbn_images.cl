/* Energy and gradient of Gaussian Blue Noise over all pairs, each dimension's theta function as a sum over
 * images: theta(u) = sum_j exp(-(u + j L)^2 / 2) in sigmas (Ahmed, Ren & Wonka 2022, Eq. 22), the IMAGES
 * nearest of them.
 *
 * With u brought to [-L/2, L/2], the nearest image is exp(-u^2/2) and the others, in order of distance, are
 * exp(-m L (m L / 2 -+ |u|)) of it, m = 1, 1, 2, 2, ...: one exp for the nearest of all dimensions together
 * and one for each further image, none of which can overflow. e_k = sum_l prod_a theta_a with the pair k =
 * l.
 *
 * at (sets * n, DIM): turns in float, so that displacements are exact and nearest by integer wrap; in
 * double, sides from the nearest integer. One work-item sums LANES points of one set over all points of the
 * set, in chunks of CHUNK. Needs vector.cl and exp2.cl; rows and items as in gbn_theta.cl.
 */
#if DOUBLE
#define PLACE REAL
#define PLACEV REALV
#define GATHER_PLACES GATHER
#define NEAREST 6755399441055744.0 /* 1.5 * 2^52: adding and subtracting it rounds to an integer */
static REALV displacement(REALV k, REAL l)
{
    const REALV u = k - l;
    return u - ((u + NEAREST) - NEAREST);
}
#else
#define PLACE TURN
#define PLACEV TURNV
#define GATHER_PLACES GATHER_TURNS
static REALV displacement(TURNV k, TURN l)
{
    return TO_REALV(AS_STURNV(k - l));
}
#endif

/* side is L in sigmas, scale what brings a displacement to sigmas. */
__kernel void gbn_images(__global const PLACE *restrict at, const uint sets, const uint n, const uint stride,
                         const uint items, const REAL side, const REAL scale,
                         __global REAL *restrict gradient,
                         __global REAL *restrict energy)
{
    const uint set = get_global_id(0) / items;
    const uint k = (get_global_id(0) - set * items) * LANES;
    if (set >= sets || k >= stride) return;
    __global const PLACE *restrict points = at + (ulong)set * n * DIM;
    PLACEV here[DIM];
    REALV forces[DIM], total = (REALV)0;
    #pragma unroll
    for (int a = 0; a < DIM; a++) {
        here[a] = GATHER_PLACES(points + (ulong)k * DIM + a, DIM);
        forces[a] = (REALV)0;
    }
    for (uint first = 0; first < n; first += CHUNK) {
        const uint last = first + CHUNK < n ? first + CHUNK : n;
        REALV force[DIM], sum = (REALV)0;
        #pragma unroll
        for (int a = 0; a < DIM; a++)
            force[a] = (REALV)0;
        for (uint l = first; l < last; l++) {
            REALV u[DIM], square = (REALV)0;
            #pragma unroll
            for (int a = 0; a < DIM; a++) {
                u[a] = displacement(here[a], points[(ulong)l * DIM + a]) * scale;
                square += u[a] * u[a];
            }
            REALV g = exp2_negative(square * (REAL)-0.72134752044448170368);
#if IMAGES == 1
            #pragma unroll
            for (int a = 0; a < DIM; a++)
                force[a] -= g * u[a];
#else
            REALV value[DIM], slope[DIM];
            #pragma unroll
            for (int a = 0; a < DIM; a++) {
                const REALV far = u[a] < (REAL)0 ? -u[a] : u[a];
                REALV pull = (REALV)0;
                value[a] = (REALV)1;
                #pragma unroll
                for (int image = 1; image < IMAGES; image++) {
                    const REAL m = (image + 1) / 2, shift = m * side;
                    const REALV rest = image % 2 ? (REAL)0.5 * shift - far : (REAL)0.5 * shift + far;
                    const REALV y = exp2_negative(shift * rest * (REAL)-1.4426950408889634074);
                    value[a] += y;
                    pull += (image % 2 ? shift : -shift) * y;
                }
                /* g: all dimensions before */
                slope[a] = ((u[a] < (REAL)0 ? -pull : pull) - u[a] * value[a]) * g;
                g *= value[a];
            }
            REALV after = (REALV)1;
            #pragma unroll
            for (int a = DIM - 1; a >= 0; a--) {
                force[a] += slope[a] * after;
                after *= value[a];
            }
#endif
            sum += g;
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
