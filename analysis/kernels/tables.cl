/* Tables of cos and sin of 2 pi f.x for two groups of frequencies at points, as product.cl reads them.
 *
 * A group is divided once more: exp(i f.x) is the complex product of a leading and a trailing entry
 * (digits.cl). One work-item takes `each` points, LANES at once, and one group. It computes the leading and the trailing
 * entries of one half space from exact phases; the other half of the trailing ones are their conjugates.
 * Each frequency is then one complex product, which costs a tenth of a sine and cosine. The first group is
 * multiplied by the weights, which are 0 beyond the last point.
 *
 * Places of the last tile beyond the last frequency repeat it, since they are multiplied too, and whatever the memory
 * held may be denormals, which take a processor a hundred cycles each.
 *
 * Layout of the leading table: [tile of frequencies][LANES points][frequency in the tile][cos, sin][lane], of
 * the trailing one: [COLUMNS blocks][point][block][LANES frequencies][cos, sin], or where BY_POINT, as spread.cl
 * reads it, [LANES frequencies][point][cos, sin][lane]. `groups` holds for each group its first
 * coordinate, its number of coordinates, leading entries, trailing entries of the half space, where its
 * multiples begin, where its codes begin, its number of frequencies, frequencies in a tile, and whether its
 * frequency 0 is summed apart (product.cl), and needs no table.
 */
#define FIELDS 9

/* Vectors of points become vectors of frequencies: LANES of them are transposed in log2(LANES) perfect shuffles. */
#if LANES > 1
#if LANES == 2
#define SHUFFLES 1
#define LOW(a, b) ((REALV)(a.s0, b.s0))
#define HIGH(a, b) ((REALV)(a.s1, b.s1))
#elif LANES == 4
#define SHUFFLES 2
#define LOW(a, b) ((REALV)(a.s0, b.s0, a.s1, b.s1))
#define HIGH(a, b) ((REALV)(a.s2, b.s2, a.s3, b.s3))
#elif LANES == 8
#define SHUFFLES 3
#define LOW(a, b) ((REALV)(a.s0, b.s0, a.s1, b.s1, a.s2, b.s2, a.s3, b.s3))
#define HIGH(a, b) ((REALV)(a.s4, b.s4, a.s5, b.s5, a.s6, b.s6, a.s7, b.s7))
#else
#define SHUFFLES 4
#define LOW(a, b) ((REALV)(a.s0, b.s0, a.s1, b.s1, a.s2, b.s2, a.s3, b.s3, a.s4, b.s4, a.s5, b.s5, a.s6, b.s6, a.s7, b.s7))
#define HIGH(a, b) ((REALV)(a.s8, b.s8, a.s9, b.s9, a.sa, b.sa, a.sb, b.sb, a.sc, b.sc, a.sd, b.sd, a.se, b.se, a.sf, b.sf))
#endif
INLINE void transpose(REALV *v, __global REAL *out, const uint step)
{
    REALV w[LANES];
#pragma unroll
    for (uint shuffled = 0; shuffled < SHUFFLES; shuffled++) {
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

/* One entry of a group: the product of two of its smaller tables. */
INLINE void entry_of(const uint pair, const uint leading, const REALV *cosine, const REALV *sine, REALV *c, REALV *s)
{
    const uint u = pair >> 16, v = leading + (pair & 0xffff);
    const REALV cu = cosine[u], su = sine[u], cv = cosine[v], sv = sine[v];
    *c = cu * cv - su * sv;
    *s = su * cv + cu * sv;
}

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
    const uint count = group[6], width = group[7], without_zero = group[8];
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
    uint row = 0;
    for (uint j = 0; j < count; j++) {
        REALV c, s;
        entry_of(pair[j], leading, cosine, sine, &c, &s);
        SPREAD(c, out + row, 2 * LANES);
        SPREAD(s, out + LANES + row, 2 * LANES);
        if (++row == LANES) {
            row = 0;
            out += (ulong)pitch * 2 * LANES;
        }
    }
#else
#if LANES > 1
    if (which) {
        __global REAL *out = trailing_table + slot * trailing_size + (ulong)k * 2 * width * LANES;
        pair += without_zero;
        const uint columns = count - without_zero;
        for (uint j = 0; j < columns; j += LANES / 2) {
            REALV entries[LANES];
#pragma unroll
            for (uint l = 0; l < LANES / 2; l++)
                entry_of(pair[j + l < columns ? j + l : columns - 1], leading, cosine, sine, entries + 2 * l,
                         entries + 2 * l + 1);
            transpose(entries, out + j % LANES * 2, 2 * LANES);
            out += j % LANES ? (ulong)pitch * 2 * LANES : 0;
        }
        return;
    }
#endif
    __global REAL *out = (which ? trailing_table + slot * trailing_size : leading_table + slot * leading_size)
        + (ulong)k * 2 * width;
    for (uint j = 0; j < count; j += width) {
#pragma unroll
        for (uint row = 0; row < (LANES > 1 ? ROWS : width); row++) {
            REALV c, s;
            entry_of(pair[j + row < count ? j + row : count - 1], leading, cosine, sine, &c, &s);
            STORE_ALIGNED(c, out, 2 * LANES * row);
            STORE_ALIGNED(s, out, 2 * LANES * row + LANES);
        }
        out += (ulong)pitch * 2 * width;
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
