/* Sums F(f) = sum_k w_k exp(-2 pi i f.x_k) at listed frequencies, with exact phases.
 *
 * One work-item takes one frequency and one run of points, LANES at a time, so that a few frequencies of
 * many points keep every core busy. It sums SUM_POINTS points a lane in registers, and adds up these sums in
 * SUM with their rounding kept. Output: [run][cosines, sines][frequency].
 */
static void add_kept(SUM *sum, SUM *rest, const SUM value)
{
    const SUM old = *sum;
    *sum = old + value;
    const SUM part = *sum - old;
    *rest += (old - (*sum - part)) + (value - part);
}

__kernel void selected(__global const TURN *frequency, __global const TURN *x, __global const REAL *weight,
                       __global SUM *out, const uint count, const uint dim, const uint stride,
                       const uint length)
{
    const uint j = get_global_id(0);
    const uint run = get_global_id(1);
    if (j >= count) return;
    const uint last = (run + 1) * length < stride ? (run + 1) * length : stride;
    SUM re = 0, im = 0, rest_re = 0, rest_im = 0;
    for (uint first = run * length; first < last; first += SUM_POINTS * LANES) {
        const uint end = first + SUM_POINTS * LANES < last ? first + SUM_POINTS * LANES : last;
        REALV cosines = (REALV)0, sines = (REALV)0;
        for (uint k = first; k < end; k += LANES) {
            TURNV phase = (TURNV)0;
            for (uint a = 0; a < dim; a++)
                phase += frequency[a * count + j] * LOADV_TURNS(x, (ulong)a * stride + k);
            REALV c, s;
            cos_sin_of_turn(phase, &c, &s);
            const REALV w = LOADV(weight, k);
            cosines += w * c;
            sines += w * s;
        }
        add_kept(&re, &rest_re, SUM_OF(cosines));
        add_kept(&im, &rest_im, SUM_OF(sines));
    }
    out[(2 * run) * count + j] = re + rest_re;
    out[(2 * run + 1) * count + j] = im + rest_im;
}
