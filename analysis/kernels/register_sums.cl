/* How the sums of registers are added up, for product.cl; power.cl reads what they make.
 *
 * Sums are added up in the type SUM. Where COMPENSATED, PART_SUMS of them make a part, which is then added to the
 * whole, and the rounding of that addition is kept beside it; without, one sum is all. A row and a block have
 * ROW_SUMS numbers: [cos, sin of alpha][part, whole, rounding][column][cos, sin of beta].
 */
#if COMPENSATED
#define KEPT 3
#else
#define KEPT 1
#endif
#define ROW_SUMS (4 * LANES * KEPT) /* numbers that a row and a block have */

/* Vectors of SUM, SUM_LANES wide: in float a vector makes two or four of double. */
#if SUM_LANES == 1
#define SUMS SUM
#define LOAD_SUMS(p) ((p)[0])
#else
#define SUMS JOIN(SUM, SUM_LANES)
#if SUM_LANES == 2
#define LOAD_SUMS(p) ((SUMS)(TWO_OF(p, 0)))
#elif SUM_LANES == 4
#define LOAD_SUMS(p) ((SUMS)(FOUR_OF(p, 0)))
#elif SUM_LANES == 8
#define LOAD_SUMS(p) ((SUMS)(EIGHT_OF(p, 0)))
#else
#define LOAD_SUMS(p) ((SUMS)(COMPONENTS(p, 0)))
#endif
#endif
#define STORE_SUMS(v, p) (*(__global SUMS *)(p) = (v)) /* sums stand at multiples of a vector */
#define TO_SUMS JOIN(convert_, SUMS)

/* Adds a value to its part, if that has `started`. The last value of a part (`whole` is not 0) also adds the part to the
 * whole, which is there already if `whole` is 2. */
INLINE void add_part(const SUMS value, __global SUM *at, const uint started, const uint whole)
{
    const SUMS part = started ? LOAD_SUMS(at) + value : value;
#if COMPENSATED
    if (whole) {
        const SUMS none = (SUMS)0;
        const SUMS old = whole > 1 ? LOAD_SUMS(at + 2 * LANES) : none;
        const SUMS rest = whole > 1 ? LOAD_SUMS(at + 4 * LANES) : none;
        const SUMS sum = old + part, added = sum - old;
        const SUMS left = rest + ((old - (sum - added)) + (part - added));
        STORE_SUMS(sum, at + 2 * LANES);
        STORE_SUMS(left, at + 4 * LANES);
        return;
    }
#endif
    STORE_SUMS(part, at);
}

INLINE void add_up(const REALV value, __global SUM *at, const uint started, const uint whole)
{
#if LANES == SUM_LANES
    add_part(TO_SUMS(value), at, started, whole);
#elif LANES == 2 * SUM_LANES
    add_part(TO_SUMS(value.lo), at, started, whole);
    add_part(TO_SUMS(value.hi), at + SUM_LANES, started, whole);
#else
    add_part(TO_SUMS(value.lo.lo), at, started, whole);
    add_part(TO_SUMS(value.lo.hi), at + SUM_LANES, started, whole);
    add_part(TO_SUMS(value.hi.lo), at + 2 * SUM_LANES, started, whole);
    add_part(TO_SUMS(value.hi.hi), at + 3 * SUM_LANES, started, whole);
#endif
}

#if LANES > 2 && !FOLDED
/* The sum of a vector's lanes. */
#define HALVED(type, v) (JOIN(convert_, type)((v).lo) + JOIN(convert_, type)((v).hi))

INLINE SUM lanes_summed(const REALV v)
{
#if LANES == 4
    const JOIN(SUM, 2) two = HALVED(JOIN(SUM, 2), v);
#else
#if LANES == 8
    const JOIN(SUM, 4) four = HALVED(JOIN(SUM, 4), v);
#else
    const JOIN(SUM, 8) eight = HALVED(JOIN(SUM, 8), v);
    const JOIN(SUM, 4) four = eight.lo + eight.hi;
#endif
    const JOIN(SUM, 2) two = four.lo + four.hi;
#endif
    return two.s0 + two.s1;
}

/* The same as add_part for the sum with frequency 0 alone, whose sine is 0. */
INLINE void add_zero(const SUM cosines, __global SUM *at, const uint started, const uint whole)
{
    const SUM part = started ? at[0] + cosines : cosines;
    at[0] = part;
    at[1] = 0;
#if COMPENSATED
    if (whole) {
        const SUM old = whole > 1 ? at[2 * LANES] : 0, rest = whole > 1 ? at[4 * LANES] : 0;
        const SUM sum = old + part, added = sum - old;
        at[2 * LANES] = sum;
        at[4 * LANES] = rest + ((old - (sum - added)) + (part - added));
        at[2 * LANES + 1] = at[4 * LANES + 1] = 0;
    }
#endif
}
#endif
