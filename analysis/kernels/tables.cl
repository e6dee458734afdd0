/* Tables of cos and sin of 2 pi f.x for two groups of frequencies at points, as product.cl reads them.
 *
 * A group is divided once more: exp(i f.x) is the complex product of a leading and a trailing entry
 * (digits.cl). One work-item takes `each` points, LANES at once, and one group. It computes the leading and the trailing
 * entries of one half space from exact phases; the other half of the trailing ones are their conjugates.
 * Each frequency is then one complex product, which costs a tenth of a sine and cosine. The first group is
 * multiplied by the weights, which are 0 beyond the last point.
 *
 * Layout of the leading table: [tile of frequencies][LANES points][frequency in the tile][cos, sin][lane], of
 * the trailing one: [COLUMNS blocks][point][block][LANES frequencies][cos, sin], or where BY_POINT, as spread.cl
 * reads it, [LANES frequencies][point][cos, sin][lane]. `groups` holds for each group its first
 * coordinate, its number of coordinates, leading entries, trailing entries of the half space, where its
 * multiples begin, where its codes begin, its number of frequencies, and frequencies in a tile.
 */
#define FIELDS 8

/* Vectors of points become vectors of frequencies: LANES of them are transposed in log2(LANES) perfect shuffles. */
#if LANES > 1
#if LANES == 2
#define LOW(a, b) ((REALV)(a.s0, b.s0))
#define HIGH(a, b) ((REALV)(a.s1, b.s1))
#elif LANES == 4
#define LOW(a, b) ((REALV)(a.s0, b.s0, a.s1, b.s1))
#define HIGH(a, b) ((REALV)(a.s2, b.s2, a.s3, b.s3))
#elif LANES == 8
#define LOW(a, b) ((REALV)(a.s0, b.s0, a.s1, b.s1, a.s2, b.s2, a.s3, b.s3))
#define HIGH(a, b) ((REALV)(a.s4, b.s4, a.s5, b.s5, a.s6, b.s6, a.s7, b.s7))
#else
#define LOW(a, b) ((REALV)(a.s0, b.s0, a.s1, b.s1, a.s2, b.s2, a.s3, b.s3, a.s4, b.s4, a.s5, b.s5, a.s6, b.s6, a.s7, b.s7))
#define HIGH(a, b) ((REALV)(a.s8, b.s8, a.s9, b.s9, a.sa, b.sa, a.sb, b.sb, a.sc, b.sc, a.sd, b.sd, a.se, b.se, a.sf, b.sf))
#endif
INLINE void transpose(REALV *v, __global REAL *out, const uint step)
{
    REALV w[LANES];
    for (uint stage = 1; stage < LANES; stage *= 2) {
#pragma unroll
        for (uint i = 0; i < LANES / 2; i++) {
            w[2 * i] = LOW(v[i], v[i + LANES / 2]);
            w[2 * i + 1] = HIGH(v[i], v[i + LANES / 2]);
        }
#pragma unroll
        for (uint i = 0; i < LANES; i++)
            v[i] = w[i];
    }
#pragma unroll
    for (uint l = 0; l < LANES; l++)
        STORE_ALIGNED(v[l], out, l * step);
}
#endif

/* The entries of one group at LANES points from the k-th of a slot on. */
INLINE void tabulate(__global const TURN *x, __global const REAL *weight, const uint stride, const uint dim,
                     const uint weight_stride, __global const TURN *multiple, __global const uint *code,
                     __global const uint *groups, __global REAL *leading_table, const ulong leading_size,
                     __global REAL *trailing_table, const ulong trailing_size, const uint begin,
                     const uint length, const uint pitch, const uint splits, const uint k, const uint which,
                     const uint slot)
{
    const uint set = slot / splits;
    const uint point = begin + slot % splits * length + k;
    __global const uint *group = groups + which * FIELDS;
    const uint coordinates = group[1], leading = group[2], trailing = group[3];
    const uint count = group[6], width = group[7];
    __global const TURN *at = x + ((ulong)set * dim + group[0]) * stride + point;
    __global const TURN *factor = multiple + group[4];
    __global const uint *pair = code + group[5];

    REALV cosine[ENTRIES], sine[ENTRIES];
    const REALV one = (REALV)1;
    const REALV scale = which ? one : LOADV(weight, (ulong)set * weight_stride + point);
    for (uint e = 0; e < leading + trailing; e++) {
        TURNV phase = (TURNV)0;
        for (uint a = 0; a < coordinates; a++) {
            const TURN times = factor[e * coordinates + a]; /* 0, 1 or -1 nearly always; a product takes longer */
            if (times == 1)
                phase += LOADV_TURNS(at, (ulong)a * stride);
            else if (times == (TURN)-1)
                phase -= LOADV_TURNS(at, (ulong)a * stride);
            else if (times != 0)
                phase += times * LOADV_TURNS(at, (ulong)a * stride);
        }
        REALV c = one, s = (REALV)0;
        if (e != 0 && e != leading) cos_sin_of_turn(phase, &c, &s);
        if (e < leading) {
            cosine[e] = c * scale;
            sine[e] = s * scale;
        } else {
            const uint centre = leading + trailing - 1, away = e - leading;
            cosine[centre + away] = cosine[centre - away] = c;
            sine[centre - away] = -s;
            sine[centre + away] = s;
        }
    }

#if BY_POINT
    __global REAL *out = trailing_table + slot * trailing_size + (ulong)k * 2 * LANES;
#else
#if LANES > 1
    REALV block[2 * LANES];
#endif
    __global REAL *out = (which ? trailing_table + slot * trailing_size : leading_table + slot * leading_size)
        + (ulong)k * 2 * width * (which ? LANES : 1);
#endif
    uint row = 0;
    for (uint j = 0; j < count; j++) {
        const uint u = pair[j] >> 16, v = leading + (pair[j] & 0xffff);
        const REALV cu = cosine[u], su = sine[u], cv = cosine[v], sv = sine[v];
        const REALV c_uv = cu * cv - su * sv, s_uv = su * cv + cu * sv;
#if BY_POINT
        SPREAD(c_uv, out + row, 2 * LANES);
        SPREAD(s_uv, out + LANES + row, 2 * LANES);
        if (++row == LANES) {
            row = 0;
            out += (ulong)pitch * 2 * LANES;
        }
#else
#if LANES > 1
        if (which) {
            block[2 * row] = c_uv;
            block[2 * row + 1] = s_uv;
            if (++row == LANES) {
                transpose(block, out, 2 * LANES);
                transpose(block + LANES, out + LANES, 2 * LANES);
                row = 0;
                out += (ulong)pitch * 2 * LANES;
            }
            continue;
        }
#endif
        STORE_ALIGNED(c_uv, out, 2 * LANES * row);
        STORE_ALIGNED(s_uv, out, 2 * LANES * row + LANES);
        if (++row == width) {
            row = 0;
            out += (ulong)pitch * 2 * width;
        }
#endif
    }
#if LANES > 1 && !BY_POINT
    if (which && row > 0) {
        for (uint i = 2 * row; i < 2 * LANES; i++)
            block[i] = (REALV)0;
        transpose(block, out, 2 * LANES);
        transpose(block + LANES, out + LANES, 2 * LANES);
    }
#endif
}

__kernel void tables(__global const TURN *x, __global const REAL *weight, const uint stride, const uint dim,
                     const uint weight_stride, __global const TURN *multiple,
                     __global const uint *code, __global const uint *groups, const uint first_group,
                     __global REAL *leading_table, const ulong leading_size, __global REAL *trailing_table,
                     const ulong trailing_size, const uint begin, const uint length, const uint pitch,
                     const uint splits, const uint each)
{
    const uint first = get_global_id(0) * each;
    const uint end = first + each < length ? first + each : length;
    for (uint k = first; k < end; k += LANES)
        tabulate(x, weight, stride, dim, weight_stride, multiple, code, groups, leading_table, leading_size,
                 trailing_table, trailing_size, begin, length, pitch, splits, k, first_group + get_global_id(1),
                 get_global_id(2));
}
