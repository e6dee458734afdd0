/* Energy and gradient of Gaussian Blue Noise in frequency space: E = (1/2n) sum_f w_f |F_f|^2, 0 < |f| <=
 * reach (Ahmed, Ren & Wonka 2022, Eq. 20).
 *
 * With the real waves of an axis 1, cos 2 pi x, sin 2 pi x, cos 4 pi x, ..., products of one wave an axis
 * have the sums R over the points, and sum_f w_f |F_f|^2 = sum W R^2, W being w_f times 2 for each axis
 * where f_a is not 0: diagonal, since w depends on |f_a| only. Dimensions stand in a leading and a trailing
 * group, whose waves are rows of two tables; a pair of rows is a frequency, and those beyond reach have W =
 * 0 and, where a whole tile of TILE_A by TILE_B rows lies there, are not in the list of tiles. The slopes
 * are gbn_slopes.cl's.
 *
 * Points of a set are padded to stride, a multiple of 2 LANES, by points whose waves are 0. Needs vector.cl,
 * turns.cl.
 */
#define SUM REAL
#define STEP 8

/* Waves of each axis: wave (sets, DIM, WAVES, stride), WAVES >= 2 FMAX + 1. Phases of each multiple of STEP,
 * and of the frequencies below it, are exact; the rest is one complex product of these. One work-item does
 * LANES points of one axis. */
__kernel void gbn_waves(__global const TURN *turns, const uint sets, const uint n, const uint stride,
                        __global REAL *wave)
{
    const uint vectors = stride / LANES;
    const uint axis = get_global_id(0) / vectors; /* of all sets */
    const uint k = (get_global_id(0) - axis * vectors) * LANES;
    if (axis >= sets * DIM) return;
    const uint set = axis / DIM, a = axis - set * DIM;
    __global REAL *out = wave + (ulong)axis * WAVES * stride;
    const TURNV turn = GATHER_TURNS(turns + ((ulong)set * n + k) * DIM + a, DIM);
    REALV low_cos[STEP], low_sin[STEP];
    for (uint r = 0; r < STEP; r++)
        cos_sin_of_turn(turn * (TURN)r, &low_cos[r], &low_sin[r]);
    for (uint high = 0; high <= FMAX; high += STEP) {
        REALV c, s;
        cos_sin_of_turn(turn * (TURN)high, &c, &s);
        for (uint r = 0; r < STEP; r++) {
            const uint f = high + r;
            if (f > FMAX) break;
            const REALV cosine = c * low_cos[r] - s * low_sin[r];
            const REALV sine = s * low_cos[r] + c * low_sin[r];
            if (f == 0)
                STOREV(cosine, out, k);
            else {
                STOREV(cosine, out, (2 * f - 1) * stride + k);
                STOREV(sine, out, 2 * f * stride + k);
            }
        }
    }
    for (uint pad = k > n ? k : n; pad < k + LANES; pad++)
        for (uint row = 0; row < 2 * FMAX + 1; row++)
            out[row * stride + pad] = 0;
}

/* Rows of a group of several axes: table (sets, rows, stride), row i being the product over the axes of the
 * waves that index (rows, axes) names. One work-item a row. */
__kernel void gbn_rows(__global const REAL *wave, const uint sets, const uint stride, const uint first,
                       const uint axes,
                       __global const uint *index, const uint rows, __global REAL *table)
{
    const uint row = get_global_id(0); /* of all sets */
    if (row >= sets * rows) return;
    const uint set = row / rows, i = row - set * rows;
    __global const REAL *axis = wave + ((ulong)set * DIM + first) * WAVES * stride;
    __global const uint *named = index + i * axes;
    for (uint k = 0; k < stride; k += LANES) {
        REALV product = LOADV(axis, (ulong)named[0] * stride + k);
        for (uint a = 1; a < axes; a++)
            product *= LOADV(axis, ((ulong)a * WAVES + named[a]) * stride + k);
        STOREV(product, table, (ulong)row * stride + k);
    }
}

/* Sums R of a tile of rows over the points of a set, times their weights (rows_a, rows_b): both ways round,
 * and the tile's energy sum W R^2. A set's rows begin at start + set * pitch, pitch and start being in rows.
 * One work-item a tile. */
__kernel void gbn_amplitudes(__global const REAL *restrict a, const uint start_a, const uint pitch_a,
                             __global const REAL *restrict b, const uint start_b, const uint pitch_b,
                             const uint sets,
                             const uint stride, const uint rows_a, const uint rows_b,
                             __global const uint *tiles,
                             const uint count, __global const REAL *restrict weight,
                             __global REAL *restrict forward,
                             __global REAL *restrict backward, __global REAL *restrict energy)
{
    const uint set = get_global_id(0) / count;
    const uint tile = get_global_id(0) - set * count;
    if (set >= sets) return;
    const uint i0 = tiles[2 * tile], j0 = tiles[2 * tile + 1];
    __global const REAL *restrict pa = a + ((ulong)set * pitch_a + start_a + i0) * stride;
    __global const REAL *restrict pb = b + ((ulong)set * pitch_b + start_b + j0) * stride;
    REALV total[TILE_A][TILE_B];
    #pragma unroll
    for (int i = 0; i < TILE_A; i++)
        #pragma unroll
        for (int j = 0; j < TILE_B; j++)
            total[i][j] = (REALV)0;
    for (uint first = 0; first < stride; first += CHUNK * LANES) {
        const uint last = first + CHUNK * LANES < stride ? first + CHUNK * LANES : stride;
        REALV sum[TILE_A][TILE_B];
        #pragma unroll
        for (int i = 0; i < TILE_A; i++)
            #pragma unroll
            for (int j = 0; j < TILE_B; j++)
                sum[i][j] = (REALV)0;
        for (uint k = first; k < last; k += LANES) {
            REALV column[TILE_B]; /* the fewer of the two are kept: sixteen registers hold all */
            #pragma unroll
            for (int j = 0; j < TILE_B; j++)
                column[j] = LOADV(pb, (ulong)j * stride + k);
            #pragma unroll
            for (int i = 0; i < TILE_A; i++) {
                const REALV row = LOADV(pa, (ulong)i * stride + k);
                #pragma unroll
                for (int j = 0; j < TILE_B; j++)
                    sum[i][j] += row * column[j];
            }
        }
        #pragma unroll
        for (int i = 0; i < TILE_A; i++)
            #pragma unroll
            for (int j = 0; j < TILE_B; j++)
                total[i][j] += sum[i][j];
    }
    REAL e = 0;
    #pragma unroll
    for (int i = 0; i < TILE_A; i++)
        #pragma unroll
        for (int j = 0; j < TILE_B; j++) {
            const REAL r = SUM_OF(total[i][j]);
            const REAL w = weight[(i0 + i) * rows_b + j0 + j] * r;
            forward[((ulong)set * rows_a + i0 + i) * rows_b + j0 + j] = w;
            backward[((ulong)set * rows_b + j0 + j) * rows_a + i0 + i] = w;
            e += w * r;
        }
    energy[(ulong)set * count + tile] = e;
}
