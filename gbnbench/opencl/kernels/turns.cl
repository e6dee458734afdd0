/* cos and sin of phases that are exact fixed-point fractions of a turn; needs vector.cl.
 *
 * The nearest quarter turn is taken off in integers, exactly, at any size of the phase; what is left lies in
 * [-1/8, 1/8) turn, where the Taylor series end below 5e-17 (double) and 2e-9 (float).
 */
#if DOUBLE
#define RADIANS (6.283185307179586476925 / 18446744073709551616.0)
#define RADIANS_REST (2.4492935982947064e-16 / 18446744073709551616.0)
#else
#define RADIANS (6.283185307179586f / 4294967296.0f)
#define RADIANS_REST (-1.7484556e-7f / 4294967296.0f)
#endif

/* Signed turns as reals, rounded once. No CPU before AVX-512 converts vectors of 64-bit integers: the high
 * and the low half are put behind the exponents of 2^84 and 2^52, which leaves one rounding, that of their
 * sum. */
#if DOUBLE && LANES > 1 && LANES < 8
INLINE REALV real_of_turn(STURNV t)
{
    const TURNV high = (AS_TURNV(t) >> (TURN)32) ^ (TURN)0x4530000080000000;
    const TURNV low = (AS_TURNV(t) & (TURN)0xffffffff) | (TURN)0x4330000000000000;
    return (AS_REALV(high) - 19342822341709703277445120.0) + AS_REALV(low);
}
#else
#define real_of_turn TO_REALV
#endif

INLINE void cos_sin_of_turn(TURNV phase, REALV *cosine, REALV *sine)
{
    const TURN eighth = (TURN)1 << (TURN_BITS - 3);
    TURNV quarter = (phase + eighth) >> (TURN_BITS - 2);
    const REALV turn = real_of_turn(AS_STURNV(phase - (quarter << (TURN_BITS - 2))));
    REALV t = turn * (REAL)RADIANS + turn * (REAL)RADIANS_REST;
    REALV u = t * t;
#if DOUBLE
    REALV s = t - t * u * (1.0 / 6 - u * (1.0 / 120 - u * (1.0 / 5040 - u * (1.0 / 362880
        - u * (1.0 / 39916800 - u * (1.0 / 6227020800.0 - u * (1.0 / 1307674368000.0)))))));
    REALV c = 1.0 - u * (0.5 - u * (1.0 / 24 - u * (1.0 / 720 - u * (1.0 / 40320
        - u * (1.0 / 3628800 - u * (1.0 / 479001600
        - u * (1.0 / 87178291200.0 - u * (1.0 / 20922789888000.0))))))));
#else
    REALV s = t - t * u * (1.0f / 6 - u * (1.0f / 120 - u * (1.0f / 5040 - u * (1.0f / 362880))));
    REALV c = 1.0f - u * (0.5f - u * (1.0f / 24 - u * (1.0f / 720
        - u * (1.0f / 40320 - u * (1.0f / 3628800)))));
#endif
    STURNV swapped = (quarter & (TURN)1) != (TURN)0;
    STURNV cosine_negative = ((quarter + (TURN)1) & (TURN)2) != (TURN)0;
    STURNV sine_negative = (quarter & (TURN)2) != (TURN)0;
    REALV a = swapped ? s : c;
    REALV b = swapped ? c : s;
    *cosine = cosine_negative ? -a : a;
    *sine = sine_negative ? -b : b;
}
