/* Power |F(f)|^2 / n at listed frequencies, F(f) = sum_k exp(-2 pi i f.x_k) with exact phases.
 *
 * One work-item sums LANES frequencies over all points, SUM_POINTS at a time, and those sums in SUM.
 */
__kernel void selected(__global const TURN *frequency, __global const TURN *x, __global SUM *out,
                       const uint stride, const uint dim, const ulong n)
{
    const uint j = get_global_id(0) * LANES;
    if (j >= stride) return;
    SUM re[LANES], im[LANES];
    for (int v = 0; v < LANES; v++)
        re[v] = im[v] = 0;
    for (ulong first = 0; first < n; first += SUM_POINTS) {
        const ulong last = min(first + SUM_POINTS, n);
        REALV cosines = (REALV)0, sines = (REALV)0;
        for (ulong k = first; k < last; k++) {
            TURNV phase = (TURNV)0;
            for (uint a = 0; a < dim; a++)
                phase += LOADV_TURNS(frequency, a * stride + j) * x[a * n + k];
            REALV c, s;
            cos_sin_of_turn(phase, &c, &s);
            cosines += c;
            sines += s;
        }
        REAL part[2 * LANES];
        STOREV(cosines, part, 0);
        STOREV(sines, part, LANES);
        for (int v = 0; v < LANES; v++) {
            re[v] += part[v];
            im[v] += part[LANES + v];
        }
    }
    for (int v = 0; v < LANES; v++)
        out[j + v] = (re[v] * re[v] + im[v] * im[v]) / n;
}
