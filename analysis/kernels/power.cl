/* Power |F|^2 / n of the whole cube from the amplitudes of one quarter of it (product.cl).
 *
 * One work-item writes the quarter's (fa, fb), (fa, -fb) and the mirror images of both.
 */
__kernel void power(__global const SUM *amplitude, const uint rows, const uint stride_a, const uint columns,
                    const uint stride_b, const SUM n, __global SUM *out)
{
    const uint j = get_global_id(0);
    const uint i = get_global_id(1);
    if (i >= rows || j >= columns) return;
    const ulong plane = (ulong)stride_a * stride_b;
    __global const SUM *at = amplitude + (ulong)i * stride_b + j;
    const SUM same = (at[0] * at[0] + at[plane] * at[plane]) / n;
    const SUM opposite = (at[2 * plane] * at[2 * plane] + at[3 * plane] * at[3 * plane]) / n;
    const ulong width = 2 * (ulong)columns - 1;
    const ulong height = 2 * (ulong)rows - 1;
    const ulong last = height * width - 1;
    const ulong row = (rows - 1 + i) * width;
    const ulong plus = row + columns - 1 + j;
    const ulong minus = row + columns - 1 - j;
    out[plus] = same;
    out[last - plus] = same;
    out[minus] = opposite;
    out[last - minus] = opposite;
}
