/* Cosine and sine of each coordinate, from which all pairs are evaluated: needs vector.cl and turns.cl.
 *
 * turns (sets * n, DIM) are coordinates as fixed-point fractions of a turn; circle (sets * n, DIM, 2) gets
 * cosine and sine. One work-item does LANES coordinates; the last ones are done by two work-items where
 * LANES does not divide them, to the same numbers.
 */
__kernel void gbn_circle(__global const TURN *turns, const uint count, __global REAL *circle)
{
    uint first = get_global_id(0) * LANES;
    if (first >= count) return;
    if (first + LANES > count) first = count > LANES ? count - LANES : 0;
    REALV cosine, sine;
    cos_sin_of_turn(LOADV_TURNS(turns, first), &cosine, &sine);
    SPREAD(cosine, circle + 2 * first, 2);
    SPREAD(sine, circle + 2 * first + 1, 2);
}
