/* Energy and gradient of Gaussian Blue Noise within a cut-off: e_k = sum_l sum over images exp(-r^2 / 2
 * sigma^2), and its slope with respect to x_k (Ahmed, Ren & Wonka 2022, Eq. 18). The pair k = l at no shift
 * adds 1 to the energy.
 *
 * The box is cut along its first axis into pencils (strips in two dimensions), each into CELLS cells; points
 * lie sorted by cell, each pencil from a multiple of LANES on, its last places filled with copies of its
 * last point. So the points of a pencil that may come within the cut-off are one contiguous run, or two
 * across the border, and no pair needs a test. One work-item sums LANES neighbours of one pencil; the second
 * index is the set.
 *
 * Double: positions in box sides, each image of a run is a run of its own with its shift. Float: positions
 * are 32-bit fractions of a side, whose differences wrap to the nearest image by themselves and are exact,
 * so boxes must be twice the cut-off wide and each run is visited once. exp(-r^2 / 2 sigma^2) is 2^(-scale
 * r^2), by exp2.cl.
 */
#if DOUBLE
#define PLACE double
#define PLACEV REALV
#define LOADV_PLACE LOADV
#define APART(a, b) ((a) - (b))
#define MARGIN 1e-9
#else
#define PLACE uint
#define PLACEV TURNV
#define LOADV_PLACE LOADV_TURNS
#define APART(a, b) TO_REALV(AS_STURNV((a) - (b)))
#define MARGIN 1e-3f /* cells and rows: what rounds in an extent */
#endif

/* floor by hand: the library's is a call on some devices */
static int below(REAL v)
{
    const int whole = (int)v;
    return whole - (v < whole);
}

/* One axis of LANES places: extent around the first of them, in box sides. */
static void extent(__global const PLACE *at, REAL *low, REAL *high)
{
    REAL least = 0, most = 0;
    for (uint i = 1; i < LANES; i++) {
#if DOUBLE
        const REAL u = at[i] - at[0];
#else
        const REAL u = (REAL)(int)(at[i] - at[0]) * 2.3283064e-10f;
#endif
        least = u < least ? u : least;
        most = u > most ? u : most;
    }
#if DOUBLE
    const REAL origin = at[0];
#else
    const REAL origin = (REAL)at[0] * 2.3283064e-10f;
#endif
    *low = origin + least;
    *high = origin + most;
}

static REAL squared_gap(REAL low, REAL high, int pencil, REAL width)
{
    const REAL from = pencil * width, to = from + width;
    const REAL gap = from > high ? from - high : low > to ? low - to : (REAL)0;
    return gap * gap;
}

/* rows and columns count the pencils along the second and third axes; table holds, for each set and pencil,
 * the first slot of each cell and the slot after the last; scale is for places in their own units, reach in
 * sides. found holds the slopes of all sets' points and then the energies of all sets' groups. */
__kernel void gbn_strips(__global const PLACE *places, __global const uint *order, __global const uint *table,
                         __global const uint *group_pencil, __global const uint *group_count,
                         const uint groups,
                         const uint n, const uint capacity, const int cells, const int rows,
                         const int columns,
                         const REAL scale, __global const REAL *reaches, __global REAL *found)
{
    const uint group = get_global_id(0), set = get_global_id(1);
    if (group >= group_count[set]) return;
    const REAL reach = reaches[set];
    places += (size_t)set * DIM * capacity;
    order += (size_t)set * capacity;
    const uint slot = group * LANES;
    const int own = (int)group_pencil[(size_t)set * groups + group];
    table += (size_t)set * rows * columns * (cells + 1);
    const uint valid = table[(size_t)own * (cells + 1) + cells] - slot;

    REAL low0, high0;
    extent(places + slot, &low0, &high0);
    const PLACEV at0 = LOADV_PLACE(places, slot);
    REALV force0 = (REALV)0, total = (REALV)0;
    __global const PLACE *x1 = places + capacity, *x2 = places + 2 * (size_t)capacity;
#if DIM > 1
    REAL low1, high1;
    extent(x1 + slot, &low1, &high1);
    const PLACEV at1 = LOADV_PLACE(x1, slot);
    REALV force1 = (REALV)0;
    int row0 = below((low1 - reach) * rows - MARGIN), row1 = below((high1 + reach) * rows + MARGIN);
#else
    int row0 = 0, row1 = 0;
#endif
#if DIM > 2
    REAL low2, high2;
    extent(x2 + slot, &low2, &high2);
    const PLACEV at2 = LOADV_PLACE(x2, slot);
    REALV force2 = (REALV)0;
    int column0 = below((low2 - reach) * columns - MARGIN),
        column1 = below((high2 + reach) * columns + MARGIN);
#else
    int column0 = 0, column1 = 0;
#endif
    int row_gaps = 1, column_gaps = 1;
#if !DOUBLE /* each pencil once; one that is met from both sides has no single gap */
    if (row1 - row0 >= rows) row1 = row0 + rows - 1, row_gaps = 0;
    if (column1 - column0 >= columns) column1 = column0 + columns - 1, column_gaps = 0;
#endif
    for (int row = row0; row <= row1; row++) {
        const int row_image = row < 0 ? -((rows - 1 - row) / rows) : row / rows;
        for (int column = column0; column <= column1; column++) {
            const int column_image = column < 0 ? -((columns - 1 - column) / columns) : column / columns;
            REAL gap2 = 0;
#if DIM > 1
            gap2 += row_gaps ? squared_gap(low1, high1, row, (REAL)1 / rows) : (REAL)0;
#endif
#if DIM > 2
            gap2 += column_gaps ? squared_gap(low2, high2, column, (REAL)1 / columns) : (REAL)0;
#endif
            const REAL left = reach * reach - gap2;
            if (left < 0) continue;
            const REAL chord = sqrt(left);
            int cell = below((low0 - chord) * cells - MARGIN);
            int last = below((high0 + chord) * cells + MARGIN);
#if !DOUBLE
            last = last - cell < cells ? last : cell + cells - 1;
#endif
            const int pencil = (row - row_image * rows) * columns + (column - column_image * columns);
            __global const uint *starts = table + (size_t)pencil * (cells + 1);
            while (cell <= last) {
                const int image = cell < 0 ? -((cells - 1 - cell) / cells) : cell / cells;
                const int run_last = last < (image + 1) * cells - 1 ? last : (image + 1) * cells - 1;
                const uint from = starts[cell - image * cells], to = starts[run_last - image * cells + 1];
                cell = run_last + 1;
#if DOUBLE
                const REALV here0 = at0 - image;
#if DIM > 1
                const REALV here1 = at1 - row_image;
#endif
#if DIM > 2
                const REALV here2 = at2 - column_image;
#endif
#else
#define here0 at0
#define here1 at1
#define here2 at2
#endif
                for (uint l = from; l < to; l++) {
                    const REALV u0 = APART(here0, places[l]);
                    REALV r2 = u0 * u0;
#if DIM > 1
                    const REALV u1 = APART(here1, x1[l]);
                    r2 += u1 * u1;
#endif
#if DIM > 2
                    const REALV u2 = APART(here2, x2[l]);
                    r2 += u2 * u2;
#endif
                    const REALV t = r2 * -scale;
                    REALV g = exp2_negative(t);
#ifdef TRUNCATED
                    g = t >= (REALV)(TRUNCATED) ? g : (REALV)0;
#endif
                    total += g;
                    force0 -= g * u0;
#if DIM > 1
                    force1 -= g * u1;
#endif
#if DIM > 2
                    force2 -= g * u2;
#endif
                }
            }
        }
    }
    REAL out[DIM + 1][LANES];
    SPREAD(total, out[DIM], 1);
    SPREAD(force0, out[0], 1);
#if DIM > 1
    SPREAD(force1, out[1], 1);
#endif
#if DIM > 2
    SPREAD(force2, out[2], 1);
#endif
    REAL sum = 0;
    for (uint i = 0; i < LANES && i < valid; i++) {
        const size_t k = ((size_t)set * n + order[slot + i]) * DIM;
        for (uint a = 0; a < DIM; a++)
            found[k + a] = out[a][i];
        sum += out[DIM][i];
    }
    found[get_global_size(1) * n * DIM + (size_t)set * groups + group] = sum;
}
