/* Discrete Fourier transforms of lengths 2^a 3^b 5^c, TILE of them at once in the lanes of vectors.
 *
 * Stockham's passes of radix 2, 3, 4, 5 and 8, from one half of local memory to the other, which leave the harmonics
 * in their order. In a pass of radix r, after passes whose radices multiply to `done`, element i + step (q + r k) of
 * the source, q < r, k < done, step = length / (done r), goes to element i + step (k + done j) of the target as
 * sum_q exp(-2 pi i q j / r) x_q exp(-2 pi i j done i / length). The latter factors, the twiddles, are tabled for
 * j = 1 .. r - 1, i after i, pass after pass (transform_plan.py); in a last pass, of step 1, they are 1.
 */
#define VECTOR JOIN(REAL, TILE)

typedef struct { VECTOR re, im; } COMPLEX;

static COMPLEX plus(const COMPLEX a, const COMPLEX b)
{
    COMPLEX c;
    c.re = a.re + b.re;
    c.im = a.im + b.im;
    return c;
}

static COMPLEX minus(const COMPLEX a, const COMPLEX b)
{
    COMPLEX c;
    c.re = a.re - b.re;
    c.im = a.im - b.im;
    return c;
}

static COMPLEX plus_i(const COMPLEX a, const COMPLEX b)
{
    COMPLEX c;
    c.re = a.re - b.im;
    c.im = a.im + b.re;
    return c;
}

static COMPLEX minus_i(const COMPLEX a, const COMPLEX b)
{
    COMPLEX c;
    c.re = a.re + b.im;
    c.im = a.im - b.re;
    return c;
}

static COMPLEX times(const COMPLEX a, const REAL by)
{
    COMPLEX c;
    c.re = a.re * by;
    c.im = a.im * by;
    return c;
}

static COMPLEX turned(const COMPLEX a, __global const REAL *twiddle)
{
    COMPLEX c;
    c.re = a.re * twiddle[0] - a.im * twiddle[1];
    c.im = a.re * twiddle[1] + a.im * twiddle[0];
    return c;
}

#define AS_IT_IS(a, twiddle) (a)

/* For each element of each of the `done` transforms: x are its r sources, y its r targets, w its twiddles. */
#define EACH(RADIX)                                                                                          \
    const size_t to = step * done;                                                                           \
    for (size_t k = 0; k < done; k++, source += RADIX * step, target += step) {                              \
        __global const REAL *w = twiddles;                                                                   \
        __local const COMPLEX *x = source;                                                                   \
        __local COMPLEX *y = target;                                                                         \
        for (size_t i = 0; i < step; i++, x++, y++, w += 2 * (RADIX - 1))

#define BUTTERFLY_2(TURNED) EACH(2) {                                                                        \
        const COMPLEX a = x[0], b = x[step];                                                                 \
        y[0] = plus(a, b);                                                                                   \
        y[to] = TURNED(minus(a, b), w);                                                                      \
    } }

#define BUTTERFLY_3(TURNED) EACH(3) {                                                                        \
        const COMPLEX a = x[0], sum = plus(x[step], x[2 * step]);                                            \
        const COMPLEX turn = times(minus(x[step], x[2 * step]), (REAL)0.86602540378443864676);               \
        const COMPLEX centre = minus(a, times(sum, (REAL)0.5));                                              \
        y[0] = plus(a, sum);                                                                                 \
        y[to] = TURNED(minus_i(centre, turn), w);                                                            \
        y[2 * to] = TURNED(plus_i(centre, turn), w + 2);                                                     \
    } }

#define BUTTERFLY_4(TURNED) EACH(4) {                                                                        \
        const COMPLEX a = plus(x[0], x[2 * step]), b = minus(x[0], x[2 * step]);                             \
        const COMPLEX c = plus(x[step], x[3 * step]), d = minus(x[step], x[3 * step]);                       \
        y[0] = plus(a, c);                                                                                   \
        y[to] = TURNED(minus_i(b, d), w);                                                                    \
        y[2 * to] = TURNED(minus(a, c), w + 2);                                                              \
        y[3 * to] = TURNED(plus_i(b, d), w + 4);                                                             \
    } }

/* cosines and sines of 1/5 and 2/5 of a turn */
#define C1 (REAL)0.30901699437494742410
#define C2 (REAL)-0.80901699437494742410
#define S1 (REAL)0.95105651629515357212
#define S2 (REAL)0.58778525229247312917

#define BUTTERFLY_5(TURNED) EACH(5) {                                                                        \
        const COMPLEX a = x[0], b = plus(x[step], x[4 * step]), c = plus(x[2 * step], x[3 * step]);          \
        const COMPLEX d = minus(x[step], x[4 * step]), e = minus(x[2 * step], x[3 * step]);                  \
        const COMPLEX first = plus(a, plus(times(b, C1), times(c, C2)));                                     \
        const COMPLEX second = plus(a, plus(times(b, C2), times(c, C1)));                                    \
        const COMPLEX turn_1 = plus(times(d, S1), times(e, S2)), turn_2 = minus(times(d, S2), times(e, S1)); \
        y[0] = plus(a, plus(b, c));                                                                          \
        y[to] = TURNED(minus_i(first, turn_1), w);                                                           \
        y[2 * to] = TURNED(minus_i(second, turn_2), w + 2);                                                  \
        y[3 * to] = TURNED(plus_i(second, turn_2), w + 4);                                                   \
        y[4 * to] = TURNED(plus_i(first, turn_1), w + 6);                                                    \
    } }

/* b1 and b3 are turned by 1/8 and 3/8 of a turn backwards */
#define BUTTERFLY_8(TURNED) EACH(8) {                                                                        \
        const REAL root = 0.70710678118654752440;                                                            \
        const COMPLEX a0 = plus(x[0], x[4 * step]), b0 = minus(x[0], x[4 * step]);                           \
        const COMPLEX a1 = plus(x[step], x[5 * step]), b1 = minus(x[step], x[5 * step]);                     \
        const COMPLEX a2 = plus(x[2 * step], x[6 * step]), b2 = minus(x[2 * step], x[6 * step]);             \
        const COMPLEX a3 = plus(x[3 * step], x[7 * step]), b3 = minus(x[3 * step], x[7 * step]);             \
        const COMPLEX c0 = plus(a0, a2), c1 = minus(a0, a2), c2 = plus(a1, a3), c3 = minus(a1, a3);          \
        y[0] = plus(c0, c2);                                                                                 \
        y[4 * to] = TURNED(minus(c0, c2), w + 6);                                                            \
        y[2 * to] = TURNED(minus_i(c1, c3), w + 2);                                                          \
        y[6 * to] = TURNED(plus_i(c1, c3), w + 10);                                                          \
        const COMPLEX t1 = times(minus_i(b1, b1), root), t3 = times(plus_i(b3, b3), -root);                  \
        const COMPLEX d0 = minus_i(b0, b2), d1 = plus_i(b0, b2), e0 = plus(t1, t3), e1 = minus(t1, t3);      \
        y[to] = TURNED(plus(d0, e0), w);                                                                     \
        y[5 * to] = TURNED(minus(d0, e0), w + 8);                                                            \
        y[3 * to] = TURNED(minus_i(d1, e1), w + 4);                                                          \
        y[7 * to] = TURNED(plus_i(d1, e1), w + 12);                                                          \
    } }

#define PASS(RADIX)                                                                                          \
    static void pass_##RADIX(__local const COMPLEX *restrict source, __local COMPLEX *restrict target,       \
                             const size_t done, const size_t step, __global const REAL *twiddles)            \
    {                                                                                                        \
        if (step == 1) {                                                                                     \
            BUTTERFLY_##RADIX(AS_IT_IS)                                                                      \
        } else {                                                                                             \
            BUTTERFLY_##RADIX(turned)                                                                        \
        }                                                                                                    \
    }

PASS(2)
PASS(3)
PASS(4)
PASS(5)
PASS(8)

/* The passes whose radices are listed, up to a zero; returns the half of local memory where they end. */
static __local COMPLEX *passes(__local COMPLEX *source, __local COMPLEX *target, const uint length,
                               __global const uint *radices, __global const REAL *twiddles)
{
    size_t done = 1;
    for (; *radices != 0; radices++) {
        const size_t radix = *radices, step = length / (done * radix);
        if (radix == 8) pass_8(source, target, done, step, twiddles);
        else if (radix == 5) pass_5(source, target, done, step, twiddles);
        else if (radix == 4) pass_4(source, target, done, step, twiddles);
        else if (radix == 3) pass_3(source, target, done, step, twiddles);
        else pass_2(source, target, done, step, twiddles);
        twiddles += 2 * (radix - 1) * step;
        done *= radix;
        __local COMPLEX *reached = target;
        target = source;
        source = reached;
    }
    return source;
}
