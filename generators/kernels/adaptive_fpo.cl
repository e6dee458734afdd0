/* Farthest-point optimisation for a density, in a box or on a torus.
 *
 * The distance of a place x to a point y is |x - y| over the mean of the local spacings at both, s(x) and
 * s(y); the void at x is the distance to the nearest point, but at most twice that to the border over s(x) in
 * a box, so that a point's mirror image counts, and side / s(x) on the torus.
 *
 * `adaptive_fpo` is one work-item that moves points first .. last - 1 in order: point p is taken away, the
 * largest void among many fixed places on the ink is found in a tournament tree, the place climbs to the void's
 * top, and p goes there if it is larger than the void at p's own place, else stays.
 * `adaptive_fpo_places` has one work-item a place, and gives the void there; `adaptive_fpo_points` one a point,
 * and gives the void there that the other points leave.
 *
 * Points lie in lists, one a cell of a grid; places are sorted by cell, those of cell c from start[c] on.
 * widest[c] bounds s on the ink of cell c from above. The tree has `leaves` leaves, and its root is node 1.
 */

#pragma OPENCL EXTENSION cl_khr_fp64 : enable

#define NEAREST 3
#define JUMPS 12        /* to places that have the same distance to three points */
#define CLIMB 0.125     /* first step where ink or a border ends the climb, in local spacings */
#define LAST_STEP 1e-4
#define EQUAL 1e-9      /* a relative gain below this is rounding */
#define RIM 1e-5        /* relative: values of places are float */

typedef struct {
    double2 shape, cell;
    int2 pixels, cells;
    int torus;
    double smax;
    __global const float *spacing;
    __global const uchar *ink;
    __global const float *widest;
    __global double2 *points;
    __global double *of_point;
    __global int *head, *next;
} Domain;

typedef struct { double value; int number[NEAREST]; double distance[NEAREST]; } Void;

double2 apart(const Domain *g, double2 u) { return g->torus ? u - g->shape * rint(u / g->shape) : u; }

int wrapped(int i, int n) { i %= n; return i < 0 ? i + n : i; }

int neighbour(const Domain *g, int i, int n) { return g->torus ? wrapped(i, n) : clamp(i, 0, n - 1); }

/* Local spacing, bilinear between centres of pixels. */
double spacing_at(const Domain *g, double2 x)
{
    const double2 low = floor(x - 0.5), part = x - 0.5 - low;
    const int i0 = neighbour(g, (int)low.x, g->pixels.x), i1 = neighbour(g, (int)low.x + 1, g->pixels.x);
    const int j0 = neighbour(g, (int)low.y, g->pixels.y), j1 = neighbour(g, (int)low.y + 1, g->pixels.y);
    const int w = g->pixels.y;
    const double a = mix((double)g->spacing[i0 * w + j0], (double)g->spacing[i0 * w + j1], part.y);
    const double b = mix((double)g->spacing[i1 * w + j0], (double)g->spacing[i1 * w + j1], part.y);
    return mix(a, b, part.x);
}

/* Bring a place back to the torus; tell whether it is in the domain and on the ink. */
int on_ink(const Domain *g, double2 *x)
{
    if (g->torus) {
        *x -= g->shape * floor(*x / g->shape);
        if (x->x >= g->shape.x) x->x = 0;
        if (x->y >= g->shape.y) x->y = 0;
    } else if (!(x->x >= 0 && x->y >= 0 && x->x < g->shape.x && x->y < g->shape.y)) return 0;
    return g->ink[(int)x->x * g->pixels.y + (int)x->y];
}

int2 cell_of(const Domain *g, double2 x)
{
    return (int2)(min((int)(x.x / g->cell.x), g->cells.x - 1), min((int)(x.y / g->cell.y), g->cells.y - 1));
}

/* Squared distance from x to a cell that is (i, j) cells away from its own cell. */
double to_cell(const Domain *g, double2 x, int2 own, int i, int j)
{
    const double2 low = convert_double2(own + (int2)(i, j)) * g->cell;
    const double2 u = fmax(fmax(low - x, x - low - g->cell), 0.0);
    return dot(u, u);
}

/* Index of a cell, or -1 where it is outside of a box. */
int cell_at(const Domain *g, int2 at)
{
    if (g->torus) return wrapped(at.x, g->cells.x) * g->cells.y + wrapped(at.y, g->cells.y);
    if (at.x < 0 || at.y < 0 || at.x >= g->cells.x || at.y >= g->cells.y) return -1;
    return at.x * g->cells.y + at.y;
}

double of_border(const Domain *g, double2 x, double s)
{
    if (g->torus) return fmin(g->shape.x, g->shape.y) / s;
    const double2 b = fmin(x, g->shape - x);
    return 2 * fmin(b.x, b.y) / s;
}

/* The void at x of local spacing s, and the nearest points; point `without` is left out. */
Void void_at(const Domain *g, double2 x, double s, int without, int count)
{
    Void found;
    for (int k = 0; k < NEAREST; k++) { found.number[k] = -1; found.distance[k] = INFINITY; }
    const int2 own = cell_of(g, x), most = g->torus ? (g->cells - 1) / 2 + 1 : g->cells;
    const double narrow = fmin(g->cell.x, g->cell.y), border = of_border(g, x, s);
    const int rings = max(most.x, most.y);
    for (int r = 0; r <= rings; r++) {
        double limit = found.distance[count - 1];
        if (count == 1) limit = fmin(limit, border);
        if ((r - 1) * narrow > 0.5 * limit * (s + g->smax)) break;
        for (int i = max(-r, -most.x); i <= min(r, most.x); i++)
            for (int j = -r; j <= r; j += (abs(i) == r || r == 0) ? 1 : 2 * r) {
                if (abs(j) > most.y) continue;
                const int c = cell_at(g, own + (int2)(i, j));
                if (c < 0 || g->head[c] < 0) continue;
                const double far = 0.5 * limit * (s + g->widest[c]);
                if (to_cell(g, x, own, i, j) > far * far) continue;
                for (int l = g->head[c]; l >= 0; l = g->next[l]) {
                    if (l == without) continue;
                    const double d = length(apart(g, x - g->points[l])) / (0.5 * (s + g->of_point[l]));
                    if (!(d < found.distance[count - 1])) continue;
                    int twice = 0;
                    for (int k = 0; k < count; k++) twice |= found.number[k] == l;
                    if (twice) continue;
                    int k = count - 1;
                    for (; k > 0 && d < found.distance[k - 1]; k--) {
                        found.distance[k] = found.distance[k - 1];
                        found.number[k] = found.number[k - 1];
                    }
                    found.distance[k] = d;
                    found.number[k] = l;
                }
            }
    }
    found.value = fmin(found.distance[0], border);
    return found;
}

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

Domain domain(const double rows, const double columns, __global const int *counts, const int torus, const double smax,
              __global const float *spacing, __global const uchar *ink, __global const float *widest,
              __global double2 *points, __global double *of_point, __global int *head, __global int *next)
{
    Domain g;
    g.shape = (double2)(rows, columns);
    g.pixels = (int2)(counts[0], counts[1]);
    g.cells = (int2)(counts[2], counts[3]);
    g.cell = g.shape / convert_double2(g.cells);
    g.torus = torus;
    g.smax = smax;
    g.spacing = spacing;
    g.ink = ink;
    g.widest = widest;
    g.points = points;
    g.of_point = of_point;
    g.head = head;
    g.next = next;
    return g;
}

#define DOMAIN const double rows, const double columns, __global const int *counts, const int torus, const double smax, \
    __global const float *spacing, __global const uchar *ink, __global const float *widest, \
    __global double2 *points, __global double *of_point, __global int *head, __global int *next
#define GIVEN domain(rows, columns, counts, torus, smax, spacing, ink, widest, points, of_point, head, next)

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
