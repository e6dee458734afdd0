/* log s and its slope at points, from the coefficients of a cubic spline on AXES axes (kernel_widths.py).
 *
 * Coefficients lie at the centres of pixels, `border` more beyond each end; counts hold their numbers along each
 * axis. Points are [axis][stride], in pixels, within the field or as far as half a pixel beyond. found holds log s
 * and the slopes, each [stride].
 */
static int basis(const REAL x, REAL *b, REAL *slope)
{
    const REAL shifted = x - (REAL)0.5;
    const int whole = (int)shifted, i = whole - (shifted < whole);
    const REAL t = shifted - i, u = 1 - t, sixth = (REAL)1 / 6;
    b[0] = u * u * u * sixth;
    b[1] = ((3 * t - 6) * t * t + 4) * sixth;
    b[2] = ((3 * u - 6) * u * u + 4) * sixth;
    b[3] = t * t * t * sixth;
    slope[0] = -u * u * (REAL)0.5;
    slope[1] = (3 * t - 4) * t * (REAL)0.5;
    slope[2] = -(3 * u - 4) * u * (REAL)0.5;
    slope[3] = t * t * (REAL)0.5;
    return i - 1;
}

__kernel void adaptive_widths(const uint points, const uint stride, __global const REAL *at,
                              __global const int *counts, const int border, __global const REAL *coefficients,
                              __global REAL *found)
{
    const uint k = get_global_id(0);
    if (k >= points) return;
    REAL b[AXES][4], slope[AXES][4];
    size_t first = 0;
    for (int a = 0; a < AXES; a++)
        first = first * counts[a] + (basis(at[a * stride + k], b[a], slope[a]) + border);
    const size_t row = counts[AXES - 1];
    REAL value = 0, along[AXES];
    for (int a = 0; a < AXES; a++) along[a] = 0;
#if AXES == 3
    const size_t plane = row * counts[1];
    for (int h = 0; h < 4; h++) {
        REAL plane_value = 0, plane_along[2] = {0, 0};
#else
    {
        const int h = 0;
        const size_t plane = 0;
#endif
        for (int i = 0; i < 4; i++) {
            __global const REAL *c = coefficients + first + h * plane + i * row;
            const REAL sum = c[0] * b[AXES - 1][0] + c[1] * b[AXES - 1][1] + c[2] * b[AXES - 1][2] + c[3] * b[AXES - 1][3];
            const REAL rise = c[0] * slope[AXES - 1][0] + c[1] * slope[AXES - 1][1] + c[2] * slope[AXES - 1][2]
                              + c[3] * slope[AXES - 1][3];
#if AXES == 3
            plane_value += sum * b[1][i];
            plane_along[0] += sum * slope[1][i];
            plane_along[1] += rise * b[1][i];
        }
        value += plane_value * b[0][h];
        along[0] += plane_value * slope[0][h];
        along[1] += plane_along[0] * b[0][h];
        along[2] += plane_along[1] * b[0][h];
#else
            value += sum * b[0][i];
            along[0] += sum * slope[0][i];
            along[1] += rise * b[0][i];
        }
#endif
    }
    found[k] = value;
    for (int a = 0; a < AXES; a++) found[(a + 1) * stride + k] = along[a];
}
