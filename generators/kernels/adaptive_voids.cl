/* Voids between the points of a set that follows a density, in a box or on a torus.
 *
 * The distance of a place x to a point y is |x - y| over the mean of the local spacings at both, s(x) and
 * s(y); the void at x is the distance to the nearest point, but at most twice that to the border over s(x) in
 * a box, so that a point's mirror image counts, and side / s(x) on the torus.
 *
 * Points lie in lists, one a cell of a grid; widest[c] bounds s on the ink of cell c from above.
 */

#pragma OPENCL EXTENSION cl_khr_fp64 : enable

#define NEAREST 3

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
