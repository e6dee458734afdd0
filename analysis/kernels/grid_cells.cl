/* Cells of a grid's axes, of which a window, and so a bin of points, has WIDTH; needs vector.cl. */

/* The cell of a coordinate on `nodes` cells, and its place there less 1/2; exact, but for the place's rounding. */
static uint cell_of(const TURN turn, const uint nodes, REAL *place)
{
#if DOUBLE
    const ulong low = (turn & 0xffffffffUL) * nodes, high = (turn >> 32) * nodes + (low >> 32);
    const ulong rest = high << 32 | (low & 0xffffffffUL);
    *place = (REAL)as_long(rest ^ 0x8000000000000000UL) * (REAL)5.421010862427522170037e-20;
    return (uint)(high >> 32);
#else
    const ulong scaled = (ulong)turn * nodes;
    *place = (REAL)as_int((uint)scaled ^ 0x80000000u) * (REAL)2.3283064365386962890625e-10f;
    return (uint)(scaled >> 32);
#endif
}

/* What deal_points.cl tells of each set: the points of its fullest bin, and the runs in which its points are summed. */
#define RUNS_OF(crowds, set) (crowds)[2 * (set) + 1]
