/* Sums over pairs of points of a product kernel less its mean: sum over j of K(x_i, x_j) - H(x_i) (discrepancy_kernels.py).
 *
 * K is the product over axes of a factor f(u, v), t = |u - v|:
 *   FORM 0   1 - max(u, v)
 *   FORM 1   top - t (1 - t) slope, the same everywhere on the torus
 *   FORM 2   p(u) + p(v) - t (slope - curve t)
 * The whole of K and H, whose sum swallows the digits of a discrepancy, is never added up: terms scatter about 0.
 *
 * One work-item takes LANES rows and the columns first .. last - 1, adds up CHUNK terms plainly and such sums with
 * the rounding kept beside (Knuth's TwoSum). x and p are [axis][point], `present` is 1 for a point and 0 for padding.
 * Needs vector.cl and turns.cl.
 */
__kernel void discrepancy_pairs(__global const REAL *restrict x, __global const REAL *restrict p,
                                __global const REAL *restrict mean, __global const REAL *restrict present,
                                const uint stride, const uint rows, const uint first, const uint last,
                                const REAL top, const REAL slope, const REAL curve,
                                __global SUM *restrict out, const ulong start)
{
    const uint item = get_global_id(0), i = item * LANES;
    if (i >= rows) return;
    const REALV h = LOADV(mean, i);
    REALV at[DIM];
    for (uint a = 0; a < DIM; a++)
        at[a] = LOADV(x, (ulong)a * stride + i);
#if FORM == 2
    REALV own[DIM];
    for (uint a = 0; a < DIM; a++)
        own[a] = LOADV(p, (ulong)a * stride + i);
#endif
    REALV total = (REALV)0, rest = (REALV)0;
    for (uint begin = first; begin < last; begin += CHUNK) {
        const uint end = begin + CHUNK < last ? begin + CHUNK : last;
        REALV sum = (REALV)0;
        for (uint j = begin; j < end; j++) {
            REALV product;
            for (uint a = 0; a < DIM; a++) {
                const REALV other = (REALV)x[(ulong)a * stride + j];
#if FORM == 0
                const REALV factor = (REALV)1 - (at[a] > other ? at[a] : other);
#else
                const REALV t = AS_REALV(AS_TURNV(at[a] - other) & (TURNV)0x7fffffffffffffffUL); /* fabs is a call on PoCL */
#if FORM == 1
                const REALV factor = top - (t - t * t) * slope;
#else
                const REALV factor = own[a] + p[(ulong)a * stride + j] - t * (slope - curve * t);
#endif
#endif
                product = a == 0 ? factor : product * factor;
            }
            sum += product - h;
        }
        const REALV before = total;
        total = before + sum;
        const REALV part = total - before;
        rest += (before - (total - part)) + (sum - part);
    }
    const REALV whole = (total + rest) * LOADV(present, i);
    out[start + item] = SUM_OF(whole);
}
