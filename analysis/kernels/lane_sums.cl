/* FOUR_SUMS(p, q, r, t): the sums over the lanes of four vectors, side by side in a vector of four SUM.
 *
 * Vectors are halved and put together again, so that each addition serves two or four of them at once; lanes
 * are added in REAL, the result is SUM. Needs vector.cl, and PoCL's compiler makes no calls of it.
 */
#define SUMS JOIN(SUM, 4)
#define LOAD_SUMS(p) ((SUMS)((p)[0], (p)[1], (p)[2], (p)[3]))
#define STORE_SUMS(v, p)                                                                         \
    do {                                                                                         \
        const SUMS stored = (v);                                                                 \
        (p)[0] = stored.s0, (p)[1] = stored.s1, (p)[2] = stored.s2, (p)[3] = stored.s3;          \
    } while (0)

#define REAL4 JOIN(REAL, 4)
INLINE SUMS four_sums(const REALV p, const REALV q, const REALV r, const REALV t)
{
#if LANES == 1
    return (SUMS)(p, q, r, t);
#elif LANES == 2
    return (SUMS)(p.s0 + p.s1, q.s0 + q.s1, r.s0 + r.s1, t.s0 + t.s1);
#else
#if LANES == 16
    const REALV pq = (REALV)(p.lo, q.lo) + (REALV)(p.hi, q.hi), rt = (REALV)(r.lo, t.lo) + (REALV)(r.hi, t.hi);
    const REALV quarter = (REALV)(pq.lo.lo, pq.hi.lo, rt.lo.lo, rt.hi.lo)
        + (REALV)(pq.lo.hi, pq.hi.hi, rt.lo.hi, rt.hi.hi);
    const JOIN(REAL, 8) pair = quarter.even + quarter.odd;
    const REAL4 sum = pair.even + pair.odd;
#elif LANES == 8
    const REALV pq = (REALV)(p.lo, q.lo) + (REALV)(p.hi, q.hi), rt = (REALV)(r.lo, t.lo) + (REALV)(r.hi, t.hi);
    const REALV pair = (REALV)(pq.even, rt.even) + (REALV)(pq.odd, rt.odd);
    const REAL4 sum = pair.even + pair.odd;
#elif LANES == 4
    const REALV pq = (REALV)(p.even, q.even) + (REALV)(p.odd, q.odd);
    const REALV rt = (REALV)(r.even, t.even) + (REALV)(r.odd, t.odd);
    const REAL4 sum = (REALV)(pq.even, rt.even) + (REALV)(pq.odd, rt.odd);
#endif
    return (SUMS)(sum.s0, sum.s1, sum.s2, sum.s3);
#endif
}
#define FOUR_SUMS four_sums
