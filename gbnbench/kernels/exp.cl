/* exp(-t) for t >= 0, good to 3e-16 (double) or 2e-7 (float) relative; needs vector.cl.
 *
 * Beyond t = 700 (80 in float) it stays at exp(-700): nothing to a sum, and no denormals. The integer part of
 * -t log2 e is read off the low bits of a sum with a large constant, since vectors of doubles convert slowly; the
 * limit is a comparison, since min() is a call on the PoCL of PyPI, around which every register is spilled.
 */
static REALV exp_negative(REALV t)
{
#if DOUBLE
    const REALV x = (t > (REALV)700.0 ? (REALV)700.0 : t) * -1.4426950408889634074;
    const REALV shifted = x + 6755399441055744.0; /* 1.5 * 2^52 */
    const REALV f = (x - (shifted - 6755399441055744.0)) * 0.69314718055994530942;
    REALV p = 1.0 / 479001600;
    p = p * f + 1.0 / 39916800;
    p = p * f + 1.0 / 3628800;
    p = p * f + 1.0 / 362880;
    p = p * f + 1.0 / 40320;
    p = p * f + 1.0 / 5040;
    p = p * f + 1.0 / 720;
    p = p * f + 1.0 / 120;
    p = p * f + 1.0 / 24;
    p = p * f + 1.0 / 6;
    p = p * f + 0.5;
    p = p * f + 1.0;
    p = p * f + 1.0;
    return AS_REALV(AS_STURNV(p) + (AS_STURNV(shifted) << 52));
#else
    const REALV x = (t > (REALV)80.0f ? (REALV)80.0f : t) * -1.44269504f;
    const REALV shifted = x + 12582912.0f; /* 1.5 * 2^23 */
    const REALV f = (x - (shifted - 12582912.0f)) * 0.693147181f;
    REALV p = 1.0f / 5040;
    p = p * f + 1.0f / 720;
    p = p * f + 1.0f / 120;
    p = p * f + 1.0f / 24;
    p = p * f + 1.0f / 6;
    p = p * f + 0.5f;
    p = p * f + 1.0f;
    p = p * f + 1.0f;
    return AS_REALV(AS_STURNV(p) + (AS_STURNV(shifted) << 23));
#endif
}
