/* Transform of real grids in the plane, and the power of its lowest harmonics; needs fourier_passes.cl.
 *
 * transform_rows: one work-item transforms TILE rows of a grid, a row of `nodes` numbers as half as many complex ones,
 * z_j = x_2j + i x_2j+1, of which the harmonics of the even and the odd numbers are (Z_f +- conj Z_-f) / 2. It writes
 * those of f = 0 .. fmax as tiles: at [rows / TILE][f] the complex numbers of TILE rows.
 *
 * transform_columns: one work-item transforms TILE columns and writes their powers at all f_0, and at -f. Its last
 * pass, of radix 4, makes only the first and the last quarter of the harmonics, among which are all that are wanted.
 * Sets are added up to those of the batches before, or stand set_size numbers apart.
 */
#define SUMS JOIN(SUM, TILE)
#define TO_SUMS JOIN(convert_, SUMS)
#if TILE == 4
#define STRIDED(TYPE, at, step) (TYPE)((at)[0], (at)[step], (at)[2 * (step)], (at)[3 * (step)])
#define EACH_LANE(DO) DO(0) DO(1) DO(2) DO(3)
#else
#define STRIDED(TYPE, at, step)                                                                               \
    (TYPE)((at)[0], (at)[step], (at)[2 * (step)], (at)[3 * (step)], (at)[4 * (step)], (at)[5 * (step)],    \
     (at)[6 * (step)], (at)[7 * (step)])
#define EACH_LANE(DO) DO(0) DO(1) DO(2) DO(3) DO(4) DO(5) DO(6) DO(7)
#endif

__kernel void transform_rows(__global const REAL *grids, const ulong grid_size, const uint row_length,
                             const uint nodes, __global const uint *radices, __global const REAL *twiddles,
                             __global const REAL *turns, const uint harmonics, __global REAL *transforms,
                             const ulong transform_size, __local COMPLEX *memory)
{
    const size_t tile = get_global_id(0), set = get_global_id(1), length = nodes / 2, row = row_length;
    __global const REAL *at = grids + set * grid_size + tile * TILE * row;
    for (size_t j = 0; j < length; j++, at += 2) {
        COMPLEX z;
        z.re = STRIDED(VECTOR, at, row);
        z.im = STRIDED(VECTOR, at + 1, row);
        memory[j] = z;
    }
    __local COMPLEX *z = passes(memory, memory + length + 1, length, radices, twiddles);
    z[length] = z[0];
    __global VECTOR *to = (__global VECTOR *)(transforms + set * transform_size) + 2 * tile * harmonics;
    for (size_t f = 0; f < harmonics; f++, to += 2) {
        const COMPLEX p = z[f], m = z[length - f];
        COMPLEX even, odd;
        even.re = p.re + m.re;
        even.im = p.im - m.im;
        odd.re = p.im + m.im;
        odd.im = m.re - p.re;
        const COMPLEX found = times(plus(even, turned(odd, turns + 2 * f)), (REAL)0.5);
        to[0] = found.re;
        to[1] = found.im;
    }
}

/* Powers of a set's columns, over its norm, are added to `sums`, or written. */
static void add_power(const COMPLEX found, const SUM over, __local SUMS *sum, const uint add)
{
    const SUMS re = TO_SUMS(found.re), im = TO_SUMS(found.im), power = (re * re + im * im) * over;
    *sum = add ? *sum + power : power;
}

#define COLUMN(lane)                                                                                         \
    {                                                                                                        \
        COMPLEX z;                                                                                           \
        z.re = STRIDED(VECTOR, from + lane, 2 * TILE);                                                       \
        z.im = STRIDED(VECTOR, from + TILE + lane, 2 * TILE);                                                \
        memory[tile * TILE + lane] = z;                                                                      \
    }
#define WRITE(lane)                                                                                          \
    if (column + lane <= fmax && (f >= 0 || column + lane > 0)) {                                            \
        __global SUM *plus_f = out + (at - start + lane), *minus_f = out + (last - at - start - lane);       \
        if (plus_wanted) *plus_f = add ? *plus_f + power.s##lane : power.s##lane;                            \
        if (minus_wanted && plus_f != minus_f) *minus_f = add ? *minus_f + power.s##lane : power.s##lane;    \
    }

__kernel void transform_columns(__global const REAL *transforms, const ulong transform_size, const uint harmonics,
                                const uint nodes, __global const uint *radices, __global const REAL *twiddles,
                                const int fmax, const uint sets, __global const SUM *over, const uint first_set,
                                __global const SUM *gain, const uint half_only, __global SUM *out,
                                const ulong set_size, __local COMPLEX *memory, __local SUMS *sums)
{
    const int column = get_global_id(0) * TILE, quarter = nodes / 4;
    const long base = 2 * fmax + 1, last = base * base - 1, start = half_only ? fmax * base : 0;
    const SUMS gains = STRIDED(SUMS, gain + column, 1);
    for (uint set = 0; set < sets; set++) {
        const uint adding = set_size == 0 && set > 0;
        for (size_t tile = 0; tile < nodes / TILE; tile++) {
            __global const REAL *from = transforms + set * transform_size + 2 * TILE * (tile * harmonics + column);
            EACH_LANE(COLUMN)
        }
        __local const COMPLEX *x = passes(memory, memory + nodes, nodes, radices, twiddles);
        const SUM by = over[first_set + set];
        for (int k = 0; k < quarter; k++, x += 4) {
            const COMPLEX a = plus(x[0], x[2]), b = minus(x[0], x[2]), c = plus(x[1], x[3]), d = minus(x[1], x[3]);
            if (k <= fmax) add_power(plus(a, c), by, sums + (k + fmax), adding);
            if (quarter - k <= fmax) add_power(plus_i(b, d), by, sums + (k - quarter + fmax), adding);
        }
        if (set_size == 0 && set + 1 < sets) continue;
        const uint add = set_size == 0 && first_set > 0;
        __global SUM *const whole = out;
        out += (first_set + set) * set_size;
        for (int f = -fmax; f <= fmax; f++) {
            const SUMS power = sums[f + fmax] * (gains * gain[abs(f)]);
            const long at = (f + fmax) * base + fmax + column;
            const uint plus_wanted = !half_only || f >= 0, minus_wanted = !half_only || f <= 0;
            EACH_LANE(WRITE)
        }
        out = whole;
    }
}
