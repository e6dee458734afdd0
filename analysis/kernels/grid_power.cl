/* Power from the transform of a real grid: |T(f)|^2 times the squared gains of the axes, over the norm of its set.
 *
 * The transform is [set][f_0][..][f_last >= 0], complex, cycles of a leading axis a wrapped at wrap_a numbers. One
 * work-item takes one f_0 (one f, if there is only one axis), and writes the power at f and -f; the output is the
 * cube, or its half with f_0 >= 0. Sets are added up, or stand set_size numbers apart.
 */
static ulong wrapped(const int f, const uint wrap)
{
    return f < 0 ? f + wrap : f;
}

__kernel void grid_power(__global const REAL *transform, const ulong transform_size, const uint length,
                         const uint wrap_0, const uint wrap_1, const int fmax, const uint sets,
                         __global const SUM *norm, const uint first_set, __global const SUM *gain,
                         const uint half_only, __global SUM *out, const ulong set_size)
{
    const int f0 = (int)get_global_id(0) - (AXES == 1 ? 0 : fmax);
    if (f0 > fmax) return;
    const ulong base = 2 * fmax + 1;
#if AXES == 1
    const ulong rest = 1, start = half_only ? fmax : 0;
#elif AXES == 2
    const ulong rest = base, start = half_only ? fmax * rest : 0;
#else
    const ulong rest = base * base, start = half_only ? fmax * rest : 0;
#endif
    const ulong last = base * rest - 1;
    for (uint s = 0; s < sets; s++) {
        __global SUM *to = out + (first_set + s) * set_size;
        const uint add = set_size == 0 && first_set + s > 0;
        const SUM over = 1 / norm[first_set + s];
#if AXES < 3
        const int low_1 = 0, high_1 = 0;
#else
        const int low_1 = -fmax, high_1 = fmax;
#endif
        for (int f1 = low_1; f1 <= high_1; f1++) {
#if AXES == 1
            __global const REAL *line = transform + s * transform_size;
            const SUM by = over;
            const int low = f0, high = f0;
            const ulong at = fmax;
#else
            const ulong number = AXES == 2 ? wrapped(f0, wrap_0) : wrapped(f0, wrap_0) * wrap_1 + wrapped(f1, wrap_1);
            __global const REAL *line = transform + s * transform_size + number * length * 2;
            const SUM by = over * gain[abs(f0)] * (AXES == 3 ? gain[abs(f1)] : 1);
            /* f_last = 0 has both f and -f among its lines: the later one writes both */
            const int low = f0 > 0 || (f0 == 0 && f1 >= 0) ? 0 : 1, high = fmax;
            const ulong at = (f0 + fmax) * rest + (AXES == 3 ? (f1 + fmax) * base : 0) + fmax;
#endif
            for (int f = low; f <= high; f++) {
                const SUM re = line[2 * f], im = line[2 * f + 1];
                const SUM power = (re * re + im * im) * (by * gain[f]);
                const ulong plus = at + f, minus = last - plus;
                if (plus >= start) to[plus - start] = add ? to[plus - start] + power : power;
                if (minus >= start && minus != plus) to[minus - start] = add ? to[minus - start] + power : power;
            }
        }
    }
}
