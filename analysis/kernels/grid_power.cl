/* Power from the transform of a real grid: |T(f)|^2 times the squared gains of the axes, over the norm of its set.
 *
 * The transform is [set][f_0][..][f_last >= 0], complex, cycles of a leading axis a wrapped at wrap_a numbers. One
 * work-item takes one line of f_last, and writes the power at f and -f; the output is the cube, or its half with
 * f_0 >= 0. Sets are added up to those of the batches before, or stand set_size numbers apart.
 */
#define REAL4 JOIN(REAL, 4)
#define SUM4 JOIN(SUM, 4)
#define TO_SUM4 JOIN(convert_, SUM4)
#define EVEN4(p) ((REAL4)((p)[0], (p)[2], (p)[4], (p)[6]))
#define LOAD4(p) ((SUM4)((p)[0], (p)[1], (p)[2], (p)[3]))

static uint wrapped(const int f, const uint wrap)
{
    return f < 0 ? f + wrap : f;
}

/* Power of one frequency, or of four in a row, summed over the sets of a batch. */
static SUM power_at(__global const REAL *at, const ulong size, const uint sets, __global const SUM *over)
{
    SUM total = 0;
    for (uint s = 0; s < sets; s++, at += size) {
        const SUM re = at[0], im = at[1];
        total += (re * re + im * im) * over[s];
    }
    return total;
}

static SUM4 power4_at(__global const REAL *at, const ulong size, const uint sets, __global const SUM *over)
{
    SUM4 total = (SUM4)0;
    for (uint s = 0; s < sets; s++, at += size) {
        const SUM4 re = TO_SUM4(EVEN4(at)), im = TO_SUM4(EVEN4(at + 1));
        total += (re * re + im * im) * over[s];
    }
    return total;
}

static void write(__global SUM *to, const SUM power, const uint add)
{
    *to = add ? *to + power : power;
}

__kernel void grid_power(__global const REAL *transform, const ulong transform_size, const uint length,
                         const uint wrap_0, const uint wrap_1, const int fmax, const uint sets,
                         __global const SUM *over, const uint first_set, __global const SUM *gain,
                         const uint half_only, __global SUM *out, const ulong set_size)
{
    const ulong base = 2 * fmax + 1;
    const int f0 = AXES == 1 ? 0 : (int)get_global_id(0) - fmax;
    const int f1 = AXES < 3 ? 0 : (int)get_global_id(1) - fmax;
#if AXES == 1
    const ulong rest = 1, line = 0, at = fmax;
    const uint plus_wanted = 1, minus_wanted = !half_only;
    const SUM by = 1;
#else
    const ulong rest = AXES == 2 ? base : base * base;
    const ulong line = (AXES == 2 ? wrapped(f0, wrap_0) : (ulong)wrapped(f0, wrap_0) * wrap_1 + wrapped(f1, wrap_1));
    const ulong at = (f0 + fmax) * rest + (AXES == 3 ? (f1 + fmax) * base : 0) + fmax;
    const uint plus_wanted = !half_only || f0 >= 0, minus_wanted = !half_only || f0 <= 0;
    const SUM by = gain[abs(f0)] * (AXES == 3 ? gain[abs(f1)] : 1);
#endif
    const ulong last = base * rest - 1, start = half_only ? fmax * rest : 0;
    /* f_last = 0 has both f and -f among its lines: the later one writes both */
    const int low = f0 > 0 || (f0 == 0 && f1 >= 0) ? 0 : 1;
    /* all sets of a batch at once, or one after another */
    const uint together = set_size == 0 ? sets : 1, add = set_size == 0 && first_set > 0;
    for (uint s = 0; s < sets; s += together) {
        __global const REAL *of = transform + s * transform_size + line * length * 2;
        __global SUM *plus = out + (first_set + s) * set_size + at - start;
        __global SUM *minus = out + (first_set + s) * set_size + last - at - start;
        int f = low;
        for (; f + 3 <= fmax; f += 4) {
            const SUM4 power = power4_at(of + 2 * f, transform_size, together, over + first_set + s)
                * (LOAD4(gain + f) * by);
            if (plus_wanted) {
                write(plus + f, power.s0, add);
                write(plus + f + 1, power.s1, add);
                write(plus + f + 2, power.s2, add);
                write(plus + f + 3, power.s3, add);
            }
            if (minus_wanted) {
                if (plus + f != minus - f) write(minus - f, power.s0, add);
                write(minus - f - 1, power.s1, add);
                write(minus - f - 2, power.s2, add);
                write(minus - f - 3, power.s3, add);
            }
        }
        for (; f <= fmax; f++) {
            const SUM power = power_at(of + 2 * f, transform_size, together, over + first_set + s) * (gain[f] * by);
            if (plus_wanted) write(plus + f, power, add);
            if (minus_wanted && plus + f != minus - f) write(minus - f, power, add);
        }
    }
}
