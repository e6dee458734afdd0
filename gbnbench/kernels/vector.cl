/* Types of a kernel by -D DOUBLE=0|1 and -D LANES=1|2|4|8|16: scalars, vectors of LANES, loads and stores.
 *
 * REAL a coordinate or a sum, TURN an unsigned fixed-point fraction of a turn of the same size, STURN its signed
 * twin; REALV, TURNV, STURNV are LANES of them. Vectors are loaded and stored by vloadN and vstoreN only: a
 * dereferenced vector pointer that is not aligned crashes.
 */
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

#if LANES == 1
#define REALV REAL
#define TURNV TURN
#define STURNV STURN
#define LOADV(p, i) ((p)[i])
#define STOREV(v, p, i) ((p)[i] = (v))
#define TO_REALV JOIN(convert_, REAL)
#define AS_STURNV JOIN(as_, STURN)
#define AS_TURNV JOIN(as_, TURN)
#define AS_REALV JOIN(as_, REAL)
#define TO_STURNV JOIN(convert_, STURN)
#else
#define REALV JOIN(REAL, LANES)
#define TURNV JOIN(TURN, LANES)
#define STURNV JOIN(STURN, LANES)
/* i counts scalars, so that a vector may begin anywhere */
#define LOADV(p, i) JOIN(vload, LANES)(0, (p) + (i))
#define STOREV(v, p, i) JOIN(vstore, LANES)(v, 0, (p) + (i))
#define TO_REALV JOIN(convert_, REALV)
#define AS_STURNV JOIN(as_, STURNV)
#define AS_TURNV JOIN(as_, TURNV)
#define AS_REALV JOIN(as_, REALV)
#define TO_STURNV JOIN(convert_, STURNV)
#endif
