/* Toroidal sum of Gaussians at points x: sum over centres c of the product over axes of theta(x_a - c_a).
 *
 * theta(u) is the sum over integers j of exp(-(u + j)^2 / (2 width^2)). With DEGREE 0 only the nearest image
 * counts on each axis, so one power of two serves all axes: 2^(scale |u|^2), scale = -1 / (2 width^2 ln 2).
 * Otherwise theta over its mean is a polynomial of that degree in cos 2 pi u (theta_polynomial.py). That
 * cosine is computed from cosines and sines of points and centres, so that no pair takes an exp or a cos.
 *
 * One work-item takes LANES points. Points are turns, or REAL with DEGREE 0: [axis][point]. Centres are
 * their coordinates, or the cos and sin of each: [centre][axis]. Needs vector.cl, turns.cl and exp2.cl.
 */
#if DEGREE
#define COORDINATE TURN
#else
#define COORDINATE REAL
#endif

__kernel void gaussians(__global const COORDINATE *restrict x, const uint stride,
                        __global const REAL *restrict centres, const uint count,
                        __global const REAL *restrict shape, __global REAL *restrict out)
{
    const uint k = get_global_id(0) * LANES;
    if (k >= stride) return;
    REALV total = (REALV)0;
#if DEGREE
    REALV cosine[DIM], sine[DIM];
    for (uint a = 0; a < DIM; a++)
        cos_sin_of_turn(LOADV_TURNS(x, (ulong)a * stride + k), &cosine[a], &sine[a]);
    for (uint j = 0; j < count; j++) {
        __global const REAL *centre = centres + j * 2 * DIM;
        REALV product = (REALV)shape[DEGREE + 1]; /* theta's mean, of all axes */
        for (uint a = 0; a < DIM; a++) {
            const REALV c = cosine[a] * centre[2 * a] + sine[a] * centre[2 * a + 1];
            REALV theta = (REALV)shape[DEGREE];
            for (int power = DEGREE - 1; power >= 0; power--)
                theta = theta * c + shape[power];
            product *= theta;
        }
        total += product;
    }
#else
    const REAL round = (REAL)6755399441055744.0; /* 1.5 * 2^52: adding it leaves whole numbers */
    const REAL scale = shape[0];
    REALV at[DIM];
    for (uint a = 0; a < DIM; a++)
        at[a] = LOADV(x, (ulong)a * stride + k);
    for (uint j = 0; j < count; j++) {
        REALV square = (REALV)0;
        for (uint a = 0; a < DIM; a++) {
            const REALV u = at[a] - centres[j * DIM + a];
            const REALV nearest = u - ((u + round) - round);
            square += nearest * nearest;
        }
        total += exp2_negative(square * scale);
    }
#endif
    STOREV(total, out, k);
}
