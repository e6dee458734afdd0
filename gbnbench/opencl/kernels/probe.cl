/* One of each operation that our kernels do on vectors: loads, integer phases, conversions, selects, sums,
 * stores. One work-item computes LANES values; opencl/width_probe.py compares them with the same in numpy. */
__kernel void probe(__global const REAL *a, __global const TURN *b, __global REAL *out)
{
    REALV x = LOADV(a, 0);
    TURNV p = LOADV_TURNS(b, 0);
    TURNV q = p + (p << 3);
    REALV y = TO_REALV(AS_STURNV(q >> 4));
    y = ((q & (TURN)1) != (TURNV)0) ? y : -y;
    REALV sum = (REALV)0;
    for (int k = 0; k < 4; k++)
        sum += x * a[k] + y * (REAL)0.25;
    sum = sum - rint(sum) + fabs(x);
    STOREV(sum, out, 0);
}
