/* Transform of points in the plane by way of a real grid, and the power of its lowest harmonics; needs
 * fourier_passes.cl, grid_cells.cl and grid_spread.cl.
 *
 * plane_rows: a work-item carries points to one band of a grid after another, always in the same memory, which so
 * stays in the cache, and transforms the band's rows there. A row of `nodes` numbers is transformed as half as many
 * complex ones, z_j = x_2j + i x_2j+1, of which the harmonics of the even and the odd numbers are
 * (Z_f +- conj Z_-f) / 2. Those of f = 0 .. fmax are written as tiles: at [row / TILE][f] the complex numbers of TILE
 * rows.
 *
 * plane_columns: one work-item transforms TILE columns and writes their powers at all f_0, and at -f. Its last
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

/* Transforms TILE rows, of which the first begins at `at`, and writes their harmonics. */
static void transform_rows(__global const REAL *at, const size_t row_length, const uint nodes,
                           __global const uint *radices, __global const REAL *twiddles, __global const REAL *turns,
                           const uint harmonics, __global VECTOR *to, __local COMPLEX *memory)
{
    const uint length = nodes / 2;
    for (size_t j = 0; j < length; j++, at += 2) {
        COMPLEX z;
        z.re = STRIDED(VECTOR, at, row_length);
        z.im = STRIDED(VECTOR, at + 1, row_length);
        memory[j] = z;
    }
    __local COMPLEX *z = passes(memory, memory + length + 1, length, radices, twiddles);
    z[length] = z[0];
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

__kernel void plane_rows(__global const TURN *points, const uint stride, __global const REAL *weight,
                         const uint weight_stride, __global const uint *starts, const uint bands,
                         __global const uint *crowds, __global const REAL *means, const uint nodes,
                         const uint rows_a_band, const uint sets, const uint row_length,
                         __constant REAL *terms, __global REAL *grids,
                         __global REAL *parts, const ulong band_size,
                         __global const uint *radices, __global const REAL *twiddles, __global const REAL *turns,
                         const uint harmonics, __global REAL *transforms, const ulong transform_size,
                         __local COMPLEX *memory)
{
    __global REAL *grid = grids + get_global_id(0) * band_size, *part = parts + get_global_id(0) * band_size;
    for (uint one = get_global_id(0); one < bands * sets; one += get_global_size(0)) {
        const uint set = one / bands, band = one % bands, first = band * rows_a_band, runs = RUNS_OF(crowds, set);
        if (runs == 0) continue;
        const uint rows = first + rows_a_band < nodes ? rows_a_band : nodes - first;
        spread_band(set, band, points, stride, weight, weight_stride, starts, bands, runs, means[set], nodes,
                    rows_a_band, row_length, terms, grid, part);
        for (uint row = 0; row < rows; row += TILE)
            transform_rows(grid + (size_t)row * row_length, row_length, nodes, radices, twiddles, turns, harmonics,
                           (__global VECTOR *)(transforms + set * transform_size)
                               + 2 * (size_t)(first + row) / TILE * harmonics,
                           memory);
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

__kernel void plane_columns(const uint sets, __global const SUM *over, const uint first_set, const uint half_only,
                            __global SUM *out, const ulong set_size, __global const REAL *transforms,
                            const ulong transform_size, const uint harmonics, const uint nodes,
                            __global const uint *radices, __global const REAL *twiddles, const int fmax,
                            __global const SUM *gain, __local COMPLEX *memory, __local SUMS *sums)
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
