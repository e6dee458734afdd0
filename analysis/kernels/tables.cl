/* Tables of cos and sin of 2 pi f.x for two groups of frequencies at points, as product.cl reads them.
 *
 * A group is divided once more: exp(i f.x) is the complex product of a leading and a trailing entry
 * (digits.cl). One work-item takes `each` points, LANES at once, and one group. It computes the leading and the trailing
 * entries of one half space from exact phases; the other half of the trailing ones are their conjugates.
 * Each frequency is then one complex product, which costs a tenth of a sine and cosine. The first group is
 * multiplied by the weights, which are 0 beyond the last point.
 *
 * Layout: [tile of frequencies][LANES points][frequency in the tile][cos, sin][lane], or where BY_POINT, as
 * spread.cl reads it, [LANES frequencies][point][cos, sin][lane]. `groups` holds for each group its first
 * coordinate, its number of coordinates, leading entries, trailing entries of the half space, where its
 * multiples begin, where its codes begin, its number of frequencies, and frequencies in a tile.
 */
#define FIELDS 8

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
    __global REAL *out = (which ? trailing_table + slot * trailing_size : leading_table + slot * leading_size)
        + (ulong)k * 2 * width;
#endif
    uint row = 0;
    for (uint j = 0; j < count;) {
        const uint u = pair[j] >> 16;
        const REALV cu = cosine[u], su = sine[u];
        for (; j < count && pair[j] >> 16 == u; j++) {
            const uint v = leading + (pair[j] & 0xffff);
            const REALV cv = cosine[v], sv = sine[v];
#if BY_POINT
            SPREAD(cu * cv - su * sv, out + row, 2 * LANES);
            SPREAD(su * cv + cu * sv, out + LANES + row, 2 * LANES);
            if (++row == LANES) {
                row = 0;
                out += (ulong)pitch * 2 * LANES;
            }
#else
            STOREV(cu * cv - su * sv, out, 2 * LANES * row);
            STOREV(su * cv + cu * sv, out, 2 * LANES * row + LANES);
            if (++row == width) {
                row = 0;
                out += (ulong)pitch * 2 * width;
            }
#endif
        }
    }
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
