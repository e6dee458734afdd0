/* Independent multiply-adds, by which opencl/peak_rate.py measures the peak rate of a device.
 *
 * Each work-item updates CHAINS accumulators of LANES values by y <- y a + b, steps times; no accumulator
 * waits for another. Chains start c / 16 apart. With a = 1 and b = 2^-20 they count steps exactly, and since
 * a and b come from memory the compiler can leave nothing out. Macros write the accumulators out, since an
 * array of them would live in memory. Needs vector.cl.
 */
#define FOUR_CHAINS(DO) DO(0) DO(1) DO(2) DO(3)
#if CHAINS == 4
#define EACH_CHAIN(DO) FOUR_CHAINS(DO)
#elif CHAINS == 8
#define EACH_CHAIN(DO) FOUR_CHAINS(DO) DO(4) DO(5) DO(6) DO(7)
#elif CHAINS == 10
#define EACH_CHAIN(DO) FOUR_CHAINS(DO) DO(4) DO(5) DO(6) DO(7) DO(8) DO(9)
#elif CHAINS == 12
#define EACH_CHAIN(DO) FOUR_CHAINS(DO) DO(4) DO(5) DO(6) DO(7) DO(8) DO(9) DO(10) DO(11)
#endif

#define START(c) REALV y##c = first + (REALV)((REAL)(c) / 16);
#define STEP(c) y##c = y##c * a + b;
#define TOTAL(c) total += y##c;

__kernel void fma_chains(__global const REAL *restrict factors, __global REAL *restrict out, const uint steps)
{
    const REALV a = LOADV(factors, 0), b = LOADV(factors, LANES), first = LOADV(factors, 2 * LANES);
    EACH_CHAIN(START)
    for (uint k = 0; k < steps; k++) {
        EACH_CHAIN(STEP)
    }
    REALV total = (REALV)0;
    EACH_CHAIN(TOTAL)
    STOREV(total, out, get_global_id(0) * LANES);
}
