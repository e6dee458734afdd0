/* Farthest-point optimisation for a density, in a box or on a torus.
 *
 * Voids are those of adaptive_voids.cl.
 *
 * `adaptive_fpo` is one work-item that moves points first .. last - 1 in order: point p is taken away, the
 * largest void among many fixed places on the ink is found in a tournament tree, the place climbs to the void's
 * top, and p goes there if it is larger than the void at p's own place, else stays.
 * `adaptive_fpo_places` has one work-item a place, and gives the void there; `adaptive_fpo_points` one a point,
 * and gives the void there that the other points leave.
 *
 * Places are sorted by cell, those of cell c from start[c] on. The tree has `leaves` leaves, and its root is
 * node 1.
 */

#define JUMPS 12        /* to places that have the same distance to three points */
#define CLIMB 0.125     /* first step where ink or a border ends the climb, in local spacings */
#define LAST_STEP 1e-4
#define EQUAL 1e-9      /* a relative gain below this is rounding */
#define RIM 1e-5        /* relative: values of places are float */

/* Where the three nearest points are equally far, by the weights that their spacings and s give them. */
double2 balanced(const Domain *g, double2 x, double s, const Void *at)
{
    double2 u[NEAREST];
    double h2[NEAREST];
    for (int k = 0; k < NEAREST; k++) {
        const double h = 0.5 * (s + g->of_point[at->number[k]]);
        u[k] = apart(g, g->points[at->number[k]] - x);
        h2[k] = h * h;
    }
    /* 2 (u_k - u_0) . c = |u_k|^2 - |u_0|^2 - m (h_k^2 - h_0^2), with m the square of the distance. */
    const double2 a = u[1] - u[0], b = u[2] - u[0];
    const double det = 2 * (a.x * b.y - a.y * b.x);
    double m = at->value * at->value;
    double2 c = 0;
    for (int k = 0; k < 8; k++) {
        const double p = dot(u[1], u[1]) - dot(u[0], u[0]) - m * (h2[1] - h2[0]);
        const double q = dot(u[2], u[2]) - dot(u[0], u[0]) - m * (h2[2] - h2[0]);
        c = (double2)(p * b.y - q * a.y, a.x * q - b.x * p) / det;
        m = dot(c - u[0], c - u[0]) / h2[0];
    }
    return x + c;
}

/* Climb from a place to the top of its void; return the value there. */
double climb(const Domain *g, double2 *place, int without)
{
    double2 x = *place;
    double s = spacing_at(g, x);
    Void now = void_at(g, x, s, without, NEAREST);
    int top = 0;
    for (int k = 0; k < JUMPS && !top && now.number[NEAREST - 1] >= 0; k++) {
        double2 y = balanced(g, x, s, &now);
        const double far = length(y - x) / s;
        if (!(far < 1.0)) break;
        if (!on_ink(g, &y)) break;
        const double there = spacing_at(g, y);
        const Void then = void_at(g, y, there, without, NEAREST);
        if (then.value > now.value) { x = y; s = there; now = then; }
        top = far < 1e-6 || (!(then.value > now.value) && far < 1e-3);
    }
    const double2 way[8] = {
        (double2)(1, 0), (double2)(0, 1), (double2)(-1, 0), (double2)(0, -1),
        (double2)(M_SQRT1_2, M_SQRT1_2), (double2)(-M_SQRT1_2, M_SQRT1_2),
        (double2)(-M_SQRT1_2, -M_SQRT1_2), (double2)(M_SQRT1_2, -M_SQRT1_2)};
    double best = now.value;
    for (double step = top ? 0 : CLIMB; step > LAST_STEP;) {
        int better = 0;
        for (int k = 0; k < 8 && !better; k++) {
            double2 y = x + step * s * way[k];
            if (!on_ink(g, &y)) continue;
            const double there = spacing_at(g, y);
            const double value = void_at(g, y, there, without, 1).value;
            if (value > best * (1 + 1e-6)) { x = y; s = there; best = value; better = 1; }
        }
        if (!better) step *= 0.5;
    }
    *place = x;
    return best;
}

void set_value(__global float *tree, int leaves, int place, float value)
{
    int i = leaves + place;
    tree[i] = value;
    for (i >>= 1; i > 0; i >>= 1) {
        const float larger = fmax(tree[2 * i], tree[2 * i + 1]);
        if (tree[i] == larger) break;
        tree[i] = larger;
    }
}

/* Take point v out of the voids of places around it, or put it in. */
void change_around(const Domain *g, int v, int added, __global const float2 *places,
                   __global const float *of_place, __global const int *start, __global float *tree, int leaves)
{
    const double2 p = g->points[v];
    const double s = g->of_point[v], widest_void = tree[1];
    const int2 own = cell_of(g, p), most = g->torus ? (g->cells - 1) / 2 + 1 : g->cells;
    const double far = 0.5 * widest_void * (s + g->smax);
    const int2 rings = min(convert_int2(far / g->cell) + 1, most);
    for (int i = -rings.x; i <= rings.x; i++)
        for (int j = -rings.y; j <= rings.y; j++) {
            const int c = cell_at(g, own + (int2)(i, j));
            if (c < 0 || start[c] == start[c + 1]) continue;
            const double reach = 0.5 * widest_void * (s + g->widest[c]) * (1 + RIM);
            if (to_cell(g, p, own, i, j) > reach * reach) continue;
            for (int k = start[c]; k < start[c + 1]; k++) {
                const double2 x = convert_double2(places[k]);
                const double d = length(apart(g, x - p)) / (0.5 * (s + of_place[k]));
                if (added) {
                    if (d < tree[leaves + k]) set_value(tree, leaves, k, (float)d);
                } else if (d <= tree[leaves + k] * (1 + RIM))
                    set_value(tree, leaves, k, (float)void_at(g, x, of_place[k], v, 1).value);
            }
        }
}

__kernel void adaptive_fpo_places(DOMAIN, const int many, const int leaves, __global const float2 *places,
                                  __global const float *of_place, __global float *tree)
{
    const int k = get_global_id(0);
    if (k >= many) return;
    const Domain g = GIVEN;
    tree[leaves + k] = (float)void_at(&g, convert_double2(places[k]), of_place[k], -1, 1).value;
}

__kernel void adaptive_fpo_points(DOMAIN, const int many, __global double *values)
{
    const int k = get_global_id(0);
    if (k >= many) return;
    const Domain g = GIVEN;
    values[k] = void_at(&g, points[k], of_point[k], k, 1).value;
}

__kernel void adaptive_fpo(DOMAIN, const int first, const int last, const int leaves,
                           __global const float2 *places, __global const float *of_place,
                           __global const int *start, __global float *tree, __global int *moved)
{
    if (get_global_id(0) > 0) return;
    const Domain g = GIVEN;
    for (int v = first; v < last; v++) {
        const double2 p = points[v];
        const int2 at = cell_of(&g, p);
        __global int *link = head + at.x * g.cells.y + at.y;
        while (*link != v) link = next + *link;
        *link = next[v];
        const double own = void_at(&g, p, of_point[v], v, 1).value;
        change_around(&g, v, 0, places, of_place, start, tree, leaves);

        int i = 1;
        while (i < leaves) i = 2 * i + (tree[2 * i] < tree[2 * i + 1]);
        double2 f = convert_double2(places[i - leaves]);
        if (climb(&g, &f, v) > own * (1 + EQUAL)) {
            points[v] = f;
            of_point[v] = spacing_at(&g, f);
            moved[0]++;
        }
        const int2 to = cell_of(&g, points[v]);
        next[v] = head[to.x * g.cells.y + to.y];
        head[to.x * g.cells.y + to.y] = v;
        change_around(&g, v, 1, places, of_place, start, tree, leaves);
    }
}
