/* Types of a kernel by -D DOUBLE=0|1 and -D LANES=1|2|4|8|16: scalars, vectors of LANES, loads and stores.
 *
 * REAL a coordinate or a sum, TURN an unsigned fixed-point fraction of a turn of the same size, STURN its
 * signed twin; REALV, TURNV, STURNV are LANES of them. LOADV(p, i) and STOREV(v, p, i) move LANES scalars
 * from p + i on, wherever that is: a dereferenced vector pointer that is not aligned crashes, and vloadN is a
 * call on the PoCL of PyPI, around which every vector register is spilled. Compilers make one move of the
 * components named one by one, but no more than 32 bytes in a store: STORE_ALIGNED is for global addresses that
 * are multiples of a vector's. GATHER(p, step) has lane l from p[l * step], SPREAD(v, p, step) puts it there.
 */
/* A function with vectors: PoCL compiles what it does not inline for any processor, ten times slower. */
#define INLINE static inline __attribute__((always_inline))

#define JOIN2(a, b) a##b
#define JOIN(a, b) JOIN2(a, b)

#if DOUBLE
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#define REAL double
#define TURN ulong
#define STURN long
#define TURN_BITS 64
#else
#define REAL float
#define TURN uint
#define STURN int
#define TURN_BITS 32
#endif

#define STORE_ALIGNED(v, p, i) (*(__global REALV *)((p) + (i)) = (v))

#if LANES == 1
#define REALV REAL
#define TURNV TURN
#define STURNV STURN
#define LOADV(p, i) ((p)[i])
#define LOADV_TURNS(p, i) ((p)[i])
#define STOREV(v, p, i) ((p)[i] = (v))
#define STOREV_TURNS STOREV
#define SPREAD(v, p, step) ((p)[0] = (v))
#define GATHER(p, step) ((p)[0])
#define GATHER_TURNS(p, step) ((p)[0])
#define SUM_OF(v) ((SUM)(v))
#define TO_REALV JOIN(convert_, REAL)
#define AS_STURNV JOIN(as_, STURN)
#define AS_TURNV JOIN(as_, TURN)
#define AS_REALV JOIN(as_, REAL)
#define TO_STURNV JOIN(convert_, STURN)
#else
#define REALV JOIN(REAL, LANES)
#define TURNV JOIN(TURN, LANES)
#define STURNV JOIN(STURN, LANES)
#define TWO_OF(p, i) (p)[i], (p)[(i) + 1]
#define FOUR_OF(p, i) TWO_OF(p, i), TWO_OF(p, (i) + 2)
#define EIGHT_OF(p, i) FOUR_OF(p, i), FOUR_OF(p, (i) + 4)
#define EVERY_TWO(p, i, step) (p)[(i) * (step)], (p)[((i) + 1) * (step)]
#define EVERY_FOUR(p, i, step) EVERY_TWO(p, i, step), EVERY_TWO(p, (i) + 2, step)
#define EVERY_EIGHT(p, i, step) EVERY_FOUR(p, i, step), EVERY_FOUR(p, (i) + 4, step)
#define TO_TWO(v, p, i, step) (p)[(i) * (step)] = v.s0, (p)[((i) + 1) * (step)] = v.s1
#define TO_FOUR(v, p, i, step) TO_TWO(v.lo, p, i, step), TO_TWO(v.hi, p, (i) + 2, step)
#define TO_EIGHT(v, p, i, step) TO_FOUR(v.lo, p, i, step), TO_FOUR(v.hi, p, (i) + 4, step)
#define TWO_SUMMED(v) ((SUM)v.s0 + (SUM)v.s1)
#define FOUR_SUMMED(v) (TWO_SUMMED(v.lo) + TWO_SUMMED(v.hi))
#define EIGHT_SUMMED(v) (FOUR_SUMMED(v.lo) + FOUR_SUMMED(v.hi))
#if LANES == 2
#define COMPONENTS TWO_OF
#define SCATTER TO_TWO
#define EVERY EVERY_TWO
#define SUMMED TWO_SUMMED
#elif LANES == 4
#define COMPONENTS FOUR_OF
#define SCATTER TO_FOUR
#define EVERY EVERY_FOUR
#define SUMMED FOUR_SUMMED
#elif LANES == 8
#define COMPONENTS EIGHT_OF
#define SCATTER TO_EIGHT
#define EVERY EVERY_EIGHT
#define SUMMED EIGHT_SUMMED
#else
#define COMPONENTS(p, i) EIGHT_OF(p, i), EIGHT_OF(p, (i) + 8)
#define EVERY(p, i, step) EVERY_EIGHT(p, i, step), EVERY_EIGHT(p, (i) + 8, step)
#define SCATTER(v, p, i, step) TO_EIGHT(v.lo, p, i, step), TO_EIGHT(v.hi, p, (i) + 8, step)
#define SUMMED(v) (EIGHT_SUMMED(v.lo) + EIGHT_SUMMED(v.hi))
#endif
#define LOADV(p, i) ((REALV)(COMPONENTS(p, i)))
#define LOADV_TURNS(p, i) ((TURNV)(COMPONENTS(p, i)))
#define STOREV(v, p, i) do { const REALV stored = (v); SCATTER(stored, (p) + (i), 0, 1); } while (0)
#define STOREV_TURNS(v, p, i) do { const TURNV stored = (v); SCATTER(stored, (p) + (i), 0, 1); } while (0)
/* lane l to p[l * step], and back */
#define SPREAD(v, p, step) do { const REALV stored = (v); SCATTER(stored, p, 0, step); } while (0)
#define GATHER(p, step) ((REALV)(EVERY(p, 0, step)))
#define GATHER_TURNS(p, step) ((TURNV)(EVERY(p, 0, step)))
/* sum of the lanes in the type SUM; define SUM before use */
#define SUM_OF(v) SUMMED(v)
#define TO_REALV JOIN(convert_, REALV)
#define AS_STURNV JOIN(as_, STURNV)
#define AS_TURNV JOIN(as_, TURNV)
#define AS_REALV JOIN(as_, REALV)
#define TO_STURNV JOIN(convert_, STURNV)
#endif
