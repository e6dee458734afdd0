/* 2^t for t <= 0; needs vector.cl. Good to 3e-16 (double) or 1e-7 (float) relative, and exactly 1 at 0.
 *
 * Below t = -1000 (-120 in float) the result stays at 2^-1000, which adds nothing to a sum and is no
 * denormal. The integer part is read off the low bits of a sum with a large constant, since vectors of
 * doubles convert slowly. (2^f - 1) / f on |f| <= 1/2 is interpolated at Chebyshev's nodes by a polynomial
 * whose coefficients were computed in 50 digits: within 2e-17 (double) and 6e-9 (float) of 2^f.
 */
static REALV exp2_negative(REALV t)
{
#if DOUBLE
    t = t > (REALV)-1000.0 ? t : (REALV)-1000.0;
    const REALV shifted = t + 6755399441055744.0; /* 1.5 * 2^52 */
    const REALV f = t - (shifted - 6755399441055744.0);
    REALV p = (REALV)4.45496059818651839e-10;
    p = p * f + 7.0725859492692237e-9;
    p = p * f + 1.01780624458457735e-7;
    p = p * f + 1.32154425879216897e-6;
    p = p * f + 0.0000152527338298361184;
    p = p * f + 0.000154035304417360502;
    p = p * f + 0.00133335581464169353;
    p = p * f + 0.00961812910760688853;
    p = p * f + 0.0555041086648215943;
    p = p * f + 0.240226506959100982;
    p = p * f + 0.693147180559945309;
    p = p * f + 1.0;
    return AS_REALV(AS_STURNV(p) + (AS_STURNV(shifted) << 52));
#else
    t = t > (REALV)-120.0f ? t : (REALV)-120.0f;
    const REALV shifted = t + 12582912.0f; /* 1.5 * 2^23 */
    const REALV f = t - (shifted - 12582912.0f);
    REALV p = (REALV)0.000154531629f;
    p = p * f + 0.00133908634f;
    p = p * f + 0.00961808256f;
    p = p * f + 0.0555035711f;
    p = p * f + 0.240226508f;
    p = p * f + 0.693147188f;
    p = p * f + 1.0f;
    return AS_REALV(AS_STURNV(p) + (AS_STURNV(shifted) << 23));
#endif
}
