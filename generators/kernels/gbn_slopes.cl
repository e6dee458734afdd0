/* Slopes of gbn_harmonics.cl along the AXES axes of one group: with T_i = sum_j C_ij other_j at each point,
 * sum_i T_i (own_i)' where the wave's derivative along an axis is factor times the row partner, (rows, axes)
 * both. C's columns end at reach[i / TILE_A]. Gradient (sets, stride, DIM), axes from first on. One
 * work-item does 2 LANES points. Needs vector.cl. */
__kernel void gbn_slopes(__global const REAL *restrict own, const uint start, const uint pitch,
                         __global const REAL *restrict other, const uint other_start, const uint other_pitch,
                         const uint sets, const uint stride, const uint rows, const uint others,
                         __global const uint *reach,
                         __global const REAL *restrict c, __global const uint *partner,
                         __global const REAL *factor,
                         const uint first, __global REAL *restrict gradient)
{
    const uint pairs = stride / (2 * LANES);
    const uint set = get_global_id(0) / pairs;
    const uint k = (get_global_id(0) - set * pairs) * (2 * LANES);
    if (set >= sets) return;
    __global const REAL *restrict po = own + ((ulong)set * pitch + start) * stride + k;
    __global const REAL *restrict pb = other + ((ulong)set * other_pitch + other_start) * stride + k;
    __global const REAL *restrict pc = c + (ulong)set * rows * others;
    REALV slope[AXES][2];
    #pragma unroll
    for (int a = 0; a < AXES; a++)
        slope[a][0] = slope[a][1] = (REALV)0;
    for (uint i = 0; i < rows; i += TILE) {
        REALV t[TILE][2];
        #pragma unroll
        for (int r = 0; r < TILE; r++)
            t[r][0] = t[r][1] = (REALV)0;
        const uint end = reach[i / TILE];
        for (uint j = 0; j < end; j++) {
            const REALV left = LOADV(pb, (ulong)j * stride), right = LOADV(pb, (ulong)j * stride + LANES);
            #pragma unroll
            for (int r = 0; r < TILE; r++) {
                const REAL coefficient = pc[(i + r) * others + j];
                t[r][0] += coefficient * left;
                t[r][1] += coefficient * right;
            }
        }
        #pragma unroll
        for (int r = 0; r < TILE; r++)
            #pragma unroll
            for (int a = 0; a < AXES; a++) {
                const REAL by = factor[(i + r) * AXES + a];
                const ulong row = (ulong)partner[(i + r) * AXES + a] * stride;
                slope[a][0] += by * t[r][0] * LOADV(po, row);
                slope[a][1] += by * t[r][1] * LOADV(po, row + LANES);
            }
    }
    __global REAL *out = gradient + ((ulong)set * stride + k) * DIM + first;
    #pragma unroll
    for (int a = 0; a < AXES; a++) {
        SPREAD(slope[a][0], out + a, DIM);
        SPREAD(slope[a][1], out + LANES * DIM + a, DIM);
    }
}
